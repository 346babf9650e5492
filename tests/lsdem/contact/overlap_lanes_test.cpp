#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <Eigen/Eigenvalues>
#include <limits>
#include <numbers>
#include <random>

#include "lsdem/contact/contact_area.hpp"
#include "lsdem/contact/contact_step.hpp"
#include "lsdem/contact/overlap.hpp"
#include "lsdem/contact/overlap_lanes.hpp"
#include "tests/lsdem/contact/main_cell_questions.hpp"
#include "tests/lsdem/contact/placed_boxes.hpp"
#include "tests/support/trials.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::detail;
using namespace musim::lsdem::tests;

namespace {

/// Pairs side by side, and whether each holds.
struct PairsInLanes {
    std::array<Boxes, kLanePairs> boxes;
    std::array<BoxMeeting, kLanePairs> meetings;
    std::array<bool, kLanePairs> holds{};
    std::array<LaneFinding, kLanePairs> found;

    template <class Next>
    explicit PairsInLanes(const Next& next) {
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            boxes[i] = next();
            meetings[i] = boxes[i].meeting();
        }
        compute_overlaps(meetings.data(), kLanePairs, found.data());
        for (std::size_t i = 0; i < kLanePairs; ++i) holds[i] = !found[i].irregular;
    }
    PairsInLanes(const PairsInLanes&) = delete;
    PairsInLanes& operator=(const PairsInLanes&) = delete;
    ~PairsInLanes() = default;
};

}  // namespace

// 6 eps size/d: the depth is a difference of coordinates; lanes say by themselves where they do not hold
TEST_CASE("pairs side by side give the load of the exact function wherever they say that they hold") {
    Poses poses;
    std::size_t held = 0, asked = 0;
    for (int group = 0; group < musim::tests::trials(750); ++group) {
        const PairsInLanes pairs([&] { return poses.next(); });
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            ++asked;
            if (!pairs.holds[i]) continue;
            ++held;
            const OverlapLoad load = sum_load(pairs.boxes[i].cut());
            if (!(load.deepest > 0.0)) continue;
            const LaneFinding& found = pairs.found[i];
            const double size = pairs.boxes[i].size(), tolerance = 6.0 * std::numeric_limits<double>::epsilon() * size / load.deepest;
            const double force = load.force.norm();
            CHECK((found.force - load.force).norm() <= tolerance * force);
            CHECK((found.moment - load.moment).norm() <= tolerance * force * size);
            CHECK(found.deepest == doctest::Approx(load.deepest).epsilon(1e-6).scale(0.0));
            // what is left out lies at corners; some faces are narrower than the root of their area
            const double exact = pairs.boxes[i].energy(), sunk = load.deepest / std::sqrt(found.area);
            CHECK(std::abs(found.energy - exact) <= (2.0 * tolerance + 60.0 * sunk * sunk) * exact);
        }
    }
    // of all these poses some corners and edges do not hold
    CHECK(held > asked * 9 / 10);
}

// of a tip whole boxes overlap by their tilt, sideways often less than in height
TEST_CASE("tilted boxes that meet by a tip are named the faces that touch") {
    Poses poses;
    constexpr std::size_t kPoses = 400;
    std::size_t named = 0;
    for (std::size_t i = 0; i < kPoses; ++i) {
        const Boxes boxes = poses.next(Poses::Kind::on_tip);
        const ContactArea area = find_contact_area(boxes.cut(), Vector3::Zero());
        // normal of the touching area: across it has no second moment
        const Vector3 normal = Eigen::SelfAdjointEigenSolver<Matrix3>(area.second).eigenvectors().col(0);
        const auto faces = choose_faces(boxes.meeting());
        for (std::size_t k = 0; k < 3; ++k) {
            const bool across = std::abs(normal.dot(boxes.a.rotation.col(static_cast<Eigen::Index>(k)))) > 0.9;
            named += across && faces.along[0][k] ? 1 : 0;
        }
    }
    CHECK(named > kPoses * 9 / 10);
}

