#include "scaling/pi/pi_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "scaling/detail/dimension_names.hpp"
#include "scaling/detail/integer_matrix.hpp"
#include "scaling/pi/pi_text.hpp"

namespace musim::scaling {

namespace {

bool is_held(const PiBasis& basis, std::size_t j) {
    return std::any_of(basis.groups.begin(), basis.groups.end(), [j](const PiGroup& group) { return group[j] != 0; });
}

/// Weights of base dimensions whose sum, over exponents, is zero in every quantity but one: what that one carries alone.
std::vector<detail::Integer> find_weights(const std::vector<PiQuantity>& quantities, std::size_t alone, unsigned bases) {
    // exponents of the chosen base dimensions in all other quantities; their rows' dependences are the weights
    std::vector<std::size_t> chosen;
    for (std::size_t b = 0; b < kBaseDimensions.size(); ++b) {
        if ((bases >> b & 1U) != 0) chosen.push_back(b);
    }
    const detail::IntegerMatrix all = detail::dimensional_matrix(quantities, detail::all_columns(quantities));
    detail::IntegerMatrix transposed;
    for (std::size_t j = 0; j < quantities.size(); ++j) {
        if (j == alone) continue;
        detail::IntegerRow row;
        for (const std::size_t b : chosen) row.push_back(all[b][j]);
        transposed.push_back(std::move(row));
    }
    const detail::Echelon echelon = detail::eliminate(std::move(transposed), chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        if (echelon.is_pivot(k)) continue;
        detail::IntegerRow weights = echelon.kernel_vector(k);
        detail::Integer sum = 0;
        for (std::size_t i = 0; i < chosen.size(); ++i) sum += weights[i] * all[chosen[i]][alone];
        if (sum != 0) return weights;
    }
    return {};
}

/// The dimension in a quantity of some base dimensions only.
RationalDimension restrict_to(const RationalDimension& dimension, unsigned bases) {
    RationalDimension part;
    for (std::size_t b = 0; b < kBaseDimensions.size(); ++b) {
        if ((bases >> b & 1U) != 0) part[kBaseDimensions[b]] = dimension[kBaseDimensions[b]];
    }
    return part;
}

std::string describe_alone(const std::vector<PiQuantity>& quantities, std::size_t alone, unsigned bases) {
    std::vector<std::string_view> names;
    for (std::size_t b = 0; b < kBaseDimensions.size(); ++b) {
        if ((bases >> b & 1U) != 0) names.push_back(to_string(kBaseDimensions[b]));
    }
    const std::string& name = quantities[alone].name;
    if (names.size() == 1) return fmt::format("{} cannot take part: it alone carries {}", name, names.front());

    // the parts that the others do carry
    std::vector<std::string> parts;
    for (std::size_t j = 0; j < quantities.size(); ++j) {
        const RationalDimension part = restrict_to(quantities[j].dimension, bases);
        if (j == alone || part.is_dimensionless()) continue;
        std::string text = fmt::format("{} ({})", detail::base_units(part), quantities[j].name);
        parts.push_back(std::move(text));
    }
    const std::string of_alone = detail::base_units(restrict_to(quantities[alone].dimension, bases));
    return fmt::format("{} cannot take part: it alone carries {} as {}, which no product of the others does: they have {}", name,
                       fmt::join(names, " and "), of_alone, fmt::join(parts, ", "));
}

/// Whether two quantities occur in all groups in one ratio of powers.
bool are_tied(const PiBasis& basis, std::size_t i, std::size_t j) {
    const auto ratio_of = [&](const PiGroup& group) { return Rational(group[i], group[j]); };
    std::optional<Rational> ratio;
    for (const PiGroup& group : basis.groups) {
        if ((group[i] == 0) != (group[j] == 0)) return false;
        if (group[i] == 0) continue;
        if (ratio && *ratio != ratio_of(group)) return false;
        ratio = ratio_of(group);
    }
    return ratio.has_value();
}

/// The product in which quantities tied to the first of them occur.
PiGroup tied_product(const PiBasis& basis, const std::vector<std::size_t>& tied) {
    const auto group = std::find_if(basis.groups.begin(), basis.groups.end(), [&](const PiGroup& g) { return g[tied.front()] != 0; });
    PiGroup product(group->size(), 0);
    std::int64_t divisor = 0;
    for (const std::size_t j : tied) divisor = std::gcd(divisor, (*group)[j]);
    if ((*group)[tied.front()] < 0) divisor = -divisor;
    for (const std::size_t j : tied) product[j] = (*group)[j] / divisor;
    return product;
}

void add_ties(const std::vector<PiQuantity>& quantities, const PiBasis& basis, std::vector<std::string>& remarks) {
    std::vector<bool> given(quantities.size(), false);
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (given[i] || !is_held(basis, i)) continue;
        std::vector<std::size_t> tied = {i};
        for (std::size_t j = i + 1; j < quantities.size(); ++j) {
            if (are_tied(basis, i, j)) tied.push_back(j);
        }
        if (tied.size() < 2) continue;
        const PiGroup product = tied_product(basis, tied);
        // a group that stands for itself needs no remark
        const auto is_product = [&](const PiGroup& group) {
            return std::equal(group.begin(), group.end(), product.begin(), [](auto a, auto b) { return (a != 0) == (b != 0); });
        };
        if (std::any_of(basis.groups.begin(), basis.groups.end(), is_product)) continue;
        std::vector<std::string_view> names;
        for (const std::size_t j : tied) {
            given[j] = true;
            names.emplace_back(quantities[j].name);
        }
        remarks.push_back(fmt::format("{} take part as {} only", fmt::join(names, " and "), format_group(product, quantities)));
    }
}

void add_equal_dimensions(const std::vector<PiQuantity>& quantities, std::vector<std::string>& remarks) {
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        const RationalDimension& dimension = quantities[i].dimension;
        if (dimension.is_dimensionless()) continue;
        const auto same = [&](const PiQuantity& other) { return other.dimension == dimension; };
        if (std::any_of(quantities.begin(), quantities.begin() + static_cast<std::ptrdiff_t>(i), same)) continue;
        std::vector<std::string_view> names;
        for (std::size_t j = i; j < quantities.size(); ++j) {
            if (same(quantities[j])) names.emplace_back(quantities[j].name);
        }
        if (names.size() < 2) continue;
        remarks.push_back(fmt::format("{} have one dimension: each of their ratios is dimensionless", fmt::join(names, ", ")));
    }
}

}  // namespace

