#include "lsdem/report/report.hpp"

#include <doctest/doctest.h>

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/ensemble_files.hpp"
#include "lsdem/study/ensemble_members.hpp"
#include "records/formats/read_record.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/report/made_stored_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::message_of;
using musim::tests::TemporaryFolder;

namespace {

constexpr const char* kColumnWithFrames = R"({"schema": "musim-scene/1", "name": "<b>column</b> & co", "material": "wood",
    "structure": {"kind": "column", "layers": 4, "block": ["12.710 mm", "26.355 mm", "39.720 mm"]},
    "base_motion": {"signal": "ricker", "direction": "x", "amplitude": "0.2 g", "frequency": "200 Hz"},
    "time": {"duration": "20 ms"}, "output": {"spine_rate": "20 kHz", "frame_rate": "1 kHz"}})";
const std::string kColumn = [] {
    std::string text = kColumnWithFrames;
    const std::string frames = R"(, "frame_rate": "1 kHz")";
    return text.erase(text.find(frames), frames.size());
}();

/// A column that is shaken, run into a folder; its name is hostile.
RunResult run_column(const std::filesystem::path& folder, bool frames) {
    const Scene scene = parse_scene(frames ? std::string(kColumnWithFrames) : kColumn);
    ResultFolder results(folder);
    RunResult run = run_scene(scene);
    results.add_run("", run, {.scene = write_scene(scene), .program_version = "test"});
    results.commit();
    return run;
}

ReportContent read_places(const std::vector<std::filesystem::path>& places) {
    return read_content(places, [](const std::filesystem::path& file) { return musim::records::read_record(file); });
}

std::string make_report(const std::vector<std::filesystem::path>& folders) {
    const ReportContent content = read_places(folders);
    return make_page(content, make_sections(content), "test");
}

/// After a change by the HDF5 library, which cuts off what stands behind its own end.
void renew_checksum(const std::filesystem::path& file) {
    const std::string bytes = musim::tests::bytes_of(file);
    std::vector<char> renewed(bytes.begin(), bytes.end());
    detail::append_checksum(renewed);
    std::ofstream(file, std::ios::binary).write(renewed.data(), static_cast<std::streamsize>(renewed.size()));
}

void write_json(const std::filesystem::path& file, const nlohmann::json& object) { std::ofstream(file) << make_checked_json(object); }

bool holds(const std::string& page, const std::string& text) { return page.find(text) != std::string::npos; }

}  // namespace

TEST_CASE("a run's report has its verdict and the numbers of its results, and lets no markup in") {
    const TemporaryFolder place;
    const RunResult run = run_column(place.path() / "out", true);
    const std::string page = make_report({place.path() / "out"});
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK_FALSE(holds(page, "<b>column</b>"));
    CHECK(holds(page, "<h1>&lt;b&gt;column&lt;/b&gt; &amp; co</h1>"));
    CHECK(holds(page, "out: ran to its end; 0 of 4 blocks fallen"));
    CHECK(holds(page, "<p class=\"headline statement good\"><strong>good</strong> The structure stands: 0 of 4 blocks fell"));
    CHECK(page.find("<p class=\"headline") < page.find("id=\"tower\""));
    CHECK(page.find("id=\"tower\"") < page.find("<figure"));
    CHECK(holds(page, run.state_hash));
    CHECK(holds(page, fmt::format("<td class=\"number\">{:.4g}</td>", run.history.energy.back().friction_loss)));
    CHECK(holds(page, "id=\"figure-spine_velocity\""));
    CHECK(holds(page, "id=\"figure-slip\""));
    // nothing comes from elsewhere
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "<link"}) CHECK_FALSE(holds(page, outside));
}

