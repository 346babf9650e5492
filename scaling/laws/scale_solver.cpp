#include "scaling/laws/scale_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scaling/detail/dimension_names.hpp"
#include "scaling/detail/integer_matrix.hpp"
#include "scaling/detail/wide_product.hpp"
#include "scaling/factor_rounding.hpp"
#include "scaling/pi/pi_express.hpp"

namespace musim::scaling {

namespace {

using detail::Integer;
using detail::IntegerMatrix;
using detail::IntegerRow;
using Exponents = std::vector<Rational>;

void check_chosen(const ScaleProblem& problem) {
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        if (problem.chosen[j]) check_chosen_factor(problem.quantities[j].name, *problem.chosen[j]);
    }
}

/// Elimination, factors and δ of one problem.
class Solver {
  public:
    explicit Solver(const ScaleProblem& problem) : problem_(problem), count_(problem.quantities.size()) {
        for (std::size_t j = count_; j-- > 0;) {
            if (!problem.chosen[j]) unknowns_.push_back(j);
        }
        columns_ = unknowns_;
        for (std::size_t j = 0; j < count_; ++j) {
            if (problem.chosen[j]) columns_.push_back(j);
        }
    }

    ScaleSolution solve() {
        const detail::Echelon dependences = find_dependences();
        solve_unknowns(dependences.pivots);

        ScaleSolution solution;
        solution.free_count = unknowns_.size() - dependences.rank();
        for (std::size_t j = 0; j < count_; ++j) solution.quantities.push_back(make_scale(j));
        for (std::size_t j = 0; j < count_; ++j) {
            const ScaleState state = solution.quantities[j].state;
            if (state == ScaleState::free || state == ScaleState::needs) solution.open.push_back(j);
        }
        for (const ScaleProduct& product : problem_.held) solution.held.push_back(make_factor(substitute(product.exponents), product.text));
        for (const ScaleProduct& product : problem_.watched) {
            solution.watched.push_back(make_factor(substitute(product.exponents), product.text));
        }
        for (std::size_t i = 0; i < problem_.held.size(); ++i) {
            const ScaleFactor& delta = solution.held[i];
            if (!dependences.is_pivot(i) && std::abs(*delta.value - 1.0) > kFactorRounding) {
                solution.conflicts.push_back(make_conflict(i, delta, dependences));
            }
        }
        return solution;
    }

  private:
    /// One row per unknown, one column per held product: pivots are the products that settle something, a kernel vector says what settles
    /// another product before it.
    detail::Echelon find_dependences() const {
        IntegerMatrix matrix(unknowns_.size());
        for (const ScaleProduct& product : problem_.held) {
            const Integer common = detail::common_denominator(product.exponents);
            for (std::size_t row = 0; row < unknowns_.size(); ++row) {
                const Rational& exponent = product.exponents[unknowns_[row]];
                matrix[row].emplace_back(common / exponent.denominator() * exponent.numerator());
            }
        }
        return detail::eliminate(std::move(matrix), problem_.held.size());
    }

    /// One row per product that settles something; columns are the unknowns, last first so that early ones stay free, then what is chosen.
    void solve_unknowns(const std::vector<std::size_t>& independent) {
        IntegerMatrix matrix;
        for (const std::size_t i : independent) {
            const Exponents& exponents = problem_.held[i].exponents;
            const Integer common = detail::common_denominator(exponents);
            IntegerRow row;
            for (const std::size_t j : columns_) row.emplace_back(common / exponents[j].denominator() * exponents[j].numerator());
            matrix.push_back(std::move(row));
        }
        const detail::Echelon echelon = detail::eliminate(std::move(matrix), columns_.size());

        solved_.assign(count_, {});
        for (std::size_t k = 0; k < echelon.rank(); ++k) {
            const Integer& pivot = echelon.rows[k][echelon.pivots[k]];
            Exponents exponents(count_);
            for (std::size_t column = echelon.pivots[k] + 1; column < columns_.size(); ++column) {
                const Integer& entry = echelon.rows[k][column];
                if (entry != 0) exponents[columns_[column]] = detail::make_rational(-entry, pivot);
            }
            solved_[columns_[echelon.pivots[k]]] = std::move(exponents);
        }
    }