TEST_CASE("boxes that lie beside each other at one height give nothing or say that they do not hold") {
    Poses poses;
    int checked = 0;
    for (int group = 0; group < 100; ++group) {
        double aside = 0.0;
        const PairsInLanes pairs([&] {
            Boxes boxes = poses.next();
            boxes.b.position += boxes.a.rotation * Vector3(1.1, 0.1 * aside++, 0.0);
            return boxes;
        });
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            const OverlapPieces pieces = pairs.boxes[i].cut();
            if (pieces.begin() != pieces.end() || !pairs.holds[i]) continue;
            ++checked;
            CHECK(pairs.found[i].force.isZero(0.0));
            CHECK(pairs.found[i].moment.isZero(0.0));
            CHECK(pairs.found[i].area == 0.0);
        }
    }
    CHECK(checked > 100);
}

// strips along the edges of a flat contact, as wide as its depth, are no part of it
TEST_CASE("pairs side by side give the area of the exact function") {
    Poses poses;
    for (int group = 0; group < musim::tests::trials(150); ++group) {
        const PairsInLanes pairs([&] { return poses.next(); });
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            if (!pairs.holds[i]) continue;
            const OverlapPieces pieces = pairs.boxes[i].cut();
            const OverlapLoad load = sum_load(pieces);
            if (!(load.deepest > 0.0)) continue;
            const LaneFinding& found = pairs.found[i];
            const ContactArea exact = find_contact_area(pieces, Vector3::Zero());
            const double area = found.area, width = std::sqrt(area), size = pairs.boxes[i].size();
            // rounding moves edges
            const double tolerance = 50.0 * std::numeric_limits<double>::epsilon() * size / load.deepest * (1.0 + 1.0 / width);
            CHECK(area == doctest::Approx(exact.area).epsilon(tolerance).scale(0.0));
            CHECK((found.area_place / found.area - exact.arm).norm() < tolerance * size);
            // the faces of both bodies are as far apart as they overlap
            const double allowed = area * (tolerance * size * width + load.deepest * load.deepest);
            CHECK((found.area_square - exact.second.diagonal()).norm() < allowed);
        }
    }
}

namespace {

/// Dashpots that pull on none, some or all of a contact, about its middle, and where it is pressed.
MainCellQuestion make_question(const OverlapPieces& pieces, std::mt19937_64& random) {
    const auto even = [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
    const OverlapLoad load = sum_load(pieces);
    MainCellQuestion question{.dashpot = {}, .stiffness = 1e9, .normal = load.force.normalized(), .about = Vector3::Zero()};
    question.about = load.force.cross(load.moment) / load.force.squaredNorm();
    const double pressure = question.stiffness * load.deepest;
    question.dashpot = {even() * pressure, pressure * std::pow(10.0, 3.0 * even() - 2.0) * Vector3(even(), even(), even()),
                        find_contact_area(pieces, Vector3::Zero()).arm};
    return question;
}

}  // namespace

// as for the area: to rounding of the positions over the depth
TEST_CASE("main cells give the reach of friction and what dashpots would pull as all pieces do") {
    Poses poses;
    std::mt19937_64 random(7);
    for (int group = 0; group < musim::tests::trials(400); ++group) {
        const PairsInLanes pairs([&] { return poses.next(); });
        std::array<MainCellQuestion, kLanePairs> questions{};
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            const OverlapPieces pieces = pairs.boxes[i].cut();
            if (pairs.holds[i] && pieces.begin() != pieces.end()) questions[i] = make_question(pieces, random);
        }
        std::array<MainCellAnswer, kLanePairs> answers;
        ask_main_cells(pairs.meetings.data(), questions.data(), answers.data());
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            const OverlapPieces pieces = pairs.boxes[i].cut();
            if (!pairs.holds[i] || !(pairs.found[i].area > 0.0)) continue;
            const double depth = sum_load(pieces).deepest, area = pairs.found[i].area, size = pairs.boxes[i].size();
            const double tolerance = 50.0 * std::numeric_limits<double>::epsilon() * size / depth * (1.0 + 1.0 / std::sqrt(area));
            const MainCellQuestion& question = questions[i];
            CHECK(answers[i].reach == doctest::Approx(find_reach(pieces, question.normal, question.about)).epsilon(tolerance).scale(0.0));
            const PressureMoments pull = find_pull(pieces, question.dashpot, question.stiffness);
            const double most = (question.stiffness * depth + std::abs(question.dashpot.at) + question.dashpot.slope.norm() * size) * area;
            CHECK(std::abs(answers[i].pull.sum - pull.sum) <= tolerance * most);
            CHECK((answers[i].pull.at - pull.at).norm() <= tolerance * most * size);
            // the bound never misses a pull
            if (!answers[i].may_pull) CHECK(answers[i].pull.sum == 0.0);
            CHECK(answers[i].least_reach <= answers[i].reach);
        }
    }
}

