#include "lsdem/study/verdict.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lsdem/study/pair_text.hpp"
#include "tests/study/made_specimen.hpp"

using namespace musim::lsdem;
using musim::scaling::Similitude;

namespace {

const Similitude kOne;

RunResult run_column() {
    const Specimen column = make_column(2, 0.15);
    return simulate(column, make_plan(column, 100));
}

/// A run whose difference grows from `from` by a factor of ten in every 20 samples.
RunTrace make_trace(const RunResult& prototype, double from) {
    RunTrace trace = trace_run(prototype, prototype, kOne);
    for (std::size_t k = 0; k < trace.running.size(); ++k) trace.running[k] = from * std::pow(10.0, static_cast<double>(k) / 20.0);
    return trace;
}

Yardstick make_yardstick(const RunResult& prototype, double from) {
    std::vector<RunTrace> twins;
    for (const double factor : {1.0, 2.0, 0.5, 1.5}) twins.push_back(make_trace(prototype, factor * from));
    return {prototype, twins};
}

}  // namespace

TEST_CASE("a run is no distance from itself") {
    const RunResult prototype = run_column();
    const RunTrace trace = trace_run(prototype, prototype, kOne);
    CHECK(trace.running.back() == 0.0);
    const Judgement judgement = make_yardstick(prototype, 1e-12).judge(trace);
    CHECK(judgement.agreement == Agreement::agree);
    CHECK(judgement.within_rounding);
    for (const QuantityCheck& check : judgement.quantities) CHECK(check.difference == 0.0);
}

TEST_CASE("twins lie between their lowest and highest difference, the prototype among them") {
    const RunResult prototype = run_column();
    std::vector<RunTrace> twins(2, make_trace(prototype, 1e-12));
    const auto peaks = [](RunTrace& trace) -> std::vector<double>& { return trace.quantities.front().value; };
    const std::size_t top = peaks(twins[0]).size() - 1;
    const double largest = *std::max_element(peaks(twins[0]).begin(), peaks(twins[0]).end());
    peaks(twins[0])[top] += 0.1 * largest;
    peaks(twins[1])[top] += 0.2 * largest;
    const std::vector<QuantityCheck> checks = Yardstick(prototype, twins).check_quantities(trace_run(prototype, prototype, kOne));
    CHECK(checks[top].twins.lowest == 0.0);
    CHECK(checks[top].twins.highest == doctest::Approx(0.2));
    CHECK(checks[top].twins.largest() == checks[top].twins.highest);
    CHECK(format_range({.lowest = -0.019, .highest = 0.15}) == "-1.9 % to +15 %");
    CHECK(format_range({.lowest = 0.0, .highest = 5e-6}) == "0 % to +0.0005 %");
    CHECK(format_range({}) == "less than 1e-07 %");
}

TEST_CASE("the horizon is where the first twin differs by a thousandth") {
    const RunResult prototype = run_column();
    const Yardstick none = make_yardstick(prototype, 1e-12);
    CHECK_FALSE(none.is_within_run());
    CHECK(none.horizon() == none.end());
    // 2e-7 · 10^(k/20) > 1e-3 from k = 74 on
    const Yardstick some = make_yardstick(prototype, 1e-7);
    CHECK(some.is_within_run());
    CHECK(some.horizon() == doctest::Approx(74.0 * prototype.history.time[1]));
}

TEST_CASE("a model that parts decades before the twins differs, one that parts among them or after agrees") {
    const RunResult prototype = run_column();
    const Yardstick yardstick = make_yardstick(prototype, 1e-7);
    CHECK(yardstick.judge(make_trace(prototype, 1e-7)).agreement == Agreement::agree);
    CHECK(yardstick.judge(make_trace(prototype, 1e-8)).agreement == Agreement::agree);
    // pooled scatter of half a decade: 4 deviations are 2.24 decades above their mean
    CHECK(yardstick.judge(make_trace(prototype, 1e-7 * std::pow(10.0, 2.4))).agreement == Agreement::differ);
    CHECK(yardstick.judge(make_trace(prototype, 1e-7 * std::pow(10.0, 2.1))).agreement == Agreement::undecided);
    CHECK(yardstick.judge(make_trace(prototype, 1e-7 * std::pow(10.0, 1.5))).agreement == Agreement::agree);
}

TEST_CASE("a model that is late to part and ends elsewhere differs") {
    const RunResult prototype = run_column();
    const Yardstick yardstick = make_yardstick(prototype, 1e-7);
    RunTrace model = make_trace(prototype, 1e-7);
    model.quantities[0].value[0] *= 1.5;
    CHECK(yardstick.judge(model).agreement == Agreement::differ);
    // before the horizon only the departure counts
    model.running = make_trace(prototype, 1e-12).running;
    CHECK(make_yardstick(prototype, 1e-12).judge(model).agreement == Agreement::agree);
}

TEST_CASE("images that part decades before copies are the scaling's fault, however the models do") {
    const RunResult prototype = run_column();
    const auto lead_of = [&](double decades) {
        std::vector<RunTrace> twins;
        for (int i = 0; i < 8; ++i) {
            twins.push_back(make_trace(prototype, i % 2 == 0 ? 1e-9 * std::pow(10.0, decades) : 1e-9));
            twins.back().image = i % 2 == 0;
        }
        return Yardstick(prototype, twins).lead_of_images();
    };
    // four of each with half a decade of scatter: a deviation is 0.354 decades
    REQUIRE(lead_of(1.0).has_value());
    CHECK(lead_of(1.0)->lead == doctest::Approx(2.0 * std::sqrt(2.0)));
    CHECK(lead_of(1.0)->agreement() == Agreement::agree);
    CHECK(lead_of(1.3)->agreement() == Agreement::undecided);
    CHECK(lead_of(1.6)->agreement() == Agreement::differ);
    CHECK(lead_of(-3.0)->agreement() == Agreement::agree);
    CHECK_FALSE(make_yardstick(prototype, 1e-9).lead_of_images().has_value());
}

TEST_CASE("a model that diverged differs, and without twins nothing is judged") {
    const RunResult prototype = run_column();
    RunTrace model = make_trace(prototype, 1e-8);
    CHECK(Yardstick(prototype, {}).judge(model).agreement == Agreement::not_judged);
    CHECK_FALSE(Yardstick(prototype, {}).smallest_seen().has_value());
    model.diverged = true;
    CHECK(make_yardstick(prototype, 1e-7).judge(model).agreement == Agreement::differ);
}
