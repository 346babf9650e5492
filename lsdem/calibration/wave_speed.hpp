#pragma once

#include <string>
#include <vector>

#include "lsdem/calibration/block_sample.hpp"

/// The stiffness of contacts from the speed at which motion travels up a stack [Harmon23, 4.2].
namespace musim::lsdem {

/// Along the column on its normal springs, or across it on its shear springs.
enum class WaveKind { normal, shear };

/// When a layer counts as reached: by half of the velocity V of the base, or by the displacement 5·V/ω0, ω0 = √(k/m).
enum class ArrivalCriterion { half_velocity, displacement };

/// "half_velocity", "displacement".
std::string to_string(ArrivalCriterion criterion);

struct WaveSettings {
    int layers = 38;  ///< of the column, 20 or more: below, the wave that returns from the top disturbs the fit
    ArrivalCriterion criterion = ArrivalCriterion::half_velocity;
    bool damped = false;  ///< with the material's restitution; otherwise only the springs act, as in [Harmon23]
};

/// The motion of a column after a step of the base velocity, from rest under its weight.
struct WaveHistory {
    double base_velocity = 0.0;                     ///< V [m/s]
    std::vector<double> time;                       ///< [s]
    std::vector<std::vector<double>> displacement;  ///< of every layer, from the lowest up [m]
    std::vector<std::vector<double>> velocity;      ///< likewise [m/s]
};

/// Speed of a front from the arrival at the layers of a column.
struct WaveSpeed {
    double speed = 0.0;           ///< slope of height over arrival time [m/s]
    double standard_error = 0.0;  ///< of `speed` [m/s]
    double front_factor = 1.0;    ///< what the criterion gives, with the same layers, for an ideal chain of speed c0, over c0 [-]
    int first_layer = 0;          ///< of the fit
    int last_layer = 0;
    std::vector<double> arrival;  ///< of every layer [s]; not a number for layers that were not reached

    /// The speed without what the criterion adds to it, an estimate of c0 = H·√(k/m) [m/s].
    double effective() const { return speed / front_factor; }
};

/// Velocity of the base, 0.8 block heights per second [m/s] [Harmon23, 4.2].
double base_velocity(const BlockSample& sample);

/// H·√(k/m), the speed of long waves in the column [m/s].
double closed_form_speed(const BlockSample& sample, WaveKind kind);

/// Runs the test: rotation locked, friction so large that nothing slips, step 0.02/ω0 or half of the critical one.
/// Throws std::invalid_argument for fewer than 20 layers or a sample that make_model refuses.
WaveHistory run_wave_test(const BlockSample& sample, WaveKind kind, const WaveSettings& settings);

/// Least-squares fit of height over arrival time, between the layers 5 and 30 of 38 (the same fractions of another number).
WaveSpeed measure_wave_speed(const BlockSample& sample, WaveKind kind, const WaveSettings& settings);

/// Speed that the criterion gives over c0 for an ideal chain of as many layers [Schroedinger14]: masses and lossless springs, integrated
/// with 0.01/ω0. 38 layers: 0.9885 for half of the velocity, 1.0083 for the displacement; between the two end layers alone 0.9878 and
/// 1.0077.
double compute_front_factor(const WaveSettings& settings);

/// A stiffness found for a target speed.
struct StiffnessSearch {
    double target = 0.0;        ///< [m/s]
    double stiffness = 0.0;     ///< found [N/m]
    double closed_form = 0.0;   ///< m·(target/H)² [N/m]
    WaveSpeed measured;         ///< with the stiffness found
    int runs = 0;               ///< of the test
    bool of_raw_speed = false;  ///< the target is the criterion's own speed, not the effective one
};

/// Finds k_n or k_s at which the measured speed (effective, or the criterion's own when `of_raw_speed`) is the target, to 1e-6.
///
/// Every run corrects the stiffness by (target/measured)², which converges at once since c ∝ √k. Throws std::invalid_argument for a target
/// that is not positive, std::runtime_error when 20 runs are not enough.
StiffnessSearch find_stiffness(BlockSample sample, WaveKind kind, double target, const WaveSettings& settings, bool of_raw_speed = false);

}  // namespace musim::lsdem
