#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/results/damage.hpp"
#include "lsdem/results/drift.hpp"
#include "lsdem/results/level_motion.hpp"
#include "lsdem/results/outcome.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/spine_measures.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/rotation.hpp"
#include "tests/study/made_run.hpp"
#include "tests/study/made_specimen.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::TemporaryFolder;

namespace {

/// A flat block on a ground that turns about y by 60 degrees within 4 s, about a point 3 m beside it, and is at rest then: it comes down by
/// more than its height and turns by more than 45 degrees, but neither slides nor tips on the ground.
struct TiltingTable {
    static constexpr double kMass = 2000.0, kGravity = 10.0, kStiffness = 1e9;  // [kg, m/s², Pa/m]
    static constexpr double kSide = 2.0, kHeight = 0.5;                         // [m]
    static constexpr double kAngle = std::numbers::pi / 3.0;                    // [rad]
    static constexpr double kDuration = 4.0;                                    // [s]

    Specimen specimen = make_column(1, 4.0);
    TimePlan plan;

    TiltingTable() {
        Model& model = specimen.model;
        model.shapes = {make_box_shape({kSide, kSide, kHeight}, {3, 3, 3})};
        model.blocks[0].mass = kMass;
        model.blocks[0].position = {0.0, 0.0, 0.5 * kHeight - kMass * kGravity / (kStiffness * kSide * kSide)};
        model.ground.motion = {};
        model.ground.motion.turn[1] = {.start = 0.0, .dt = 0.5 * kDuration, .velocity = {0.0, 2.0 * kAngle / kDuration, 0.0}};
        model.ground.motion.pivot = {-3.0, 0.0, 0.0};
        plan = make_plan(specimen, 0);
        plan.samples = static_cast<std::uint64_t>(std::ceil(1.1 * kDuration / (plan.time_step * 20.0)));
    }
};

void write_one_run(const std::filesystem::path& directory, const RunResult& run) {
    ResultFolder folder(directory);
    folder.add_run("", run, {.scene = "{}", .program_version = "1.2"});
    folder.commit();
}

}  // namespace

TEST_CASE("a block that stands on a turned ground has moved with it, and has neither drift nor damage") {
    using T = TiltingTable;
    const TiltingTable table;
    const RunResult run = simulate(table.specimen, table.plan);
    REQUIRE(run.status == RunStatus::completed);
    // it went with the ground: by 60 degrees about the point beside it
    const Vector3 arm(3.0, 0.0, run.initial.position[0].z());
    const Vector3 place = Vector3(-3.0, 0.0, 0.0) + Eigen::AngleAxisd(T::kAngle, Vector3::UnitY()) * arm;
    CHECK((run.final.position[0] - place).norm() < 1e-4);
    CHECK(run.final.position[0].z() < -T::kHeight);
    // in the frame of the ground its contact bears the weight aslant, at most as if it began to at once: twice what it does at rest
    const double weight = T::kMass * T::kGravity, area = T::kSide * T::kSide, second = area * T::kSide * T::kSide / 12.0;
    const double slip = weight * std::sin(T::kAngle) / (T::kStiffness * area);
    const double rock = weight * std::sin(T::kAngle) * 0.5 * T::kHeight / (T::kStiffness * second);
    const Damage damage = assess_damage(run);
    REQUIRE(damage.joints.size() == 1);
    CHECK(damage.joints[0].slip < 2.0 * slip);
    CHECK(damage.joints[0].slip > 0.5 * slip);
    CHECK(damage.each[0].rotation < 2.0 * rock);
    CHECK_FALSE(damage.each[0].fallen);
    CHECK(damage.levels[0].final_tilt.max < 2.0 * rock);
    CHECK(damage.index < (2.0 * slip + 2.0 * rock * T::kSide) / T::kSide);
    CHECK(std::isnan(run.falls.time[0]));

    const double moved = 2.0 * (slip + rock * T::kHeight), sunk = weight / (T::kStiffness * area);
    const std::vector<DriftPair> pairs = find_drift_pairs(run);
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        REQUIRE(find_shift(run, 0, k).norm() < moved);
        REQUIRE(find_drift(run, pairs, k).value < moved / (0.5 * T::kHeight));
        REQUIRE(run.history.spine_rotation[k].norm() < 2.0 * rock);
    }
    const SpineLevel level = measure_spine(run, 0).front();
    CHECK(level.peak_displacement.x() < moved);
    CHECK(level.peak_displacement.z() < 2.0 * sunk);
    CHECK(level.in_plane_peak < 2.0 * rock);
    CHECK(std::abs(measure_top(run).back().x.value()) < moved);

    const Outcome outcome = find_outcome(run);
    REQUIRE(outcome.base_turn);
    CHECK(outcome.base_turn->angle_at_end == doctest::Approx(T::kAngle).epsilon(1e-12));
    CHECK(outcome.base_turn->rate == doctest::Approx(2.0 * T::kAngle / T::kDuration).epsilon(0.01));
    CHECK(outcome.fallen == 0);
    CHECK(outcome.top_peak < moved);
    const std::vector<std::string> lines = describe(outcome);
    CHECK(std::any_of(lines.begin(), lines.end(), [](const std::string& line) { return line.starts_with("base turned by up to 60 deg"); }));
}

