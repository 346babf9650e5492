#pragma once

#include <optional>
#include <vector>

#include "records/processing/base_motion.hpp"
#include "records/processing/motion_change.hpp"
#include "records/processing/recipe.hpp"

/// The motion that a shake table is given to make.
namespace musim::records {

/// Changes of a record before it is given to a table; frequencies are the model's.
struct DriveSettings {
    std::optional<scaling::Frequency> high_pass = {};  ///< order 2, no phase; none: the corner of an uncorrected record, else no filter
    std::optional<scaling::Frequency> low_pass = {};   ///< order 4, no phase
    double amplitude = 1.0;
    std::optional<scaling::Time> dt = {};  ///< step of the table's controller; none: the record's
    AtRest at_rest = AtRest::home;

    /// The same at the record's step.
    DriveSettings at_own_step() const { return {high_pass, low_pass, amplitude, {}, at_rest}; }
};

/// Acceleration, velocity and displacement of a table, of a rotation the angular ones and the angle, on one clock, each the trapezoid
/// integral of the one before.
struct DriveMotion {
    TimeSeries acceleration, velocity, displacement;
};

/// Recipe of the acceleration of a base from the record of a model, as make_base_motion() makes its velocity: differentiated if it is no
/// acceleration, aligned if it has several components, mean (of an uncorrected record) out, a taper of kDefaultTaper where it is filtered,
/// high-pass, bring_to_rest(). For a table, low-pass, amplitude and the controller's step come before the last. As steps of a recipe, to be
/// carried out by process() and kept in the history.
Recipe make_drive_recipe(const GroundMotion& model, const DriveSettings& settings = {});

/// The table's motion for each component. Throws ProcessingError as process() does.
std::vector<DriveMotion> make_drive_motions(const GroundMotion& model, const DriveSettings& settings = {});

/// The same motions at the record's step against the record, with the peaks that they have at the controller's.
std::vector<ComponentChange> compare_drive_motions(const GroundMotion& model, const DriveSettings& settings = {});

/// Integrates an acceleration that process() brought to rest. Velocity and displacement start at zero. Throws ProcessingError for another
/// quantity.
DriveMotion integrate_twice(const TimeSeries& acceleration_at_rest);

/// The same with the table standing before and after. Throws ProcessingError for a motion that does not end at rest, and as pad() does.
DriveMotion add_rest(const DriveMotion& motion, scaling::Time rest);

}  // namespace musim::records
