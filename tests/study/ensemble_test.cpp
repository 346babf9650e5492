#include "lsdem/study/ensemble.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lsdem/results/checksum.hpp"
#include "lsdem/results/hdf5_file.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_ensembles.hpp"
#include "lsdem/study/ensemble_files.hpp"
#include "tests/study/made_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;

namespace {

/// Three samples of two levels whose velocity along x is `value` at level 1 and twice that at level 2.
History make_history(double value) {
    History history;
    for (int k = 0; k < 3; ++k) {
        history.time.push_back(0.5 * k);
        history.base.push_back({{0, 0, 0}, {1.0 * k, 0, 0}, {0, 0, 0}});
        for (const double factor : {1.0, 2.0}) {
            history.spine_position.emplace_back(0, 0, factor);
            history.spine_velocity.emplace_back(value * factor, 0.0, 0.0);
            history.spine_rotation.emplace_back(0, 0, 0);
        }
    }
    return history;
}

const Spine kSpine{.block = {0, 1}, .level = {1, 3}};

Scene make_wall(const std::string& more = "") {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "wall", "material": "concrete",
 "structure": {"kind": "wall", "layers": 3, "blocks_per_layer": 2, "block": ["54.4 mm", "112.8 mm", "170 mm"], "seed": 7,
               "height_deviation": "0.3 mm"},
 "time": {"duration": "0.1 s"})" +
                       more + "}");
}

constexpr const char* kRate = R"(, "output": {"spine_rate": "500 Hz"})";

}  // namespace

TEST_CASE("mean and standard deviation are those of the sample, with n - 1") {
    SampleMoments moments(1);
    CHECK(std::isnan(moments.mean()[0]));
    for (const double x : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) {
        if (moments.count() == 1) CHECK(std::isnan(moments.sd()[0]));
        moments.add(Eigen::ArrayXd::Constant(1, x));
    }
    CHECK(moments.count() == 8);
    // sums of eight small numbers: rounding only
    CHECK(moments.mean()[0] == doctest::Approx(5.0).epsilon(1e-15));
    CHECK(moments.sd()[0] == doctest::Approx(std::sqrt(32.0 / 7.0)).epsilon(1e-15));
    CHECK_THROWS_AS(moments.add(Eigen::ArrayXd::Zero(2)), std::invalid_argument);
}