TEST_CASE("results of a ground that turns are read back as they were, and only they speak of turns") {
    TiltingTable table;
    table.plan.samples = 40;
    const RunResult run = simulate(table.specimen, table.plan);
    const TemporaryFolder folder;
    write_one_run(folder.path() / "turned", run);
    const StoredRun read = read_run(folder.path() / "turned");
    REQUIRE(read.history.samples() == run.history.samples());
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        const BaseState &is = read.history.base[k], &was = run.history.base[k];
        REQUIRE(is.turn.coeffs().isApprox(was.turn.coeffs(), 1e-15));
        REQUIRE(is.turn_rates.velocity == was.turn_rates.velocity);
        REQUIRE(is.turn_rates.acceleration == was.turn_rates.acceleration);
        REQUIRE(is.pivot == was.pivot);
    }
    CHECK(read.history.spine_rotation == run.history.spine_rotation);
    std::string head;
    std::ifstream csv(folder.path() / "turned" / "spine.csv");
    std::getline(csv, head);
    CHECK(head.starts_with("time_s,base_vx_m_s,base_vy_m_s,base_vz_m_s,base_wx_rad_s,base_wy_rad_s,base_wz_rad_s,level1_vx_m_s"));

    const RunResult still = make_made_run(20);
    write_one_run(folder.path() / "still", still);
    std::ifstream of_still(folder.path() / "still" / "spine.csv");
    std::getline(of_still, head);
    CHECK(head.starts_with("time_s,base_vx_m_s,base_vy_m_s,base_vz_m_s,level1_vx_m_s"));
    CHECK_FALSE(find_outcome(still).base_turn);
}

TEST_CASE("velocities seen from a base that turns are those against the point of the base below") {
    BaseState base;
    base.displacement = {0.1, 0.0, 0.0};
    base.velocity = {0.5, 0.0, 0.0};
    base.pivot = {1.0, 2.0, 0.0};
    base.turn = Quaternion(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitY()));
    base.turn_rates.velocity = {0.0, 0.25, 0.0};
    // 2 m above the pivot, along the base's own z axis, which points along x now
    const Vector3 x = base.pivot + base.displacement + Vector3(2.0, 0.0, 0.0), on_base = base.velocity_at(x);
    CHECK(on_base.isApprox(Vector3(0.5, 0.0, -0.5), 1e-15));
    CHECK(find_velocity_on_base(base, x, on_base).norm() < 1e-15);
    CHECK(find_velocity_on_base(base, x, on_base + Vector3(1.0, 0.0, 0.0)).isApprox(Vector3(0.0, 0.0, 1.0), 1e-15));
    CHECK(find_unturned_velocity(base, x, on_base).isApprox(base.turn.conjugate() * base.velocity, 1e-15));
    CHECK(find_moved(base, base.pivot + Vector3(0.0, 0.0, 2.0), x).norm() < 1e-15);
    CHECK(rotation_vector(Quaternion::Identity(), turn_back(base, base.turn)).norm() < 1e-15);

    // to the bit where nothing turns
    const BaseState slid{.displacement = {0.1, 0.2, 0.3}, .velocity = {0.7, 0.1, 0.3}};
    const Vector3 place(1.0 / 3.0, 1.0 / 7.0, 1.0 / 9.0), start(0.2, 0.1, 0.05);
    CHECK(find_moved(slid, start, place) == place - start - slid.displacement);
    CHECK(find_velocity_on_base(slid, place, place) == place - slid.velocity);
}
