#include "tests/benches/verdict_bench.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/study/pushed_wall.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::make_pushed_wall;
using musim::tests::TemporaryFolder;

namespace {

const VerdictBenchPlan kPlan{
    .seed = 5, .sets = 2, .twins = 4, .models = 3, .errors = {ModelError::normal_stiffness}, .sizes = {1e-5, 1e-4}, .images = 4};

std::size_t count_traces(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) count += entry.path().extension() == ".json";
    return count;
}

std::vector<double> leads_of(const VerdictBench& bench) {
    std::vector<double> leads;
    for (const JudgedSet& set : bench.sets) {
        for (const JudgedModel& model : set.models) leads.push_back(model.lead);
    }
    for (const JudgedError& error : bench.errors) {
        for (const JudgedModel& model : error.alone) leads.push_back(model.lead);
        for (const JudgedModel& model : error.shared) leads.push_back(model.lead);
    }
    return leads;
}

}  // namespace

TEST_CASE("exact models agree, wrong ones are found in one model and where the twins have the same error") {
    const TemporaryFolder folder;
    const VerdictBench bench = run_verdict_bench(make_pushed_wall(), kPlan, {.directory = folder.path(), .version = "test", .threads = 2});
    REQUIRE(bench.sets.size() == 2);
    for (const JudgedSet& set : bench.sets) {
        CHECK(tally(set.models, Agreement::agree).count == 3);
        CHECK(set.of_images.has_value());
    }
    CHECK(bench.sets[0].models[0].length != bench.sets[1].models[0].length);
    REQUIRE(bench.errors.size() == 2);
    for (const JudgedError& error : bench.errors) {
        CAPTURE(error.size);
        CHECK(tally(error.alone, Agreement::differ).count == 4);
        CHECK(tally(error.shared, Agreement::differ).count == 4);
    }
    CHECK(find_size(bench, ModelError::normal_stiffness, &JudgedError::alone).has_value());
    CHECK_FALSE(find_size(bench, ModelError::friction, &JudgedError::alone).has_value());

    // what is lost is run again, to the same results
    CHECK(count_traces(folder.path()) == 2 * (4 + 3) + 2 * 4);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
        if (entry.path().filename().string().starts_with("exact_5_1")) std::filesystem::resize_file(entry.path(), 20);
    }
    const VerdictBench again = run_verdict_bench(make_pushed_wall(), kPlan, {.directory = folder.path(), .version = "test", .threads = 1});
    CHECK(leads_of(again) == leads_of(bench));
}

TEST_CASE("limits of a share are those of Clopper and Pearson") {
    const std::vector<JudgedModel> models(360, JudgedModel{1.0, Agreement::agree, 0.0, 0.0, 1.0});
    const Tally none = tally(models, Agreement::differ);
    CHECK(none.low == 0.0);
    // 1 - 0.025^(1/360)
    CHECK(none.high == doctest::Approx(0.010194).epsilon(1e-4));
    CHECK(tally(models, Agreement::agree).low == doctest::Approx(1.0 - 0.010194).epsilon(1e-4));
}