    /// A product with every solved quantity replaced by what it is made of.
    Exponents substitute(const Exponents& product) const {
        Exponents result(count_);
        for (std::size_t j = 0; j < count_; ++j) {
            if (product[j] == 0) continue;
            if (!solved_[j]) {
                result[j] = result[j] + product[j];
                continue;
            }
            for (std::size_t k = 0; k < count_; ++k) {
                if ((*solved_[j])[k] != 0) result[k] = result[k] + product[j] * (*solved_[j])[k];
            }
        }
        return result;
    }

    /// A product of chosen and free factors.
    ScaleFactor make_factor(Exponents exponents, std::string_view name) const {
        ScaleFactor factor{.exponents = std::move(exponents), .value = std::nullopt, .needs = {}};
        for (std::size_t j = 0; j < count_; ++j) {
            if (factor.exponents[j] != 0 && !problem_.chosen[j]) factor.needs.push_back(j);
        }
        if (!factor.needs.empty()) return factor;
        factor.value = detail::RootedProduct(factor.exponents).value(problem_.chosen);
        if (!factor.value) {
            throw SimilitudeError(fmt::format("the factor of {} leaves the range of doubles; choose factors nearer 1", name));
        }
        return factor;
    }

    QuantityScale make_scale(std::size_t j) const {
        Exponents own(count_);
        own[j] = 1;
        QuantityScale scale{.state = ScaleState::chosen, .factor = make_factor(substitute(own), problem_.quantities[j].name)};
        if (problem_.chosen[j]) return scale;
        scale.state = !solved_[j] ? ScaleState::free : scale.factor.needs.empty() ? ScaleState::solved : ScaleState::needs;
        return scale;
    }

    ScaleConflict make_conflict(std::size_t i, const ScaleFactor& delta, const detail::Echelon& dependences) const {
        ScaleConflict conflict{.held = i, .with = {}, .chosen = {}};
        const IntegerRow dependence = dependences.kernel_vector(i);
        for (std::size_t other = 0; other < dependence.size(); ++other) {
            if (other != i && dependence[other] != 0) conflict.with.push_back(other);
        }
        for (std::size_t j = 0; j < count_; ++j) {
            if (delta.exponents[j] != 0) conflict.chosen.push_back(j);
        }
        return conflict;
    }

    const ScaleProblem& problem_;
    std::size_t count_;
    std::vector<std::size_t> unknowns_;             ///< last first
    std::vector<std::size_t> columns_;              ///< unknowns, then what is chosen
    std::vector<std::optional<Exponents>> solved_;  ///< what each solved quantity is made of
};

}  // namespace

std::string_view to_string(ScaleState state) {
    constexpr std::string_view kNames[] = {"chosen", "solved", "free", "needs"};
    return kNames[static_cast<std::size_t>(state)];
}

ScaleProduct parse_scale_product(std::string_view text, const std::vector<PiQuantity>& quantities, bool is_definition) {
    ScaleProduct product{.text = std::string(text), .exponents = parse_group(text, quantities), .is_definition = is_definition};
    const RationalDimension dimension = dimension_of_product(product.exponents, quantities);
    if (!dimension.is_dimensionless()) {
        throw PiError(fmt::format("\"{}\" is not dimensionless: it is {}; correct the product or the units of its quantities", text,
                                  detail::describe(dimension)));
    }
    return product;
}

void check_chosen_factor(std::string_view name, double factor) {
    if (std::isfinite(factor) && factor > 0.0) return;
    throw SimilitudeError(
        fmt::format("{} is chosen as {} (model/prototype must be positive and finite); give a number such as 1/25", name, factor));
}

ScaleSolution solve_scales(const ScaleProblem& problem) {
    check_quantities(problem.quantities);
    check_chosen(problem);
    return Solver(problem).solve();
}

}  // namespace musim::scaling
