#include "lsdem/contact/polygon.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <doctest/doctest.h>

namespace musim::lsdem::detail {
namespace {

Polygon make_polygon(const std::vector<Vector3>& corners) {
    Polygon polygon;
    for (const Vector3& corner : corners) polygon.push_back(corner);
    return polygon;
}

/// Corners on a circle about the origin in the plane z = 0, every `dent`-th of them at half its radius.
std::vector<Vector3> make_round(std::size_t count, std::size_t dent = 0) {
    std::vector<Vector3> corners;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        const double radius = dent != 0 && i % dent == 0 ? 0.5 : 1.0;
        corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    return corners;
}

/// Corner by corner [SutherlandHodgman74].
std::vector<Vector3> clip_plainly(const std::vector<Vector3>& corners, const Affine& inside) {
    std::vector<Vector3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3 &from = corners[i], &to = corners[(i + 1) % corners.size()];
        const double a = inside(from), b = inside(to);
        if (a > 0.0) kept.push_back(from);
        if ((a > 0.0) != (b > 0.0)) kept.push_back(from + a / (a - b) * (to - from));
    }
    return kept;
}

double find_area(const Polygon& polygon) {
    double twice = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        twice += Vector3(polygon[i] - polygon[0]).cross(Vector3(polygon[i + 1] - polygon[0])).z();
    }
    return 0.5 * twice;
}

Affine make_random(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const double at = 0.8 * uniform(random), x = uniform(random), y = uniform(random), z = uniform(random);
    return {at, {x, y, z}};
}

}  // namespace

TEST_CASE("a clip gives the corners that a walk round the polygon gives, in their order") {
    std::mt19937 random(1);
    PolygonCutter cutter;
    // few corners, as many as a word has bits, more; with dents, so that several runs of corners are cut off
    for (const auto& corners : {make_round(3), make_round(4), make_round(24), make_round(64), make_round(65), make_round(200),
                                make_round(24, 2), make_round(64, 3), make_round(90, 2)}) {
        for (int repetition = 0; repetition < 50; ++repetition) {
            const Affine inside = make_random(random);
            Polygon polygon = make_polygon(corners);
            cutter.clip(inside, false, polygon);
            const std::vector<Vector3> expected = clip_plainly(corners, inside);
            REQUIRE(polygon.size() == expected.size());
            // a few roundings of numbers up to one
            for (std::size_t i = 0; i < expected.size(); ++i) CHECK((polygon[i] - expected[i]).norm() < 1e-13);
        }
    }
}

TEST_CASE("the rest of a clip and what it keeps make up the polygon") {
    std::mt19937 random(2);
    PolygonCutter cutter;
    for (const std::size_t count : {3U, 5U, 24U, 64U, 100U}) {
        const Polygon whole = make_polygon(make_round(count));
        for (int repetition = 0; repetition < 50; ++repetition) {
            const Affine inside = make_random(random);
            Polygon kept, rest;
            kept.copy(whole);
            cutter.clip(inside, false, kept);
            const bool has_rest = cutter.find_rest(inside, false, whole, rest);
            CHECK(has_rest == (find_area(kept) < find_area(whole)));
            if (has_rest) CHECK(find_area(kept) + find_area(rest) == doctest::Approx(find_area(whole)).epsilon(1e-12));
        }
    }
}

TEST_CASE("a border belongs to one side of a clip") {
    const Polygon square = make_polygon({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}});
    const Affine above{0.0, {0.0, 0.0, 1.0}};  // zero all over the square
    PolygonCutter cutter;
    Polygon with, without, rest;
    with.copy(square), without.copy(square);
    cutter.clip(above, true, with);
    cutter.clip(above, false, without);
    CHECK(with.size() == 4);
    CHECK(without.empty());
    CHECK(!cutter.find_rest(above, true, square, rest));
    CHECK(cutter.find_rest(above, false, square, rest));
    CHECK(rest.size() == 4);
}

}  // namespace musim::lsdem::detail
