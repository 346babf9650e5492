#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "records/processing/scale_record.hpp"
#include "records/shake_table/table_correction.hpp"
#include "records/synthesis/synthetic.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
namespace si = scaling::si;

TableTask make_task() {
    SyntheticSettings settings;
    settings.duration = 20.0 * si::seconds;
    TableTask task;
    task.model = make_synthetic_record(settings);
    task.axes.resize(1);
    task.axes[0].name = "x";
    return task;
}

const TableDemand& demand(const std::vector<ComponentUse>& uses) { return uses.front().demand; }

}  // namespace

TEST_CASE("too much acceleration leaves a smaller amplitude as the only way") {
    TableTask task = make_task();
    task.axes[0].acceleration = {{0.0 * si::kilograms, 0.5 * demand(check_task(task)).acceleration}};
    const auto uses = check_task(task);
    CHECK(find_largest_use(uses) == relative(2.0, 1e-12));
    const auto corrections = find_corrections(task, make_task_periods(uses));
    REQUIRE_FALSE(corrections.empty());
    const Correction& best = corrections.front();
    CHECK(best.settings.amplitude == relative(0.5, 1e-8));
    CHECK_FALSE(best.settings.high_pass);
    CHECK(corrections.size() == 1);
    CHECK(best.mean_change == relative(std::log(2.0), 1e-8));
    CHECK(best.largest_change == relative(std::log(2.0), 1e-8));
    CHECK(find_largest_use(best.uses) <= 1.0);
}

TEST_CASE("too much displacement can be filtered out, which leaves the response nearly as it was") {
    TableTask task = make_task();
    task.axes[0].displacement = 0.6 * demand(check_task(task)).displacement;
    const auto corrections = find_corrections(task, make_task_periods(check_task(task)));
    REQUIRE(corrections.size() >= 2);
    CHECK(
        std::is_sorted(corrections.begin(), corrections.end(), [](const auto& a, const auto& b) { return a.mean_change < b.mean_change; }));
    CHECK(corrections.front().settings.high_pass);
    for (const Correction& correction : corrections) {
        CHECK(find_largest_use(check_task(task, correction.settings)) <= 1.0);
        const SpectrumChange& change = correction.spectra.front();
        CHECK(change.before.period == change.after.period);
    }
    const auto by_amplitude = std::find_if(corrections.begin(), corrections.end(), [](const auto& c) { return !c.settings.high_pass; });
    REQUIRE(by_amplitude != corrections.end());
    CHECK(by_amplitude->settings.amplitude == relative(0.6, 1e-6));
    CHECK(corrections.front().mean_change < 0.5 * by_amplitude->mean_change);
}

TEST_CASE("what the table cannot follow is taken off by a low-pass") {
    TableTask task = make_task();
    task.axes[0].highest_frequency = 0.5 * demand(check_task(task)).highest_frequency;
    const auto corrections = find_corrections(task, make_task_periods(check_task(task)));
    REQUIRE_FALSE(corrections.empty());
    CHECK(corrections.front().settings.low_pass);
    CHECK(corrections.front().settings.amplitude == 1.0);
    CHECK(demand(corrections.front().uses).highest_frequency <= *task.axes[0].highest_frequency);
}

TEST_CASE("a payload that is too heavy has no remedy") {
    TableTask task = make_task();
    task.axes[0].payload = 1.0 * si::kilograms;
    task.payload.mass = 2.0 * si::kilograms;
    CHECK(find_corrections(task, make_task_periods(check_task(task))).empty());
}

TEST_CASE("a corrected motion holds its limits at the controller's step, between the record's samples") {
    TableTask task = make_task();
    task.settings.dt = 0.0008 * si::seconds;
    const TableDemand asked = demand(check_task(task));
    task.axes[0].acceleration = {{0.0 * si::kilograms, 0.4 * asked.acceleration}};
    task.axes[0].displacement = 0.3 * asked.displacement;
    for (const Correction& correction : find_corrections(task, make_task_periods(check_task(task)))) {
        CHECK(correction.settings.dt == task.settings.dt);
        CHECK(find_largest_use(check_task(task, correction.settings)) <= 1.0);
    }
}

TEST_CASE("a model on a table scaled like it is judged and corrected alike, to the last bit") {
    TableTask task = make_task();
    const TableDemand asked = demand(check_task(task));
    task.axes[0].displacement = 0.7 * asked.displacement;
    task.axes[0].acceleration = {{0.0 * si::kilograms, 0.9 * asked.acceleration}};
    const scaling::Similitude similitude = scaling::make_similitude("mu", {.length = 1.0 / 16.0});
    TableTask model = task;
    model.model = rescale(task.model, similitude);
    model.axes[0].displacement = similitude.to_model(*task.axes[0].displacement);
    const auto periods = make_task_periods(check_task(task));
    std::vector<scaling::Time> model_periods;
    for (const scaling::Time& period : periods) model_periods.push_back(similitude.to_model(period));
    const auto here = find_corrections(task, periods), there = find_corrections(model, model_periods);
    REQUIRE(here.size() == there.size());
    REQUIRE_FALSE(here.empty());
    for (std::size_t i = 0; i < here.size(); ++i) {
        CHECK(here[i].settings.amplitude == there[i].settings.amplitude);
        CHECK(here[i].settings.high_pass.has_value() == there[i].settings.high_pass.has_value());
        if (here[i].settings.high_pass)
            CHECK(similitude.to_model(*here[i].settings.high_pass).value() == there[i].settings.high_pass->value());
        CHECK(here[i].mean_change == there[i].mean_change);
        CHECK(find_largest_use(here[i].uses) == find_largest_use(there[i].uses));
    }
}

}  // namespace musim::records
