#include "scaling/pi/pi_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "scaling/detail/integer_matrix.hpp"
#include "scaling/pi/pi_text.hpp"

namespace musim::scaling {

namespace {

using Columns = std::vector<std::size_t>;

bool contains(const Columns& columns, std::size_t j) { return std::find(columns.begin(), columns.end(), j) != columns.end(); }

std::string join_names(const std::vector<PiQuantity>& quantities, const Columns& columns) {
    std::vector<std::string_view> names;
    for (const std::size_t j : columns) names.emplace_back(quantities[j].name);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// `first`, then all other columns in the order of the problem.
Columns put_first(const Columns& first, std::size_t count) {
    Columns order = first;
    for (std::size_t j = 0; j < count; ++j) {
        if (!contains(first, j)) order.push_back(j);
    }
    return order;
}

/// The dependence of column `last` of some on those before it, as a group.
PiGroup dependence_of(std::size_t last, const std::vector<PiQuantity>& quantities, const Columns& columns, const detail::Echelon& echelon) {
    const detail::IntegerRow vector = echelon.kernel_vector(last);
    PiGroup group(quantities.size(), 0);
    for (std::size_t k = 0; k < columns.size(); ++k) group[columns[k]] = detail::to_int64(vector[k]);
    return group;
}

/// Adds a named quantity to the repeating ones.
void add_repeating(const std::vector<PiQuantity>& quantities, const std::string& name, Columns& chosen) {
    const std::size_t j = find_quantity(quantities, name);
    if (contains(chosen, j)) throw PiError(fmt::format("repeating {}: it is there twice; name it once", name));
    if (quantities[j].dimension.is_dimensionless()) {
        throw PiError(fmt::format("repeating {}: it is dimensionless, a group by itself; name another quantity", name));
    }
    chosen.push_back(j);
    const detail::Echelon echelon = detail::eliminate(detail::dimensional_matrix(quantities, chosen), chosen.size());
    if (echelon.rank() == chosen.size()) return;
    const PiGroup dependence = dependence_of(chosen.size() - 1, quantities, chosen, echelon);
    Columns dependent;
    for (const std::size_t k : chosen) {
        if (dependence[k] != 0) dependent.push_back(k);
    }
    throw PiError(fmt::format("repeating {}: they are dependent ({} is dimensionless); replace one of them",
                              join_names(quantities, dependent), format_group(dependence, quantities)));
}

/// "mass is missing", or "one more is needed" when every dimension is there.
std::string missing_dimension(const std::vector<PiQuantity>& quantities, const Columns& chosen) {
    for (const BaseDimension base : kBaseDimensions) {
        const auto carries = [&](std::size_t j) { return quantities[j].dimension[base] != 0; };
        const Columns all = detail::all_columns(quantities);
        if (std::any_of(all.begin(), all.end(), carries) && std::none_of(chosen.begin(), chosen.end(), carries)) {
            return fmt::format("{} is missing", to_string(base));
        }
    }
    return "they make up too few dimensions";
}

PiBasis basis_over(const std::vector<PiQuantity>& quantities, const Columns& repeating) {
    const Columns order = put_first(repeating, quantities.size());
    const detail::Echelon echelon = detail::eliminate(detail::dimensional_matrix(quantities, order), order.size());
    PiBasis basis;
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (echelon.is_pivot(k)) {
            basis.repeating.push_back(order[k]);
        } else {
            basis.groups.push_back(dependence_of(k, quantities, order, echelon));
        }
    }
    return basis;
}

/// The groups without their order and sense.
std::vector<PiGroup> normal_form(std::vector<PiGroup> groups) {
    for (PiGroup& group : groups) {
        const auto first = std::find_if(group.begin(), group.end(), [](std::int64_t exponent) { return exponent != 0; });
        if (first == group.end() || *first > 0) continue;
        for (std::int64_t& exponent : group) exponent = -exponent;
    }
    std::sort(groups.begin(), groups.end());
    return groups;
}

/// Walks all independent sets of `rank` columns, lexicographically.
class BasisSearch {
  public:
    BasisSearch(const std::vector<PiQuantity>& quantities, std::size_t rank, std::size_t limit)
        : quantities_(quantities), rank_(rank), limit_(limit) {}

    PiBases run() {
        extend(0);
        return std::move(result_);
    }

  private:
    void extend(std::size_t from) {
        if (chosen_.size() == rank_) return visit();
        for (std::size_t j = from; j < quantities_.size() && result_.complete; ++j) {
            if (quantities_.size() - j < rank_ - chosen_.size()) return;
            chosen_.push_back(j);
            if (detail::eliminate(detail::dimensional_matrix(quantities_, chosen_), chosen_.size()).rank() == chosen_.size()) extend(j + 1);
            chosen_.pop_back();
        }
    }

    void visit() {
        PiBasis basis = basis_over(quantities_, chosen_);
        if (++visited_ > kMostRepeatingSets) {
            result_.complete = false;
            return;
        }
        if (!seen_.insert(normal_form(basis.groups)).second) return;
        if (result_.bases.size() == limit_) {
            result_.complete = false;
        } else {
            result_.bases.push_back(std::move(basis));
        }
    }

    const std::vector<PiQuantity>& quantities_;
    std::size_t rank_, limit_;
    std::size_t visited_ = 0;
    Columns chosen_;
    std::set<std::vector<PiGroup>> seen_;
    PiBases result_;
};

}  // namespace

PiBasis find_pi_basis(const std::vector<PiQuantity>& quantities, const std::vector<std::string>& repeating) {
    check_quantities(quantities);
    PiBasis basis = basis_over(quantities, {});
    if (repeating.empty()) return basis;

    Columns chosen;
    for (const std::string& name : repeating) add_repeating(quantities, name, chosen);

    // what no group holds belongs to every choice
    for (const std::size_t j : basis.repeating) {
        const auto holds = [j](const PiGroup& group) { return group[j] != 0; };
        if (std::none_of(basis.groups.begin(), basis.groups.end(), holds) && !contains(chosen, j)) chosen.push_back(j);
    }
    const std::size_t rank = basis.rank();
    basis = basis_over(quantities, chosen);
    if (chosen.size() == rank) return basis;

    // those that would extend the choice
    Columns candidates;
    for (std::size_t j = 0; j < quantities.size(); ++j) {
        Columns extended = chosen;
        extended.push_back(j);
        const detail::IntegerMatrix matrix = detail::dimensional_matrix(quantities, extended);
        if (detail::eliminate(matrix, extended.size()).rank() == extended.size()) candidates.push_back(j);
    }
    throw PiError(fmt::format("repeating {}: {} of {} needed, {}; add one of {}", join_names(quantities, chosen), chosen.size(), rank,
                              missing_dimension(quantities, chosen), join_names(quantities, candidates)));
}

PiBases find_all_pi_bases(const std::vector<PiQuantity>& quantities, std::size_t limit) {
    return BasisSearch(quantities, find_pi_basis(quantities).rank(), limit).run();
}

}  // namespace musim::scaling
