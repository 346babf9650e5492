#include "scaling/laws/law_formulas.hpp"

#include <doctest/doctest.h>

#include <string>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::scaling::tests {

using musim::tests::message_of;

namespace {

LawFormulas make_formulas(const std::string& law, const std::vector<GivenFactor>& given) {
    return LawFormulas(solve_law(load_scale_law(law), given));
}

}  // namespace

TEST_CASE("formulas take new values to the same bits as solving again") {
    const std::vector<GivenFactor> before{{"l", 1.0 / 25.0}, {"mu", 0.9}, {"rho", 1.1}};
    const std::vector<GivenFactor> after{{"rho", 800.0 / 2320.0}, {"l", 1.0 / 107.0}, {"mu", 0.63 / 0.59}};
    for (const char* law : {"mu", "froude", "cauchy", "true_replica", "restoring_mixed", "artificial_mass"}) {
        CAPTURE(law);
        // the solid's density where the law asks for it
        std::vector<GivenFactor> first = before, second = after;
        for (auto* given : {&first, &second}) {
            for (GivenFactor& factor : *given) {
                if (factor.name == "rho" && std::string(law) == "artificial_mass") factor.name = "rho_s";
            }
        }
        const LawFormulas formulas = make_formulas(law, first);
        const SolvedLaw again = solve_law(load_scale_law(law), second);
        const ChosenFactors chosen = formulas.choose(second);
        for (std::size_t j = 0; j < again.problem.quantities.size(); ++j) {
            CAPTURE(again.problem.quantities[j].name);
            CHECK(formulas.factor(j, chosen) == again.solution.quantities[j].factor.value);
        }
        for (std::size_t i = 0; i < again.problem.watched.size(); ++i) {
            // a δ nearer to 1 than rounding may be printed as 1 or not
            CHECK(formulas.watched(i, chosen).value() == doctest::Approx(again.solution.watched[i].value.value()).epsilon(1e-14));
        }
        for (std::size_t i = 0; i < again.problem.held.size(); ++i) CHECK(formulas.held(i, chosen) == 1.0);
        const Similitude similitude = make_similitude(formulas, chosen);
        CHECK(similitude.factors().size() == make_similitude(again).factors().size());
        CHECK(similitude.acceleration() == make_similitude(again).acceleration());
    }
}

TEST_CASE("values that contradict the law, or that it was not given, are named") {
    const LawFormulas centrifuge = make_formulas("centrifuge", {{"l", 1.0 / 25.0}, {"g", 25.0}, {"E", 1.0}, {"rho", 1.0}});
    CHECK(message_of<std::runtime_error>([&] { centrifuge.choose({{"l", 1.0 / 50.0}, {"g", 50.0}}); }).empty());
    const std::string conflict = message_of<std::runtime_error>([&] {
        centrifuge.choose({{"l", 1.0 / 50.0}, {"g", 25.0}, {"E", 1.0}, {"rho", 1.0}});
    });
    CHECK(conflict.find("law centrifuge: ") != std::string::npos);
    CHECK(conflict.find("cannot be where") != std::string::npos);
    const LawFormulas mu = make_formulas("mu", {{"l", 1.0 / 25.0}});
    CHECK(message_of<std::runtime_error>([&] { mu.choose({{"l", 0.1}, {"rho", 0.5}}); }).find("rho was not given") != std::string::npos);
    CHECK(message_of<std::runtime_error>([&] { mu.choose({{"l", -0.1}}); }).find("l is chosen as -0.1") != std::string::npos);
    CHECK(message_of<std::runtime_error>([&] { mu.choose({{"x", 0.1}}); }).find("\"x\" is no quantity") != std::string::npos);
    CHECK(message_of<std::runtime_error>([&] {
              mu.factor(11, mu.choose({{"l", 1e-200}}));
          }).find("leaves the range of doubles") != std::string::npos);
}

}  // namespace musim::scaling::tests
