// What is asked of every engine, as in measure.mjs (README.md). An engine has
//   mass(kind, edge):    mass over that of the true solid, of "corners" (the eight of a cube) or "drum" (its 48 corners); NaN: does not say
//   inertia(kind, edge): moment of inertia about z through the centre over mass [m^2], also of "corners apart"; NaN: does not say
//   World{restitution, step, edge}: a ground at z = 0, with add(kind, edge, z),
//     advance(), height(i), aside(i) [m], speed(i) along z [m/s], points()
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace peers {

constexpr double kGravity = 9.81, kDensity = 2500.0, kFriction = 0.6;  // [m/s^2], [kg/m^3]
constexpr int kFlats = 24;

using Outline = std::vector<std::pair<double, double>>;

/// Square, or drum of 24 flats, in the plane of x and y.
inline Outline outline_of(const std::string& kind, double edge) {
    const double h = 0.5 * edge;
    if (kind != "drum") return {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
    Outline outline;
    for (int k = 0; k < kFlats; ++k) outline.emplace_back(h * std::cos(2 * M_PI * k / kFlats), h * std::sin(2 * M_PI * k / kFlats));
    return outline;
}

/// Corners of the prism over an outline, those below first; of "corners apart" three edges beside the origin.
inline std::vector<std::array<double, 3>> corners_of(const std::string& kind, double edge) {
    const Outline outline = outline_of(kind, edge);
    const double shift = kind == "corners apart" ? 3 * edge : 0.0;
    std::vector<std::array<double, 3>> corners;
    for (const double z : {-0.5 * edge, 0.5 * edge}) {
        for (const auto& [x, y] : outline) corners.push_back({x + shift, y, z});
    }
    return corners;
}

/// Its faces, seen from outside against the clock.
inline std::vector<std::vector<int>> faces_of(int sides) {
    std::vector<std::vector<int>> faces(2);
    for (int k = 0; k < sides; ++k) {
        faces[0].push_back(sides - 1 - k);
        faces[1].push_back(sides + k);
        faces.push_back({k, (k + 1) % sides, sides + (k + 1) % sides, sides + k});
    }
    return faces;
}

inline double volume_of(const std::string& kind, double edge) {
    return kind == "drum" ? 0.125 * kFlats * std::sin(2 * M_PI / kFlats) * edge * edge * edge : edge * edge * edge;
}

/// Moment of inertia about z over mass [m^2].
inline double inertia_of(const std::string& kind, double edge) {
    return kind == "drum" ? edge * edge / 24 * (2 + std::cos(2 * M_PI / kFlats)) : edge * edge / 6;
}

class Report {
  public:
    Report(const char* peer, const std::string& version) {
        std::printf("{\"peer\": \"%s\", \"version\": \"%s\", \"rows\": [", peer, version.c_str());
    }
    ~Report() { std::printf("\n]}\n"); }
    void say(const std::string& what, double edge, double step, double value) {
        if (std::isnan(value)) return;
        std::printf("%s\n  {\"what\": \"%s\", \"edge\": %g, \"step\": %.9g, \"value\": %.9g}", first_ ? "" : ",", what.c_str(), edge, step,
                    value);
        first_ = false;
    }

  private:
    bool first_ = true;
};

template <class World>
void run(World& world, double duration, double step) {
    for (long k = std::lround(duration / step); k > 0; --k) world.advance();
}

constexpr double kShort = 0.05;  // [s]

/// Largest number of contacts within a short time.
template <class World>
int find_most_points(World& world, double step) {
    int most = 0;
    for (long k = std::lround(kShort / step); k > 0; --k) {
        world.advance();
        most = std::max(most, static_cast<int>(world.points()));
    }
    return most;
}

template <class World>
void drop(Report& report, const std::string& kind, double edge, double restitution, double step) {
    World world(restitution, step, edge);
    world.add(kind, edge, 5.5 * edge);
    const double fall = std::sqrt(10 * edge / kGravity);
    double top = 0.0;
    bool met = false;
    for (long k = 1; k <= std::lround(2.5 * fall / step); ++k) {
        world.advance();
        met = met || world.speed(0) > 0 || static_cast<double>(k) * step > 1.2 * fall;
        if (met) top = std::max(top, world.height(0));
    }
    report.say("rebound " + kind + (restitution == 1.0 ? " 1" : " 0.5"), edge, step, (top / edge - 0.5) / 5.0);
}

template <class Engine>
void measure(const char* peer, const std::string& version, const Engine& engine) {
    using World = typename Engine::World;
    Report report(peer, version);
    constexpr double kStep = 1.0 / 240;
    for (const double edge : {1.0, 0.1, 0.02, 0.01}) {
        for (const std::string kind : {"corners", "drum"}) {
            report.say("mass " + kind, edge, 0, engine.mass(kind, edge));
        }
        for (const std::string kind : {"corners", "corners apart", "drum"}) {
            report.say("inertia " + kind, edge, 0, engine.inertia(kind, edge) / inertia_of(kind, edge));
        }
        for (const std::string kind : {"corners", "box"}) {
            World alone(0.0, kStep, edge);
            alone.add(kind, edge, 0.5 * edge);
            const int on_ground = find_most_points(alone, kStep);
            run(alone, 2.0 - kShort, kStep);
            report.say("height " + kind, edge, kStep, alone.height(0) / edge - 0.5);
            World pair(0.0, kStep, edge);
            for (int k = 0; k < 2; ++k) pair.add(kind, edge, (k + 0.5) * edge);
            report.say("points " + kind, edge, kStep, find_most_points(pair, kStep) - on_ground);
            for (const double step : {kStep, 0.25 * kStep}) {
                World stack(0.0, step, edge);
                for (int k = 0; k < 10; ++k) stack.add(kind, edge, (k + 0.5) * edge);
                run(stack, 2.0, step);
                report.say("stack height " + kind, edge, step, stack.height(9) / edge - 9.5);
                report.say("stack shift " + kind, edge, step, stack.aside(9) / edge);
            }
        }
        for (const double restitution : {1.0, 0.5}) {
            for (const double step : {kStep, 0.25 * kStep, 0.0625 * kStep}) {
                for (const char* kind : {"sphere", "box"}) drop<World>(report, kind, edge, restitution, step);
            }
        }
    }
}

}  // namespace peers
