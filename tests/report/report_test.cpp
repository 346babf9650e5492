#include "lsdem/report/report.hpp"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/run.hpp"
#include "lsdem/study/write_results.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::report;
using musim::tests::message_of;
using musim::tests::TemporaryFolder;

namespace {

/// A column that is shaken, run into a folder; its name is hostile.
study::RunResult run_column(const std::filesystem::path& folder, bool frames) {
    const scene::Scene scene =
        scene::parse_scene(std::string(R"({"schema": "musim-scene/1", "name": "<b>column</b> & co", "material": "wood",
        "structure": {"kind": "column", "layers": 4, "block": ["12.710 mm", "26.355 mm", "39.720 mm"]},
        "base_motion": {"signal": "ricker", "direction": "x", "amplitude": "0.2 g", "frequency": "200 Hz"},
        "time": {"duration": "10 ms"}, "output": {"spine_rate": "20 kHz")") +
                           (frames ? R"(, "frame_rate": "1 kHz")" : "") + "}}");
    study::ResultFolder results(folder);
    study::RunResult run = study::run_scene(scene);
    results.add_run("", run, {.scene = scene::write_scene(scene), .similitude = {}, .program_version = "test"});
    results.commit();
    return run;
}

std::string make_report(const std::vector<std::filesystem::path>& folders) {
    const ReportContent content = read_content(folders);
    return make_page(content, make_sections(content), "test");
}

bool holds(const std::string& page, const std::string& text) { return page.find(text) != std::string::npos; }

}  // namespace

TEST_CASE("a run's report tells its verdict and the numbers of its results, and lets no markup in") {
    const TemporaryFolder place;
    const study::RunResult run = run_column(place.path() / "out", true);
    const std::string page = make_report({place.path() / "out"});
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK_FALSE(holds(page, "<b>column</b>"));
    CHECK(holds(page, "<h1>&lt;b&gt;column&lt;/b&gt; &amp; co</h1>"));
    CHECK(holds(page, "out: ran to its end; 0 of 4 blocks fallen"));
    CHECK(holds(page, run.state_hash));
    CHECK(holds(page, fmt::format("<td class=\"number\">{:.4g}</td>", run.history.energy.back().friction_loss)));
    CHECK(holds(page, "id=\"figure-spine_velocity\""));
    CHECK(holds(page, "id=\"figure-slip\""));
    // nothing comes from elsewhere
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "<link"}) CHECK_FALSE(holds(page, outside));
}

TEST_CASE("several runs are reported beside each other") {
    const TemporaryFolder place;
    run_column(place.path() / "one", true);
    run_column(place.path() / "two", true);
    const ReportContent content = read_content({place.path() / "one", place.path() / "two"});
    CHECK(content.kind == ReportKind::runs);
    CHECK(content.runs.size() == 2);
    CHECK(content.remarks.empty());
}

TEST_CASE("what is missing is told, and the rest shown") {
    const TemporaryFolder place;
    run_column(place.path() / "out", false);
    const std::string page = make_report({place.path() / "out", place.path() / "nowhere"});
    CHECK(holds(page, "the run has kept no frames"));
    CHECK(holds(page, "there is no such folder"));
    CHECK(holds(page, "id=\"figure-spine_velocity\""));

    // an unfinished run beside a finished one
    std::filesystem::create_directories(place.path() / "killed");
    std::ofstream(place.path() / "killed/live.json")
        << R"({"schema": "musim-live/1", "name": "k", "phase": "running", "fraction": 0.25, "wall_s": 3})";
    CHECK(holds(make_report({place.path() / "killed", place.path() / "out"}), "a run was killed here before it had results, at 25 %"));

    // damaged results
    std::filesystem::create_directories(place.path() / "damaged");
    std::ofstream(place.path() / "damaged/summary.json") << R"({"status": "completed"})";
    std::ofstream(place.path() / "damaged/result.h5") << "no HDF5";
    CHECK(holds(make_report({place.path() / "damaged", place.path() / "out"}), "damaged/result.h5"));

    // a model that has gone
    std::filesystem::create_directories(place.path() / "pair");
    std::filesystem::copy(place.path() / "out", place.path() / "pair/prototype", std::filesystem::copy_options::recursive);
    std::ofstream(place.path() / "pair/pair.json") << R"({"pairs": [{"label": "1:25", "materials": "exact", "consistent": true}]})";
    const ReportContent pair = read_content({place.path() / "pair"});
    CHECK(pair.runs.size() == 1);
    CHECK(std::any_of(pair.remarks.begin(), pair.remarks.end(), [](const std::string& remark) { return holds(remark, "pair/1-25"); }));
    std::filesystem::remove(place.path() / "pair/prototype/summary.json");
    CHECK(holds(message_of<study::ResultError>([&] { read_content({place.path() / "pair/prototype"}); }), "summary.json"));

    // an ensemble without members
    std::filesystem::create_directories(place.path() / "empty");
    std::ofstream(place.path() / "empty/ensemble.json")
        << R"({"members": [{"name": "member-1", "seed": 1, "status": "failed", "reason": "no disk"}]})";
    const std::string ensemble = make_report({place.path() / "empty"});
    CHECK(holds(ensemble, "no member has results"));
    CHECK(holds(ensemble, "no disk"));
}

TEST_CASE("a folder with nothing to show is refused with what would help") {
    const TemporaryFolder place;
    for (const std::filesystem::path& folder : {place.path(), place.path() / "nowhere"}) {
        const std::string why = message_of<study::ResultError>([&] { read_content({folder}); });
        CHECK_MESSAGE(why.starts_with(folder.string() + ": there"), why);
    }
}
