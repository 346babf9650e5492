#include "lsdem/patches.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace musim::lsdem {
namespace {

struct AxisRule {
    std::vector<double> place, weight;
    double second = 0.0;
};

/// Legendre polynomial of degree n at x, and the one before it.
struct Legendre {
    double before = 1.0, at = 0.0;
};

Legendre evaluate_legendre(int degree, double x) {
    Legendre p{1.0, x};
    for (int k = 2; k <= degree; ++k) {
        const double next = ((2 * k - 1) * x * p.at - (k - 1) * p.before) / k;
        p = {p.at, next};
    }
    return p;
}

/// `count` Gauss-Lobatto points on [−1, 1], the ends and the roots of P'_(n−1), with weights 1/(n(n − 1)P²_(n−1)): exact for polynomials
/// of degree 2n − 3.
AxisRule make_lobatto_rule(int count) {
    AxisRule rule;
    const int degree = count - 1;
    const auto size = static_cast<std::size_t>(count);
    rule.place.assign(size, 0.0);
    rule.weight.assign(size, 0.0);
    // one half by Newton's method from the Chebyshev points, the other mirrored to the bit
    for (std::size_t i = 0; 2 * i < size; ++i) {
        double x = i == 0 ? -1.0 : 2 * i + 1 == size ? 0.0 : -std::cos(std::numbers::pi * static_cast<double>(i) / degree);
        constexpr int kRounds = 8;  // quadratic convergence from 1e-2 needs four
        for (int round = 0; round < kRounds && i > 0; ++round) {
            const Legendre p = evaluate_legendre(degree, x);
            x -= (x * p.at - p.before) / (count * p.at);
        }
        if (2 * i + 1 == size) x = 0.0;
        const double last = evaluate_legendre(degree, x).at;
        rule.place[i] = x;
        rule.place[size - 1 - i] = -x;
        rule.weight[i] = rule.weight[size - 1 - i] = 1.0 / (count * degree * last * last);
    }
    rule.second = count > 2 ? 1.0 / 3.0 : 1.0;
    return rule;
}

/// `count` evenly spaced points on [−1, 1] with equal weights inside and end weights that make Σ w = 1 and Σ w s² = 1/3.
AxisRule make_axis_rule(int count) {
    AxisRule rule;
    double inner_squares = 0.0;
    for (int i = 0; i < count; ++i) {
        rule.place.push_back(static_cast<double>(2 * i - (count - 1)) / (count - 1));
        if (i > 0 && i < count - 1) inner_squares += rule.place.back() * rule.place.back();
    }
    // 2e + (n − 2)c = 1 and 2e + c·Σ s² = 1/3
    const int inner = count - 2;
    const double c = inner > 0 ? (2.0 / 3.0) / (inner - inner_squares) : 0.0, e = 0.5 * (1.0 - inner * c);
    rule.weight.assign(static_cast<std::size_t>(count), c);
    rule.weight.front() = rule.weight.back() = e;
    rule.second = inner > 0 ? 1.0 / 3.0 : 1.0;
    return rule;
}

}  // namespace

PatchLattice make_patch_lattice(int count_p, int count_q, PatchSpacing spacing) {
    const auto make_rule = spacing == PatchSpacing::even ? make_axis_rule : make_lobatto_rule;
    const AxisRule p = make_rule(count_p), q = make_rule(count_q);
    PatchLattice lattice;
    lattice.spacing = spacing;
    lattice.count_p = count_p;
    lattice.count_q = count_q;
    lattice.second_p = p.second;
    lattice.second_q = q.second;
    for (std::size_t j = 0; j < q.place.size(); ++j) {
        for (std::size_t i = 0; i < p.place.size(); ++i) {
            lattice.s.push_back(p.place[i]);
            lattice.t.push_back(q.place[j]);
            lattice.w.push_back(p.weight[i] * q.weight[j]);
        }
    }
    const std::size_t full = (lattice.size() + PatchGroup::kSize - 1) / PatchGroup::kSize * PatchGroup::kSize;
    for (auto* values : {&lattice.s, &lattice.t, &lattice.w}) values->resize(full, 0.0);
    for (std::size_t i = 0; i < full; ++i) {
        lattice.ws.push_back(lattice.w[i] * lattice.s[i]);
        lattice.wt.push_back(lattice.w[i] * lattice.t[i]);
    }
    return lattice;
}

void PatchList::clear() {
    lattices.clear();
    kinds.clear();
    groups.clear();
    state.clear();
    next_look.clear();
    slip_u.clear();
    slip_v.clear();
}

std::uint32_t PatchList::find_lattice(int count_p, int count_q, PatchSpacing spacing) {
    const auto same = [&](const PatchLattice& lattice) {
        return lattice.count_p == count_p && lattice.count_q == count_q && lattice.spacing == spacing;
    };
    const auto found = std::find_if(lattices.begin(), lattices.end(), same);
    const auto index = static_cast<std::uint32_t>(found - lattices.begin());
    if (found == lattices.end()) lattices.push_back(make_patch_lattice(count_p, count_q, spacing));
    return index;
}

std::uint32_t PatchList::find_kind(const PatchKind& kind) {
    // most pairs are like one of the last few
    for (std::size_t i = kinds.size(); i-- > 0;)
        if (kinds[i] == kind) return static_cast<std::uint32_t>(i);
    kinds.push_back(kind);
    return static_cast<std::uint32_t>(kinds.size() - 1);
}

PatchView::PatchView(const PatchList& patches, std::size_t group, std::size_t lane)
    : patches_(patches),
      group_(group),
      lane_(lane),
      lattice_(patches.lattices[patches.kinds[patches.groups[group].kind].lattice]),
      first_(patches.groups[group].first_slot + lane * lattice_.w.size()) {}

}  // namespace musim::lsdem
