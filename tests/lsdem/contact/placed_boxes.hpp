#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/overlap.hpp"

namespace musim::lsdem::tests {

/// Two boxes that overlap by about `depth`.
struct Boxes {
    BodyPose a, b;
    double depth = 0.0;

    detail::BoxMeeting meeting() const { return {&a, &b}; }
    OverlapPieces cut() const {
        const PlacedPair placed(meeting());
        OverlapPieces pieces;
        pieces.cut(placed.a, placed.b);
        return pieces;
    }
    double energy() const {
        const PlacedPair placed(meeting());
        return compute_overlap_energy(placed.a, placed.b, cut());
    }
    double size() const { return a.position.norm() + a.half.norm() + b.half.norm(); }
};

/// Poses of masonry: flush, turned by 90 degrees and half over each other, tilted, twisted and shifted a little, any, and on narrow seats
/// and tips.
class Poses {
  public:
    enum class Kind : std::size_t { flush, tilted, turned, twisted, any, on_seat, on_tip };
    static constexpr std::size_t kKinds = 7;
    Boxes next() { return next(static_cast<Kind>(count_++ % kKinds)); }
    Boxes next(Kind kind) {
        Boxes boxes;
        boxes.a.half = boxes.b.half = Vector3(0.16, 0.33, 0.5);
        double tilt = 0.0, twist = 0.0;
        boxes.depth = size_between(1e-7, 1e-3);
        Vector3 shift(0.0, 0.0, 0.0);
        switch (kind) {
            case Kind::flush:
                twist = flip() ? size_between(1e-9, 1e-3) : 0.0, shift.x() = flip() ? 3.0 * even() * boxes.depth : 0.0;
                break;
            case Kind::tilted:
                tilt = size_between(1e-7, 1e-3), twist = size_between(1e-6, 1e-2), shift.y() = 1e-3 * even();
                break;
            case Kind::turned:
                twist = 0.5 * std::numbers::pi + (flip() ? 1e-3 * even() : 0.0), shift.x() = 0.17 + 2.0 * even() * boxes.depth;
                break;
            case Kind::twisted:
                tilt = size_between(1e-7, 1e-2), twist = 0.1 * even(), shift = Vector3(0.15 * even(), 0.3 * even(), 0.0);
                break;
            case Kind::on_seat:
                // a few depths wide, along an edge
                tilt = flip() ? size_between(1e-8, 1e-2) : 0.0, twist = flip() ? size_between(1e-8, 1e-2) : 0.0;
                shift.x() = 0.32 - size_between(1.0, 30.0) * boxes.depth, shift.y() = 0.5 * even();
                break;
            case Kind::on_tip:
                // a corner of a tilted block on one that it hardly covers
                tilt = size_between(1e-3, 0.1), twist = size_between(1e-4, 0.1);
                shift.x() = 0.32 - size_between(1e-4, 0.1), shift.y() = flip() ? 0.66 - size_between(1e-4, 0.1) : 0.5 * even();
                break;
            case Kind::any:
                tilt = size_between(1e-7, 0.3), twist = 3.0 * even(), shift = Vector3(0.3 * even(), 0.5 * even(), 0.0);
                boxes.b.half = Vector3(0.4, 0.4, 0.4) + 0.3 * Vector3(even(), even(), even());
        }
        const double direction = std::numbers::pi * even();
        const Matrix3 turn =
            (Eigen::AngleAxisd(tilt, Vector3(std::cos(direction), std::sin(direction), 0.0)) * Eigen::AngleAxisd(twist, Vector3::UnitZ()))
                .toRotationMatrix();
        boxes.a.rotation = flip() ? Matrix3(Matrix3::Identity()) : Matrix3(Quaternion(even(), even(), even(), even()).normalized());
        boxes.b.rotation = boxes.a.rotation * turn;
        boxes.a.position = 3.0 * Vector3(even(), even(), even());
        double low = 0.0, high = 2.0;
        for (int i = 0; i < 60; ++i) {
            shift.z() = 0.5 * (low + high);
            boxes.b.position = boxes.a.position + boxes.a.rotation * shift;
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

}  // namespace musim::lsdem::tests