TEST_CASE("an energy balance is a warning of the report where it is one of the run, and speeds stand where they were found") {
    ReportContent content;
    content.kind = ReportKind::run;
    content.runs.push_back(make_stored_run(5));
    ReportedRun& run = content.runs.front();
    run.run.is_status_known = true;
    const auto page = [&] { return make_page(content, make_sections(content), "test"); };
    // a tenth is the documented limit, above which the run warns of itself
    for (const double closure : {0.5 * kOpenBalance, 0.99 * kOpenBalance}) {
        run.summary["energy_closure"] = closure;
        CHECK(holds(page(), fmt::format("energy balance closes to {:.2g} of the energy in play", closure)));
        CHECK_FALSE(holds(page(), "<strong>warning</strong>"));
    }
    run.run.warnings = {"the energy balance is open"};
    CHECK(holds(page(), "<strong>warning</strong> made: the energy balance is open"));

    run.response->speeds.resize(1);
    run.response->speeds[0].method = "peak";
    run.response->speeds[0].why = "it arrives everywhere at once";
    CHECK_FALSE(holds(page(), "Structural speed"));
    run.response->speeds.resize(2);
    SpeedEstimate& arrival = run.response->speeds[1];
    arrival.method = "first_arrival";
    arrival.height = {0.0, 1.0, 2.0};
    arrival.lag = {0.0, 0.1, 0.2};
    arrival.speed = 10.0;
    const std::string found = page();
    CHECK(holds(found, "Structural speed"));
    CHECK(holds(found, "<th scope=\"row\">made</th><td>first_arrival</td><td class=\"number\">10</td>"));
    CHECK_FALSE(holds(found, "<td>peak</td>"));
    CHECK_FALSE(holds(found, ">peak<"));
}

TEST_CASE("several runs are reported beside each other") {
    const TemporaryFolder place;
    run_column(place.path() / "one", true);
    run_column(place.path() / "two", true);
    const ReportContent content = read_places({place.path() / "one", place.path() / "two"});
    CHECK(content.kind == ReportKind::runs);
    CHECK(content.runs.size() == 2);
    CHECK(content.remarks.empty());

    // of the same name, in a folder whose name would end a script
    const std::filesystem::path other = place.path() / "a</script>/one";
    std::filesystem::create_directories(other.parent_path());
    std::filesystem::rename(place.path() / "two", other);
    CHECK_FALSE(holds(make_report({place.path() / "one", other}), "a</script>"));
    const ReportContent alike = read_places({place.path() / "one", other});
    REQUIRE(alike.runs.size() == 2);
    CHECK(alike.runs[0].label == (place.path() / "one").string());
    CHECK(alike.runs[1].label == other.string());
    for (const ReportSection& section : make_sections(alike)) {
        for (const ReportFigure& figure : section.figures) {
            CHECK_MESSAGE(figure.name.find_first_of("/. ") == std::string::npos, figure.name);
        }
    }
}

TEST_CASE("what is missing is named, and the rest shown") {
    const TemporaryFolder place;
    run_column(place.path() / "out", false);
    const std::string page = make_report({place.path() / "out", place.path() / "nowhere"});
    CHECK(holds(page, "the run has kept no frames"));
    CHECK(holds(page, "there is no such folder"));
    CHECK(holds(page, "id=\"figure-spine_velocity\""));

    // an unfinished run beside a finished one
    std::filesystem::create_directories(place.path() / "killed");
    std::ofstream(place.path() / "killed/progress.json")
        << R"({"schema": "musim-progress/1", "name": "k", "phase": "running", "fraction": 0.25, "wall_s": 3})";
    CHECK(holds(make_report({place.path() / "killed", place.path() / "out"}), "a run was killed here before it had results, at 25 %"));

    // damaged results
    std::filesystem::create_directories(place.path() / "damaged");
    std::ofstream(place.path() / "damaged/summary.json") << R"({"status": "completed"})";
    std::ofstream(place.path() / "damaged/result.h5") << "no HDF5";
    CHECK(holds(make_report({place.path() / "damaged", place.path() / "out"}), "damaged/result.h5"));

    // a model that has gone
    std::filesystem::create_directories(place.path() / "pair");
    std::filesystem::copy(place.path() / "out", place.path() / "pair/prototype", std::filesystem::copy_options::recursive);
    write_json(place.path() / "pair/pair.json",
               nlohmann::json::parse(R"({"pairs": [{"label": "1:25", "materials": "exact", "consistent": true}]})"));
    const ReportContent pair = read_places({place.path() / "pair"});
    CHECK(pair.runs.size() == 1);
    CHECK(std::any_of(pair.remarks.begin(), pair.remarks.end(), [](const std::string& remark) { return holds(remark, "pair/1-25"); }));

    // how it ended is in summary.json, all else is not
    std::filesystem::remove(place.path() / "pair/prototype/summary.json");
    const std::string unknown = make_report({place.path() / "pair/prototype"});
    CHECK(holds(unknown, "prototype/summary.json: cannot be read (no such file)"));
    CHECK(holds(unknown, "how it ended is not known"));
    CHECK(holds(unknown, "id=\"figure-spine_velocity\""));

    // an ensemble without members
    std::filesystem::create_directories(place.path() / "empty");
    write_json(place.path() / "empty/ensemble.json",
               nlohmann::json::parse(R"({"members": [{"name": "member-1", "seed": 1, "status": "failed", "reason": "no disk"}]})"));
    const std::string ensemble = make_report({place.path() / "empty"});
    CHECK(holds(ensemble, "no member has results"));
    CHECK(holds(ensemble, "no disk"));
}