// of a square of side a pressed evenly r̄ = (√2 + ln(1 + √2)) a/6; of the disc that bears as much 2/3 a/√π, 1.7 % less
TEST_CASE("the least reach of an even square is that of the disc of its area") {
    Boxes boxes;
    boxes.a.half = boxes.b.half = Vector3::Constant(0.5);
    boxes.b.position.z() = 1.0 - 1e-6;
    std::array<BoxMeeting, kLanePairs> meetings;
    meetings.fill(boxes.meeting());
    std::array<MainCellQuestion, kLanePairs> questions{};
    questions.fill({.dashpot = {}, .stiffness = 1.0, .normal = Vector3::UnitZ(), .about = Vector3::Zero()});
    std::array<MainCellAnswer, kLanePairs> answers;
    ask_main_cells(meetings.data(), questions.data(), answers.data());
    // strips as wide as the depth are no part of the cell
    CHECK(answers[0].reach == doctest::Approx((std::numbers::sqrt2 + std::log(1.0 + std::numbers::sqrt2)) / 6.0).epsilon(1e-5));
    CHECK(answers[0].least_reach == doctest::Approx(2.0 / 3.0 / std::sqrt(std::numbers::pi)).epsilon(1e-5));
}

// Cells of blocks that stand edge on edge have edges of the length of rounding, which may vanish as they are projected.
TEST_CASE("blocks that rock in one plane edge on edge have the reach of all pieces at every pose") {
    std::mt19937_64 random(10);
    const auto even = [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
    int checked = 0;
    for (int group = 0; group < musim::tests::trials(400); ++group) {
        const PairsInLanes pairs([&] {
            Boxes b;
            b.a.half = b.b.half = Vector3::Constant(0.5);
            b.a.rotation = Eigen::AngleAxisd(2e-4 * even(), Vector3::UnitY()).toRotationMatrix();
            b.b.rotation = Eigen::AngleAxisd(2e-4 * even(), Vector3::UnitY()).toRotationMatrix();
            b.a.position = {0.0, 0.0, 0.5};
            b.b.position = {2e-4 * even(), 0.0, 1.5 - 2e-5};
            return b;
        });
        std::array<MainCellQuestion, kLanePairs> questions;
        for (std::size_t i = 0; i < kLanePairs; ++i) questions[i] = make_question(pairs.boxes[i].cut(), random);
        std::array<MainCellAnswer, kLanePairs> answers;
        ask_main_cells(pairs.meetings.data(), questions.data(), answers.data());
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            if (!pairs.holds[i]) continue;
            ++checked;
            const double depth = pairs.found[i].deepest, tolerance = 1e-9 + 20.0 * depth * depth / pairs.found[i].area + 1e-13 / depth;
            const double reach = find_reach(pairs.boxes[i].cut(), questions[i].normal, questions[i].about);
            CHECK(std::abs(answers[i].reach / reach - 1.0) < tolerance);
        }
    }
    CHECK(checked > 1000);
}

