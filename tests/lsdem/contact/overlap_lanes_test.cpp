#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

#include "lsdem/contact/contact_area.hpp"
#include "lsdem/contact/overlap.hpp"
#include "lsdem/contact/overlap_lanes.hpp"
#include "lsdem/detail/instructions.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::detail;

namespace {

constexpr double kPi = std::numbers::pi;

/// Two boxes that overlap by about `depth`.
struct Boxes {
    Vector3 half_a, half_b, place_a, place_b;
    Matrix3 rotation_a, rotation_b;
    double depth = 0.0;

    BoxMeeting meeting() const {
        return {{rotation_a.data(), place_a.data(), half_a.data(), 0, 1.0}, {rotation_b.data(), place_b.data(), half_b.data(), 0, 1.0}};
    }
    OverlapPieces cut() const {
        PlacedSolid a, b;
        const Vector3 half_way = 0.5 * (place_b - place_a);
        place_box(half_a, rotation_a, -half_way, a);
        place_box(half_b, rotation_b, half_way, b);
        OverlapPieces pieces;
        pieces.cut(a, b);
        return pieces;
    }
    double size() const { return place_a.norm() + half_a.norm() + half_b.norm(); }
};

/// Poses of masonry: flush, turned by 90 degrees and half over each other, tilted, twisted and shifted a little, and any.
class Poses {
  public:
    Boxes next() {
        Boxes boxes;
        boxes.half_a = boxes.half_b = Vector3(0.16, 0.33, 0.5);
        double tilt = 0.0, twist = 0.0;
        boxes.depth = size_between(1e-7, 1e-3);
        Vector3 shift(0.0, 0.0, 0.0);
        switch (count_++ % 5) {
            case 0:
                twist = flip() ? size_between(1e-9, 1e-3) : 0.0, shift.x() = flip() ? 3.0 * even() * boxes.depth : 0.0;
                break;
            case 1:
                tilt = size_between(1e-7, 1e-3), twist = size_between(1e-6, 1e-2), shift.y() = 1e-3 * even();
                break;
            case 2:
                twist = 0.5 * kPi + (flip() ? 1e-3 * even() : 0.0), shift.x() = 0.17 + 2.0 * even() * boxes.depth;
                break;
            case 3:
                tilt = size_between(1e-7, 1e-2), twist = 0.1 * even(), shift = Vector3(0.15 * even(), 0.3 * even(), 0.0);
                break;
            default:
                tilt = size_between(1e-7, 0.3), twist = 3.0 * even(), shift = Vector3(0.3 * even(), 0.5 * even(), 0.0);
                boxes.half_b = Vector3(0.4, 0.4, 0.4) + 0.3 * Vector3(even(), even(), even());
        }
        const double direction = kPi * even();
        const Matrix3 turn =
            (Eigen::AngleAxisd(tilt, Vector3(std::cos(direction), std::sin(direction), 0.0)) * Eigen::AngleAxisd(twist, Vector3::UnitZ()))
                .toRotationMatrix();
        boxes.rotation_a = flip() ? Matrix3(Matrix3::Identity()) : Matrix3(Quaternion(even(), even(), even(), even()).normalized());
        boxes.rotation_b = boxes.rotation_a * turn;
        boxes.place_a = 3.0 * Vector3(even(), even(), even());
        double low = 0.0, high = 2.0;
        for (int i = 0; i < 60; ++i) {
            shift.z() = 0.5 * (low + high);
            boxes.place_b = boxes.place_a + boxes.rotation_a * shift;
            (sum_load(boxes.cut()).deepest > boxes.depth ? low : high) = shift.z();
        }
        return boxes;
    }

  private:
    double even() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
    bool flip() { return even() > 0.0; }
    double size_between(double low, double high) { return low * std::pow(high / low, 0.5 + 0.5 * even()); }
    std::mt19937_64 random_{3};
    std::size_t count_ = 0;
};

Vector3 lane_of(const Lanes3& v, std::size_t lane) {
    return {reinterpret_cast<const double*>(&v.x)[lane], reinterpret_cast<const double*>(&v.y)[lane],
            reinterpret_cast<const double*>(&v.z)[lane]};
}
double lane_of(const Lanes& v, std::size_t lane) { return reinterpret_cast<const double*>(&v)[lane]; }

/// Four pairs side by side, and whether each holds.
struct FourPairs {
    std::array<Boxes, 4> boxes;
    std::array<BoxMeeting, 4> meetings;
    std::array<bool, 4> holds{};
    LaneOverlap found;

    explicit FourPairs(Poses& poses) {
        for (std::size_t i = 0; i < 4; ++i) {
            boxes[i] = poses.next();
            meetings[i] = boxes[i].meeting();
            holds[i] = choose_faces(meetings[i]);
        }
        compute_overlaps(meetings.data(), found);
        for (std::size_t i = 0; i < 4; ++i) holds[i] = holds[i] && reinterpret_cast<const std::int64_t*>(&found.irregular)[i] == 0;
    }
    FourPairs(const FourPairs&) = delete;
    FourPairs& operator=(const FourPairs&) = delete;
    ~FourPairs() = default;
};

}  // namespace