TEST_CASE("of a result of another version what can be read is shown, and the rest named with its version") {
    const TemporaryFolder place;
    run_column(place.path() / "out", true);
    const hid_t file = H5Fopen((place.path() / "out/result.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    REQUIRE(file >= 0);
    // velocities of frames and frictional losses have gone elsewhere, energies are of another length
    CHECK(H5Ldelete(file, "/frames/velocity", H5P_DEFAULT) >= 0);
    CHECK(H5Lmove(file, "/losses/damping", file, "/losses/dashpots", H5P_DEFAULT, H5P_DEFAULT) >= 0);
    CHECK(H5Ldelete(file, "/energy/elastic", H5P_DEFAULT) >= 0);
    CHECK(H5Lcreate_hard(file, "/losses/ground", file, "/energy/elastic", H5P_DEFAULT, H5P_DEFAULT) >= 0);
    H5Fclose(file);
    renew_checksum(place.path() / "out/result.h5");
    const ReportContent content = read_places({place.path() / "out"});
    REQUIRE(content.runs.size() == 1);
    CHECK(content.runs[0].run.frames.time.empty());
    CHECK(content.runs[0].run.history.energy.empty());
    CHECK_FALSE(content.runs[0].run.losses.has_value());
    for (const char* gap : {"has no /frames/velocity", "has no /losses/damping", "/energy/elastic has another size"}) {
        CHECK_MESSAGE(std::any_of(content.remarks.begin(), content.remarks.end(),
                                  [&](const std::string& remark) { return holds(remark, gap) && holds(remark, "musim test wrote it"); }),
                      gap);
    }
    CHECK(holds(make_page(content, make_sections(content), "test"), "id=\"figure-spine_velocity\""));
    // whoever needs all of it gets an error
    CHECK_THROWS_AS(read_run(place.path() / "out"), ResultError);
}

TEST_CASE("numbers and texts that are of another kind than they should be are left out") {
    const TemporaryFolder place;
    run_column(place.path() / "pair/prototype", false);
    run_column(place.path() / "pair/1-25", false);
    nlohmann::json summary = read_checked_json(place.path() / "pair/1-25/summary.json");
    summary.update({{"energy_closure", nullptr}, {"similitude", nullptr}, {"steps", "many"}, {"warnings", nlohmann::json::array()}});
    write_json(place.path() / "pair/1-25/summary.json", summary);
    write_json(place.path() / "pair/pair.json",
               nlohmann::json::parse(R"({"pairs": [{"label": "1:25", "materials": 3, "consistent": "yes", "distortions": {},
        "alone": [7], "digits": null}, null]})"));
    CHECK(holds(make_report({place.path() / "pair"}), "1:25: ran to its end"));
    for (const char* pairs : {R"({"pairs": null})", R"({"pairs": {"label": 1}})"}) {
        write_json(place.path() / "pair/pair.json", nlohmann::json::parse(pairs));
        CHECK(holds(make_report({place.path() / "pair"}), "prototype: ran to its end"));
    }
    std::filesystem::create_directories(place.path() / "several");
    write_json(place.path() / "several/ensemble.json", nlohmann::json::parse(R"({"members": [{"name": 1, "seed": "x"}, 2]})"));
    CHECK(holds(make_report({place.path() / "several"}), "no member has results"));
    std::filesystem::remove(place.path() / "several/ensemble.json");
    write_json(place.path() / "several/sequence.json",
               nlohmann::json::parse(R"({"stages": [{"name": null, "since_stage_start": 3}, "x"]})"));
    CHECK(holds(make_report({place.path() / "several"}), "One motion after another"));
}