std::vector<UnusedQuantity> explain_unused(const std::vector<PiQuantity>& quantities, const PiBasis& basis) {
    std::vector<unsigned> by_size(1U << kBaseDimensions.size());
    std::iota(by_size.begin(), by_size.end(), 0U);
    std::stable_sort(by_size.begin(), by_size.end(), [](unsigned a, unsigned b) { return std::popcount(a) < std::popcount(b); });

    std::vector<UnusedQuantity> unused;
    for (std::size_t j = 0; j < quantities.size(); ++j) {
        if (is_held(basis, j)) continue;
        const auto bases =
            std::find_if(by_size.begin(), by_size.end(), [&](unsigned some) { return !find_weights(quantities, j, some).empty(); });
        unused.push_back({j, describe_alone(quantities, j, *bases)});
    }
    return unused;
}

std::vector<std::string> find_remarks(const std::vector<PiQuantity>& quantities, const PiBasis& basis) {
    std::vector<std::string> remarks;
    for (const PiQuantity& quantity : quantities) {
        if (!quantity.dimension.is_dimensionless()) continue;
        remarks.push_back(fmt::format("{} is {}: a group by itself", quantity.name, quantity.is_angle ? "an angle" : "a plain number"));
    }
    add_equal_dimensions(quantities, remarks);
    add_ties(quantities, basis, remarks);
    return remarks;
}

}  // namespace musim::scaling