// 6 eps size/d: the depth is a difference of coordinates; lanes say by themselves where they do not hold
TEST_CASE("four pairs side by side give the load of the exact function wherever they say that they hold") {
    Poses poses;
    std::size_t held = 0, asked = 0;
    for (int group = 0; group < 1500; ++group) {
        const FourPairs four(poses);
        const auto& [boxes, meetings, holds, found] = four;
        for (std::size_t i = 0; i < 4; ++i) {
            ++asked;
            if (!holds[i]) continue;
            ++held;
            const OverlapPieces pieces = boxes[i].cut();
            const OverlapLoad load = sum_load(pieces);
            if (!(load.deepest > 0.0)) continue;
            const double size = boxes[i].size(), tolerance = 6.0 * std::numeric_limits<double>::epsilon() * size / load.deepest;
            const double force = load.force.norm();
            CHECK((lane_of(found.force, i) - load.force).norm() <= tolerance * force);
            CHECK((lane_of(found.moment, i) - load.moment).norm() <= tolerance * force * size);
            CHECK(lane_of(found.deepest, i) == doctest::Approx(load.deepest).epsilon(1e-6).scale(0.0));
        }
    }
    // of all these poses some corners and edges do not hold
    CHECK(held > asked * 9 / 10);
}

TEST_CASE("boxes that lie beside each other at one height give nothing, or say that they do not hold") {
    Poses poses;
    for (int group = 0; group < 200; ++group) {
        std::array<Boxes, 4> boxes;
        std::array<BoxMeeting, 4> meetings;
        for (std::size_t i = 0; i < 4; ++i) {
            boxes[i] = poses.next();
            boxes[i].place_b += boxes[i].rotation_a * Vector3(1.1, 0.1 * static_cast<double>(i), 0.0);
            meetings[i] = boxes[i].meeting();
            choose_faces(meetings[i]);
        }
        LaneOverlap found;
        compute_overlaps(meetings.data(), found);
        for (std::size_t i = 0; i < 4; ++i) {
            if (boxes[i].cut().size() > 0 || reinterpret_cast<const std::int64_t*>(&found.irregular)[i] != 0) continue;
            CHECK(lane_of(found.force, i).isZero(0.0));
            CHECK(lane_of(found.moment, i).isZero(0.0));
            CHECK(lane_of(found.area, i) == 0.0);
        }
    }
}

TEST_CASE("the lane, the company and the instructions change no bit of a pair") {
    Poses poses;
    for (int group = 0; group < 100; ++group) {
        std::array<Boxes, 4> boxes;
        std::array<BoxMeeting, 4> meetings, turned;
        for (std::size_t i = 0; i < 4; ++i) boxes[i] = poses.next();
        for (std::size_t i = 0; i < 4; ++i) {
            meetings[i] = boxes[i].meeting();
            turned[3 - i] = boxes[i].meeting();
            choose_faces(meetings[i]);
            choose_faces(turned[3 - i]);
        }
        const std::array<BoxMeeting, 4> alone{meetings[0], meetings[0], meetings[0], meetings[0]};
        LaneOverlap all, back, one, plain;
        compute_overlaps(meetings.data(), all);
        compute_overlaps(turned.data(), back);
        compute_overlaps(alone.data(), one);
        limit_instructions(Instructions::plain);
        compute_overlaps(meetings.data(), plain);
        limit_instructions(Instructions::avx2);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(lane_of(all.force, i) == lane_of(back.force, 3 - i));
            CHECK(lane_of(all.moment, i) == lane_of(back.moment, 3 - i));
            CHECK(lane_of(all.force, i) == lane_of(plain.force, i));
            CHECK(lane_of(all.area_square, i) == lane_of(plain.area_square, i));
        }
        CHECK(lane_of(all.force, 0) == lane_of(one.force, 0));
        CHECK(lane_of(all.moment, 0) == lane_of(one.moment, 0));
    }
}

// strips along the edges of a flat contact, as wide as its depth, are no part of it
TEST_CASE("four pairs side by side give the area of the exact function") {
    Poses poses;
    for (int group = 0; group < 300; ++group) {
        const FourPairs four(poses);
        const auto& [boxes, meetings, holds, found] = four;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!holds[i]) continue;
            const OverlapPieces pieces = boxes[i].cut();
            const OverlapLoad load = sum_load(pieces);
            if (!(load.deepest > 0.0)) continue;
            const ContactArea exact = find_contact_area(pieces, Vector3::Zero());
            const auto normal_of = [](const BoxMeeting::Box& box) -> Vector3 {
                return box.sign * Eigen::Map<const Matrix3>(box.rotation).col(box.axis);
            };
            const double share = share_of_facing(-normal_of(meetings[i].a).dot(normal_of(meetings[i].b)));
            const double area = share * lane_of(found.area, i), width = std::sqrt(area);
            // where twisted boxes meet by a corner, bits of their sides, as large as the depth, face each other too; rounding moves edges
            const double tolerance = 1e-9 + 20.0 * load.deepest * load.deepest / area +
                                     50.0 * std::numeric_limits<double>::epsilon() * boxes[i].size() / load.deepest * (1.0 + 1.0 / width);
            CHECK(area == doctest::Approx(exact.area).epsilon(tolerance).scale(0.0));
            CHECK((lane_of(found.area_place, i) / lane_of(found.area, i) - exact.arm).norm() < tolerance * boxes[i].size());
            const Vector3 square = share * lane_of(found.area_square, i);
            // the faces of both bodies are as far apart as they overlap
            const double allowed = area * (tolerance * boxes[i].size() * width + load.deepest * load.deepest);
            CHECK((square - exact.second.diagonal()).norm() < allowed);
        }
    }
}