TEST_CASE("a folder with nothing to show is refused with what would help") {
    const TemporaryFolder place;
    for (const std::filesystem::path& folder : {place.path(), place.path() / "nowhere"}) {
        const std::string why = message_of<ResultError>([&] { read_places({folder}); });
        CHECK_MESSAGE(why.starts_with(folder.string() + ": there"), why);
    }
}

TEST_CASE("a specimen's report shows its blocks, tilts and forces as they were prepared") {
    const TemporaryFolder place;
    const SpecimenBatch batch{.scene = parse_scene(R"({"schema": "musim-scene/1", "name": "wall", "material": "wood",
        "structure": {"kind": "wall", "layers": 3, "blocks_per_layer": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"],
                      "height_deviation": "0.155 mm"}, "time": {"duration": "1 s"}, "output": {"spine_rate": "100 Hz"}})"),
                              .seeds = {1},
                              .folder = place.path(),
                              .version = "test",
                              .threads = 1};
    const SpecimenReport made = make_specimens(batch).front();
    const std::vector<double>& tilt = made.prepared.tilt;
    const ReportContent content = read_places({place.path()});
    REQUIRE(content.specimens.size() == 1);
    CHECK(content.specimens[0].specimen.tilt == tilt);
    CHECK(content.specimens[0].specimen.force == made.prepared.force);
    const std::string page = make_page(content, make_sections(content), "test");
    CHECK(holds(page, fmt::format("{} blocks prepared, at rest; the largest tilt is {:.3g}°", made.blocks,
                                  *std::max_element(tilt.begin(), tilt.end()) * 180.0 / std::numbers::pi)));
    CHECK(holds(page, "id=\"figure-tilt_1\""));
    CHECK(holds(page, "id=\"figure-contact_forces\""));
    CHECK(holds(page, "class=\"tower-data\""));
    CHECK_FALSE(holds(page, "id=\"spine\""));

    std::ofstream(place.path() / "specimen-damaged.h5") << "no HDF5";
    const ReportContent damaged = read_places({place.path()});
    CHECK(damaged.specimens.size() == 1);
    REQUIRE(damaged.remarks.size() == 1);
    CHECK(holds(damaged.remarks[0], "specimen-damaged.h5"));
}

TEST_CASE("records are drawn with their peaks, and those that cannot be read are named") {
    using namespace musim::records;
    const TemporaryFolder place;
    std::ofstream(place.path() / "made.at2") << "a record";
    std::ofstream(place.path() / "broken.at2") << "no record";
    const auto read = [](const std::filesystem::path& file) -> GroundMotion {
        if (file.stem() == "broken") throw ReadError(file.string() + ": line 1: no samples");
        std::vector<double> samples(400);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] = i == 100 ? 0.25 * 9.80665 : 0.1 * std::sin(0.1 * static_cast<double>(i));
        }
        return {.source = file.string(),
                .format = "made",
                .event = "Event",
                .station = "Place",
                .components = {{.name = "360",
                                .azimuth_deg = 0.0,
                                .series = {SampleQuantity::acceleration, 0.0 * musim::scaling::si::seconds,
                                           0.01 * musim::scaling::si::seconds, samples}}}};
    };
    const ReportContent content = read_content({place.path() / "made.at2", place.path() / "broken.at2"}, read);
    const std::string page = make_page(content, make_sections(content), "test");
    CHECK(holds(page, "<h1>Event, Place</h1>"));
    CHECK(holds(page, "0.25 at 1 s"));
    CHECK(holds(page, "id=\"figure-record_1\""));
    CHECK(holds(page, "line 1: no samples"));
    CHECK_FALSE(holds(page, "id=\"tower\""));
}

TEST_CASE("what a command printed as JSON is reported whole, its distortions first") {
    const TemporaryFolder place;
    std::ofstream(place.path() / "scale.json") << R"({"law": "mu", "factors": {"length": 0.25, "time": 0.5}, "groups": {},
        "distortions": [{"effect": "<i>grip</i>", "factor": 1.125, "group": "mu", "severity": "warning"}],
        "candidates": [{"law": "froude", "inside": {"cost": 12.5}}]})";
    std::ofstream(place.path() / "damaged.json") << "{\"law\": ";
    const std::string page = make_report({place.path() / "scale.json", place.path() / "damaged.json"});
    CHECK(holds(page, "<strong>warning</strong> scale.json: 1 group is distorted: mu"));
    CHECK(holds(page, "<th scope=\"row\">time</th><td class=\"number\">0.5</td>"));
    CHECK(holds(page, "<td class=\"warning\">warning</td>"));
    CHECK(holds(page, "<td class=\"number\">12.5</td>"));
    CHECK_FALSE(holds(page, "<i>"));
    CHECK(holds(page, "damaged.json: holds no JSON object"));
}

