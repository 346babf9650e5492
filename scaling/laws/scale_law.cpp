#include "scaling/laws/scale_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scaling/factor_rounding.hpp"
#include "scaling/laws/scale_text.hpp"
#include "scaling/setting.hpp"

namespace musim::scaling {

namespace {

std::vector<std::string> names_of(const std::vector<PiQuantity>& quantities, const std::vector<std::size_t>& positions) {
    std::vector<std::string> names;
    names.reserve(positions.size());
    for (const std::size_t j : positions) names.push_back(quantities[j].name);
    return names;
}

ScaleProblem make_problem(const ScaleLaw& law) {
    ScaleProblem problem{.quantities = quantities_of(law), .chosen = {}, .held = {}, .watched = {}};
    problem.chosen.resize(problem.quantities.size());
    for (const std::string& text : law.definitions) problem.held.push_back(parse_scale_product(text, problem.quantities, true));
    for (const std::string& text : law.held) problem.held.push_back(parse_scale_product(text, problem.quantities));
    for (const std::string& text : law.watched) problem.watched.push_back(parse_scale_product(text, problem.quantities));
    return problem;
}

/// "t = 0.1, l = 0.04".
std::string list_chosen(const ScaleProblem& problem, const std::vector<std::size_t>& positions) {
    std::string text;
    for (const std::size_t j : positions) {
        text += fmt::format("{}{} = {:.7g}", text.empty() ? "" : ", ", problem.quantities[j].name, *problem.chosen[j]);
    }
    return text;
}

/// One line that names products and factors at odds and the ways out.
std::string describe_conflict(const ScaleLaw& law, const ScaleProblem& problem, const ScaleSolution& solution,
                              const ScaleConflict& conflict) {
    std::vector<std::string> products;
    std::vector<std::string> definitions;
    std::vector<std::size_t> involved = conflict.with;
    involved.push_back(conflict.held);
    for (const std::size_t i : involved) {
        const ScaleProduct& product = problem.held[i];
        (product.is_definition ? definitions : products).push_back(product.text);
    }
    const ScaleFactor& delta = solution.held[conflict.held];
    std::string text = fmt::format("law {}: {} cannot be", law.name, list_chosen(problem, conflict.chosen));
    if (!products.empty()) text += fmt::format(" where {} {} held", fmt::join(products, ", "), products.size() == 1 ? "is" : "are");
    if (!definitions.empty()) text += fmt::format(" {} {} by definition", products.empty() ? "where" : "and", fmt::join(definitions, ", "));
    text += fmt::format(" ({} = {:.7g}, not 1); release {}{}", format_factor(delta.exponents, problem.quantities), *delta.value,
                        conflict.chosen.size() == 1 ? "" : "one of ", fmt::join(names_of(problem.quantities, conflict.chosen), ", "));
    if (!products.empty()) text += fmt::format(", watch {}{} instead", products.size() == 1 ? "" : "one of ", fmt::join(products, ", "));
    return text + ", or choose another law";
}

bool is_open(const ScaleSolution& solution, std::size_t quantity) {
    return std::find(solution.open.begin(), solution.open.end(), quantity) != solution.open.end();
}

}  // namespace

std::vector<PiQuantity> quantities_of(const ScaleLaw& law) {
    std::vector<PiQuantity> quantities;
    quantities.reserve(law.quantities.size());
    for (const LawQuantity& quantity : law.quantities) quantities.push_back(quantity.quantity);
    return quantities;
}

void check_law(const ScaleLaw& law) {
    const std::vector<PiQuantity> quantities = quantities_of(law);
    check_quantities(quantities);
    make_problem(law);
    std::vector<std::size_t> chosen;
    for (const LawChoice& choice : law.choices) {
        const std::size_t position = find_quantity(quantities, choice.name);
        if (std::find(chosen.begin(), chosen.end(), position) != chosen.end()) {
            throw PiError(fmt::format("{} is chosen twice; remove one", choice.name));
        }
        chosen.push_back(position);
        if (choice.fallback && !(std::isfinite(*choice.fallback) && *choice.fallback > 0.0)) {
            throw PiError(fmt::format("the default of {} is {} (must be positive and finite); correct it", choice.name, *choice.fallback));
        }
    }
    for (const LawAddition& addition : law.additions) {
        const PiQuantity& total = quantities[find_quantity(quantities, addition.total)];
        const PiQuantity& own = quantities[find_quantity(quantities, addition.own)];
        if (total.dimension == own.dimension) continue;
        throw PiError(
            fmt::format("{}: {} and {} differ in dimension; name two quantities of one kind", addition.name, total.name, own.name));
    }
}

std::optional<double> SolvedLaw::factor(std::string_view name) const {
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        if (problem.quantities[j].name == name) return solution.quantities[j].factor.value;
    }
    return std::nullopt;
}

std::optional<double> SolvedLaw::added(const LawAddition& addition) const {
    const auto total = factor(addition.total);
    const auto own = factor(addition.own);
    return total && own ? std::optional(*total - *own) : std::nullopt;
}

std::optional<std::size_t> SolvedLaw::find_base(const LawAddition& addition) const {
    for (const std::string& name : {addition.own, addition.total}) {
        const std::size_t position = find_quantity(problem.quantities, name);
        if (problem.quantities[position].value) return position;
    }
    return std::nullopt;
}

SolvedLaw solve_law(const ScaleLaw& law, const std::vector<GivenFactor>& given) {
    SolvedLaw solved{.law = law, .problem = make_problem(law), .solution = {}, .is_default = {}, .overruled = {}};
    ScaleProblem& problem = solved.problem;
    ScaleSolution& solution = solved.solution;
    for (const auto& [name, factor] : given) {
        auto& chosen = problem.chosen[find_quantity(problem.quantities, name, "law " + law.name)];
        if (chosen) throw PiError(fmt::format("law {}: {} is given twice; give it once", law.name, name));
        chosen = factor;
    }
    solution = solve_scales(problem);
    if (!solution.conflicts.empty()) throw SimilitudeError(describe_conflict(law, problem, solution, solution.conflicts.front()));

    // a default settles what is still open; it can contradict nothing, as nothing settles that factor
    solved.is_default.resize(problem.quantities.size());
    for (const LawChoice& choice : law.choices) {
        const std::size_t j = find_quantity(problem.quantities, choice.name);
        if (!choice.fallback || problem.chosen[j]) continue;
        if (is_open(solution, j)) {
            problem.chosen[j] = choice.fallback;
            solved.is_default[j] = true;
            solution = solve_scales(problem);
        } else if (std::abs(*solution.quantities[j].factor.value / *choice.fallback - 1.0) > kFactorRounding) {
            solved.overruled.push_back(j);
        }
    }
    for (const LawChoice& choice : law.choices) {
        const std::size_t j = find_quantity(problem.quantities, choice.name);
        if (choice.fallback || !is_open(solution, j)) continue;
        throw MissingFactor(fmt::format("law {}: the factor of {} ({}) is missing", law.name, choice.name, law.quantities[j].meaning),
                            Remedy{"give it as ", Setting::factor, ", or another that settles it"});
    }
    return solved;
}

}  // namespace musim::scaling