TEST_CASE("a small scatter about a large mean is not lost") {
    SampleMoments moments(1);
    // the sum of squares would be 3e18 + 2, which a double cannot hold
    for (const double x : {1e9 - 1.0, 1e9, 1e9 + 1.0}) moments.add(Eigen::ArrayXd::Constant(1, x));
    CHECK(moments.sd()[0] == doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("bands hold mean, deviation and count per level, and a collapsed member counts until it collapses") {
    BandSum sum;
    sum.add(make_history(1.0), kSpine, {});
    sum.add(make_history(3.0), kSpine, {});
    sum.add(make_history(8.0), kSpine, 0.5);
    const Bands bands = sum.bands();
    REQUIRE(bands.samples() == 3);
    CHECK(bands.level == std::vector<int>{1, 3});
    CHECK(bands.count == std::vector<int>{3, 2, 2});
    CHECK(bands.base[2].velocity.x() == 2.0);
    // at level 1, then at level 2, twice as fast; small whole numbers, rounding only
    CHECK(bands.mean[0].x() == doctest::Approx(4.0).epsilon(1e-14));
    CHECK(bands.sd[0].x() == doctest::Approx(std::sqrt(13.0)).epsilon(1e-14));
    CHECK(bands.mean[1].x() == doctest::Approx(8.0).epsilon(1e-14));
    CHECK(bands.mean[2 * 2].x() == doctest::Approx(2.0).epsilon(1e-14));
    CHECK(bands.sd[2 * 2 + 1].x() == doctest::Approx(2.0 * std::sqrt(2.0)).epsilon(1e-14));
    CHECK(bands.sd[0].y() == 0.0);
}

TEST_CASE("bands scaled by powers of two are the same bits") {
    BandSum prototype, model;
    for (const double v : {0.3, 0.7, 1.1}) {
        prototype.add(make_history(v), kSpine, {});
        model.add(make_history(v / 4.0), kSpine, {});
    }
    const Bands p = prototype.bands(), m = model.bands();
    for (std::size_t i = 0; i < p.mean.size(); ++i) {
        CHECK(4.0 * m.mean[i] == p.mean[i]);
        CHECK(4.0 * m.sd[i] == p.sd[i]);
    }
}

TEST_CASE("members with other levels or other sampling times are refused, and change nothing") {
    BandSum sum;
    sum.add(make_history(1.0), kSpine, {});
    History late = make_history(1.0);
    late.time[1] += 1e-6;
    CHECK_THROWS_AS(sum.add(late, kSpine, {}), std::invalid_argument);
    CHECK_THROWS_AS(sum.add(make_history(1.0), Spine{.block = {0, 1}, .level = {1, 2}}, {}), std::invalid_argument);
    CHECK(sum.bands().count == std::vector<int>{1, 1, 1});
}

TEST_CASE("names follow from the scene, the seed and the version, and from nothing else") {
    const auto members = plan_ensemble(make_wall(kRate), 3, "1.0");
    REQUIRE(members.size() == 3);
    CHECK(members[0].seed == 7);
    CHECK(members[2].seed == 9);
    CHECK(members[0].name.size() == std::string("member-0123456789abcdef").size());
    CHECK(members[0].name != members[1].name);
    // more members: the same first ones
    CHECK(plan_ensemble(make_wall(kRate), 5, "1.0")[2].name == members[2].name);
    CHECK(plan_ensemble(make_wall(kRate), 1, "1.1")[0].name != members[0].name);
    CHECK(plan_ensemble(make_wall(R"(, "output": {"spine_rate": "501 Hz"})"), 1, "1.0")[0].name != members[0].name);
    CHECK(is_scene_of(write_scene(members[1].scene), members[1]));
    CHECK_FALSE(is_scene_of(write_scene(members[1].scene), members[2]));
}

TEST_CASE("what changes nothing in a scene changes no name") {
    const std::string name = plan_ensemble(make_wall(kRate), 1, "1.0")[0].name;
    const std::string idle = R"(, "shape": {"kind": "box", "nodes_per_face": 9}, "contact": {"nodes": "both"})";
    const auto members = plan_ensemble(make_wall(kRate + idle), 1, "1.0");
    CHECK(members[0].name == name);
    CHECK(is_scene_of(write_scene(members[0].scene), members[0]));
    CHECK(plan_ensemble(make_wall(kRate + std::string(R"(, "contact": {"faces": "nodes"})")), 1, "1.0")[0].name != name);
}

TEST_CASE("a scene that makes no ensemble is refused with the reason") {
    CHECK_THROWS_WITH_AS(plan_ensemble(make_wall(), 2, "1"), doctest::Contains("spine_rate"), SceneError);
    Scene even = make_wall(kRate);
    std::get<musim::lsdem::Wall>(even.structure).height_deviation = musim::scaling::Length{};
    CHECK_THROWS_WITH_AS(plan_ensemble(even, 2, "1"), doctest::Contains("height_deviation"), SceneError);
    Scene prepared = make_wall(kRate);
    prepared.preparation.emplace().specimen = "/tmp/specimen.h5";
    CHECK_THROWS_WITH_AS(plan_ensemble(prepared, 2, "1"), doctest::Contains("preparation.specimen"), SceneError);
}

TEST_CASE("a summary keeps every member, and takes means over those that are results") {
    const musim::tests::TemporaryFolder folder;
    const std::filesystem::path& directory = folder.path();
    const auto members = plan_ensemble(make_wall(kRate), 6, "1.0");
    const double amplitude[] = {1.0, 2.0, 4.0, 100.0, 100.0, 100.0};
    for (std::size_t i = 0; i < 5; ++i) {
        RunResult run = make_made_run(11);
        for (Vector3& v : run.history.spine_velocity) v *= amplitude[i];
        if (i == 2) {
            run.status = RunStatus::collapsed;
            run.collapse_time = run.history.time[4];
        }
        if (i == 3) {
            run.status = RunStatus::diverged;
            run.divergence = Divergence{.kind = Divergence::Kind::too_fast, .block = 1, .time = 0.05};
        }
        if (i == 4) run.rest = Rest{};
        ResultFolder results(member_folder(directory, members[i]), {.command = "ensemble", .program_version = "1.0", .parts = {}},
                             Overwriting::force);
        results.add_run("", run, {.scene = write_scene(members[i].scene), .program_version = "1.0"});
        results.commit();
        CHECK(find_state(directory, members[i]) == MemberState::finished);
    }
    std::vector<MemberReport> reports(6);
    reports[5].error = "no room";
    const EnsembleSummary summary = summarize_ensemble(directory, members, reports);
    const MemberStatus expected[] = {MemberStatus::completed, MemberStatus::completed, MemberStatus::collapsed,
                                     MemberStatus::diverged,  MemberStatus::unsettled, MemberStatus::failed};
    for (std::size_t i = 0; i < 6; ++i) CHECK(summary.members[i].status == expected[i]);
    CHECK(summary.members[3].reason.find("crosses more than half") != std::string::npos);
    CHECK(summary.members[5].reason == "no room");

    // the sample of peaks is {0.7, 1.4} at the top: the collapsed one has none
    REQUIRE(summary.levels.size() == 2);
    CHECK(summary.levels[1].peak_velocity.count() == 2);
    CHECK(summary.levels[1].peak_velocity.mean()[0] == doctest::Approx(1.05).epsilon(1e-14));
    CHECK(summary.levels[1].peak_velocity.sd()[0] == doctest::Approx(0.7 / std::sqrt(2.0)).epsilon(1e-14));
    CHECK(summary.bands.count == std::vector<int>{3, 3, 3, 3, 2, 2, 2, 2, 2, 2, 2});
    CHECK(summary.bands.mean[1].x() == doctest::Approx(0.7 * 7.0 / 3.0).epsilon(1e-14));

    const nlohmann::json json = to_json(summary, "1.0");
    CHECK(json["counts"]["completed"] == 2);
    CHECK(json["counts"]["failed"] == 1);
    CHECK(json["members"][2]["collapse_time_s"] == doctest::Approx(0.04));
    CHECK(make_svg(make_ensemble_plot(summary)).find("class=\"band\"") != std::string::npos);

    // results of another member under this one's name are not taken
    std::filesystem::remove_all(member_folder(directory, members[0]));
    std::filesystem::rename(member_folder(directory, members[1]), member_folder(directory, members[0]));
    const EnsembleSummary mixed = summarize_ensemble(directory, {members[0]}, {MemberReport{}});
    CHECK(mixed.members[0].status == MemberStatus::failed);
    CHECK(mixed.members[0].reason.find("another scene") != std::string::npos);
}

TEST_CASE("overlap is the fraction of levels and times at which the other's mean lies in the band, or within two standard errors") {
    const auto make = [](std::initializer_list<double> values, double time_factor) {
        BandSum sum;
        for (const double v : values) {
            History history = make_history(v);
            for (double& t : history.time) t *= time_factor;
            sum.add(history, kSpine, {});
        }
        return DimensionlessBands{.name = "made", .axis = 0, .bands = sum.bands()};
    };
    // mean 2, sd sqrt(2) at level 1; twice that at level 2
    const DimensionlessBands first = make({1.0, 3.0}, 1.0);
    // 1.3 away: in the band; the standard error of the difference is sqrt(2/2 + 0.02/2) = 1.005
    const BandOverlap close = compare_bands(first, make({3.2, 3.4}, 1.0));
    CHECK(close.points == 6);
    CHECK(close.within_sd == 1.0);
    CHECK(close.within_error == 1.0);
    // 1.9 away: out of the band, within two standard errors; 2.2 away: in neither
    CHECK(compare_bands(first, make({3.8, 4.0}, 1.0)).within_sd == 0.0);
    CHECK(compare_bands(first, make({3.8, 4.0}, 1.0)).within_error == 1.0);
    CHECK(compare_bands(first, make({4.1, 4.3}, 1.0)).within_error == 0.0);
    // one that ends halfway is compared up to there, between its samples too
    CHECK(compare_bands(first, make({3.2, 3.4}, 0.75)).points == 4);
    CHECK_THROWS_AS(compare_bands(first, make({1.0}, 1.0)), ResultError);
}

TEST_CASE("bands whose summary is of another kind than is expected are refused") {
    const musim::tests::TemporaryFolder folder;
    const auto read = [&](const std::string& summary) {
        detail::Hdf5File file;
        file.write_attribute("summary", summary);
        const std::vector<char> bytes = file.image();
        folder.write("ensemble.h5", {bytes.data(), bytes.size()});
        return read_bands(folder.path());
    };
    const std::string scales = R"("scales": {"sliding_speed_m_s": 1.0, "height_m": 1.0})";
    for (const std::string& summary : {std::string("[]"), std::string(R"({"format": "musim-ensemble/1"})"),
                                       R"({"format": 1, )" + scales + "}", std::string(R"({"format": "musim-ensemble/1", "scales": null})"),
                                       std::string(R"({"format": "musim-ensemble/1", "scales": {"sliding_speed_m_s": "x"}})"),
                                       R"({"format": "musim-ensemble/1", "axis": "q", )" + scales + "}",
                                       R"({"format": "musim-ensemble/1", "axis": 0, )" + scales + "}"}) {
        CAPTURE(summary);
        CHECK_THROWS_WITH_AS(read(summary), doctest::Contains("is no ensemble; name the directory of one"), ResultError);
    }
}