TEST_CASE("the base motion of a model is shown before and after it was rescaled") {
    const TemporaryFolder place;
    const Scene prototype = parse_scene(kColumn);
    const Scene model = scale_scene(prototype, musim::scaling::make_similitude("exact", {.length = 1.0 / 16.0}));
    ResultFolder results(place.path() / "out");
    results.add_run("", run_scene(model), {.scene = write_scene(model), .program_version = "test"});
    results.commit();
    const ReportContent content = read_places({place.path() / "out"});
    const std::optional<ReportSection> section = make_base_motion_section(content);
    REQUIRE(section.has_value());
    REQUIRE(section->figures.size() == 1);
    const std::vector<std::vector<HtmlCell>>& rows = section->figures[0].twin.rows;
    REQUIRE(rows.size() == 2);
    const auto peak = [&](std::size_t row, std::size_t column) { return std::stod(rows[row][column].text); };
    CHECK(rows[0][0].text == "x prototype");
    CHECK(rows[1][0].text == "x model");
    // exact: accelerations as they are, velocities to a quarter, displacements to a sixteenth; cells have four digits
    CHECK(peak(1, 1) == doctest::Approx(peak(0, 1)).epsilon(1e-3));
    CHECK(std::abs(peak(0, 1)) == doctest::Approx(0.2).epsilon(1e-2));
    CHECK(peak(1, 2) == doctest::Approx(peak(0, 2) / 4.0).epsilon(1e-3));
    CHECK(peak(1, 3) == doctest::Approx(peak(0, 3) / 16.0).epsilon(1e-3));
}

TEST_CASE("ensembles stand beside each other with their bands and how far they agree, and pairs and sequences have a page each") {
    const TemporaryFolder place;
    const Scene wall = parse_scene(R"({"schema": "musim-scene/1", "name": "wall", "material": "wood",
        "structure": {"kind": "wall", "layers": 2, "blocks_per_layer": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"],
                      "height_deviation": "0.1 mm"},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.3 g", "duration": "20 ms"},
        "time": {"duration": "20 ms"}, "output": {"spine_rate": "1 kHz"}})");
    for (const char* name : {"first", "second"}) {
        const std::filesystem::path folder = place.path() / name;
        ResultFolder results(folder);
        const std::vector<EnsembleMember> members = plan_ensemble(wall, 2, "test");
        const std::vector<MemberReport> reports = run_members(members, {.directory = folder, .version = "test", .threads = 1});
        add_ensemble(results, summarize_ensemble(folder, members, reports, std::nullopt), "test");
        results.commit();
    }
    const ReportContent content = read_places({place.path() / "first", place.path() / "second"});
    CHECK(content.ensembles.size() == 2);
    CHECK(content.runs.size() == 1);
    const std::string page = make_page(content, make_sections(content), "test");
    CHECK(holds(page, "first: 2 of 2 members stand, 0 collapsed"));
    CHECK(holds(page, "Members of first"));
    CHECK(holds(page, "Members of second"));
    CHECK(holds(page, "Agreement with first"));
    // the same members: all means are the same
    CHECK(holds(page, "<th scope=\"row\">second</th>"));
    CHECK(holds(page, "<td class=\"number\">100</td><td class=\"number\">100</td>"));
    CHECK(holds(page, "widest half of the band"));

    write_json(place.path() / "first/pair.json", nlohmann::json::parse(R"({"pairs": []})"));
    std::filesystem::copy(place.path() / "second/members", place.path() / "members", std::filesystem::copy_options::recursive);
    const ReportContent second = read_places({place.path() / "second", place.path() / "first"});
    CHECK(second.ensembles.size() == 1);
    CHECK(std::any_of(second.remarks.begin(), second.remarks.end(),
                      [](const std::string& remark) { return holds(remark, "first: left out"); }));
}