TEST_CASE("the lane and its neighbors in the lanes change no bit of a pair") {
    Poses poses;
    std::mt19937_64 random(8);
    for (int group = 0; group < 100; ++group) {
        const PairsInLanes pairs([&] { return poses.next(); });
        std::array<BoxMeeting, kLanePairs> back, alone;
        std::array<MainCellQuestion, kLanePairs> questions, questions_back, questions_alone;
        for (std::size_t i = 0; i < kLanePairs; ++i) questions[i] = make_question(pairs.boxes[i].cut(), random);
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            back[i] = pairs.meetings[kLanePairs - 1 - i], questions_back[i] = questions[kLanePairs - 1 - i];
            alone[i] = pairs.meetings[0], questions_alone[i] = questions[0];
        }
        const auto find = [](const auto& meetings) {
            std::array<LaneFinding, kLanePairs> found;
            compute_overlaps(meetings.data(), kLanePairs, found.data());
            return found;
        };
        const auto ask = [](const auto& meetings, const auto& of) {
            std::array<MainCellAnswer, kLanePairs> answers;
            ask_main_cells(meetings.data(), of.data(), answers.data());
            return answers;
        };
        const auto found_back = find(back), found_alone = find(alone);
        const auto answers = ask(pairs.meetings, questions), answers_back = ask(back, questions_back),
                   answers_alone = ask(alone, questions_alone);
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            if (!pairs.holds[i]) continue;
            CHECK((pairs.found[i] == found_back[kLanePairs - 1 - i]));
            CHECK((answers[i] == answers_back[kLanePairs - 1 - i]));
        }
        if (pairs.holds[0]) CHECK((pairs.found[0] == found_alone[5] && answers[0] == answers_alone[5]));
    }
}

// lengths times four: areas times 16, forces per stiffness times 64
TEST_CASE("pairs four times as large give the same bits") {
    Poses poses;
    std::mt19937_64 random(9);
    for (int group = 0; group < 100; ++group) {
        const PairsInLanes pairs([&] { return poses.next(); });
        std::array<Boxes, kLanePairs> boxes = pairs.boxes;
        std::array<BoxMeeting, kLanePairs> large;
        std::array<MainCellQuestion, kLanePairs> questions, large_questions;
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            for (Vector3* const v : {&boxes[i].a.half, &boxes[i].b.half, &boxes[i].a.position, &boxes[i].b.position}) *v *= 4.0;
            large[i] = boxes[i].meeting();
            questions[i] = make_question(pairs.boxes[i].cut(), random);
            large_questions[i] = questions[i];
            large_questions[i].about *= 4.0, large_questions[i].dashpot.about *= 4.0, large_questions[i].dashpot.at *= 4.0;
        }
        std::array<LaneFinding, kLanePairs> found;
        std::array<MainCellAnswer, kLanePairs> answers, large_answers;
        compute_overlaps(large.data(), kLanePairs, found.data());
        ask_main_cells(pairs.meetings.data(), questions.data(), answers.data());
        ask_main_cells(large.data(), large_questions.data(), large_answers.data());
        for (std::size_t i = 0; i < kLanePairs; ++i) {
            CHECK(found[i].irregular == pairs.found[i].irregular);
            if (!pairs.holds[i]) continue;
            CHECK(found[i].force == 64.0 * pairs.found[i].force);
            CHECK(found[i].moment == 256.0 * pairs.found[i].moment);
            CHECK(found[i].area == 16.0 * pairs.found[i].area);
            CHECK(large_answers[i].reach == 4.0 * answers[i].reach);
            CHECK(large_answers[i].pull.sum == 64.0 * answers[i].pull.sum);
            CHECK(large_answers[i].pull.at == 256.0 * answers[i].pull.at);
        }
    }
}
