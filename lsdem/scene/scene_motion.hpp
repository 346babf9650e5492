#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "lsdem/scene/material_presets.hpp"
#include "records/formats/column_choice.hpp"
#include "records/processing/processing.hpp"
#include "records/sample_unit.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/units.hpp"

/// Motions of the base, as scenes describe them.
namespace musim::lsdem {

/// Names of the axes along which, and then about which, a base moves; the right hand says which way it turns.
inline constexpr std::array kMotionAxes{"x", "y", "z", "rx", "ry", "rz"};

/// Scale factors that a scene applies to its own record.
struct RecordScale {
    std::string law = "mu";             ///< one that comes with musim, by name, or a file by its absolute path
    std::map<std::string, double> set;  ///< factors by quantity; what is not in it has the law's default

    bool operator==(const RecordScale&) const = default;
};

/// The similitude of a record's scale. Throws scaling::SimilitudeError.
scaling::Similitude make_similitude(const RecordScale& scale);

/// A recorded base motion: read, high-passed, integrated, windowed, brought to rest, then scaled.
struct RecordMotion {
    std::filesystem::path file;                            ///< absolute path
    std::array<std::optional<std::string>, 6> components;  ///< component names along x, y, z, then about them, see kMotionAxes
    std::optional<std::string> unit;                       ///< of plain text files
    std::optional<records::SampleQuantity> quantity;       ///< of plain text files
    std::optional<scaling::Time> dt;                       ///< of files without one
    std::optional<double> sensitivity;                     ///< of files of counts [counts per m/s^2, m/s or m]
    std::optional<std::filesystem::path> station_xml;      ///< of files of counts: StationXML file that gives it; absolute path
    std::optional<records::ColumnChoices> columns;         ///< of plain text files: which column is what
    std::optional<std::size_t> skip;                       ///< lines at the beginning of text files that are not read
    std::optional<std::array<scaling::Time, 2>> window;    ///< part to use, in the record's own time; it starts at t = 0
    std::optional<scaling::Frequency> highpass_corner;     ///< default: what the record itself asks for
    records::AtRest at_rest = records::AtRest::home;       ///< how the base begins and ends
    std::optional<scaling::Velocity> apparent_velocity;    ///< of waves along x, by which translations named for rx, ry, rz become turns
    std::optional<RecordScale> scale;

    bool operator==(const RecordMotion&) const = default;
};

/// The base takes the velocity V at once and keeps it.
struct StepSignal {
    scaling::Velocity velocity{};

    bool operator==(const StepSignal&) const = default;
};

/// a(t) = A·sin(2π f t) from rest, for a number of cycles; the velocity A/(2π f)·(1 − cos) never changes sign.
struct SineSignal {
    scaling::Acceleration amplitude{};
    scaling::Frequency frequency{};
    double cycles = 1.0;

    bool operator==(const SineSignal&) const = default;
};

/// a(t) = A·sin(π t/T) for 0 ≤ t ≤ T, then the velocity 2AT/π stays.
struct HalfSineSignal {
    scaling::Acceleration amplitude{};
    scaling::Time duration{};

    bool operator==(const HalfSineSignal&) const = default;
};

/// Ricker wavelet a(τ) = A·(1 − 2π²f²τ²)·exp(−π²f²τ²), whose peak comes 1.5/f after the start; starts and ends at rest [Ricker53].
struct RickerSignal {
    scaling::Acceleration amplitude{};
    scaling::Frequency frequency{};

    bool operator==(const RickerSignal&) const = default;
};

/// Made earthquake with given peaks, see records::make_synthetic_record.
struct SyntheticSignal {
    scaling::Acceleration pga{};
    scaling::Velocity pgv{};
    scaling::Time duration{};
    scaling::Time dt{};
    std::uint64_t seed = 1;

    bool operator==(const SyntheticSignal&) const = default;
};

/// The base rocks to and fro: θ(t) = A·w(t)·sin(2π f t) for a number of cycles, where w rises from 0 to 1 over the first as
/// (1 − cos(π f t))/2 and falls so over the last; two at least. Begins and ends at rest, without a jump of the angular velocity.
struct RockingSignal {
    scaling::Ratio angle{};  ///< A [rad]
    scaling::Frequency frequency{};
    double cycles = 2.0;

    bool operator==(const RockingSignal&) const = default;
};

using Signal = std::variant<StepSignal, SineSignal, HalfSineSignal, RickerSignal, SyntheticSignal, RockingSignal>;

/// A base motion given by a formula, along one axis, or about one.
struct SignalMotion {
    Signal signal;
    std::size_t axis = 0;             ///< of kMotionAxes
    scaling::Time start{};            ///< when it begins
    std::optional<scaling::Time> dt;  ///< of the samples of sine, half_sine, ricker and rocking; default: period/200

    bool operator==(const SignalMotion&) const = default;
};

/// The base tilts as a tilting table does: it turns about a horizontal axis, at a rate that grows from nothing over the first 64th of the
/// time, then stays, and falls to nothing over the last, until an angle is reached.
struct TiltMotion {
    std::size_t about = 1;                                                             ///< 0, 1: x, y
    scaling::Frequency rate{};                                                         ///< [rad/s]
    scaling::Ratio until = 0.25 * std::numbers::pi * scaling::Ratio::from_value(1.0);  ///< [rad]

    scaling::Time duration() const;  ///< until/rate·64/63
    bool operator==(const TiltMotion&) const = default;
};

/// Factors that scale_scene has applied to a base motion so far: times and velocities of the prototype's samples are multiplied by these.
struct MotionFactors {
    double time = 1.0;
    double velocity = 1.0;           ///< along x and y
    double velocity_vertical = 1.0;  ///< along z; rates of turns by the inverse of that of time

    bool operator==(const MotionFactors&) const = default;
};

/// Motion of the ground, as a scene describes it.
struct SceneMotion {
    std::variant<std::monostate, RecordMotion, SignalMotion, TiltMotion> source;
    MotionFactors factors;
    /// The point about which it turns, where it is when the motion begins; default: on the plane, in the middle of the structure's extent.
    std::optional<Triple<scaling::Length>> pivot;

    bool operator==(const SceneMotion&) const = default;
};

}  // namespace musim::lsdem
