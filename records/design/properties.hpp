#pragma once

#include <optional>
#include <string>
#include <variant>

#include "records/design/design_law.hpp"
#include "records/ground_motion.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/structures/structure_properties.hpp"

/// Knowledge of a laboratory about a prototype and the model it has built.
namespace musim::records {

/// A motion that is a record: measured, not given.
struct RecordOfMotion {
    std::string file;
    std::string component = {};                        ///< empty: the strongest horizontal one
    std::string vertical = {};                         ///< empty: the vertical one, where the record has one
    std::optional<scaling::Frequency> high_pass = {};  ///< before integration; none: the record's own corner
};

/// Peaks and periods of a motion, or where to measure them.
using MotionSource = std::variant<scaling::MotionProperties, RecordOfMotion>;

/// An axis of a table of schema musim-table/1.
struct AxisOfTable {
    std::string file, axis;
};

/// Prototype, model and what shakes them, as a file of schema musim-properties/1 has it: records and tables are still names.
struct Properties {
    std::string name;
    scaling::StructureProperties prototype, model;
    std::optional<MotionSource> motion = {}, model_motion = {};
    std::variant<std::monostate, scaling::Bandwidth, AxisOfTable> table = {};
    std::optional<DesignLaw> law = {};  ///< that the model is meant to follow
};

/// Peaks, significant duration D5-95, step, periods of the largest PSA and PSV (5 % damping, records::compute_own_spectrum), and the
/// frequencies between which all but a hundredth of ∫a² dt lies at either end, of one component; and the vertical peak.
/// Throws ReadError for a component that there is not, or that holds no acceleration.
scaling::MotionProperties measure_motion(const GroundMotion& motion, const RecordOfMotion& record);

/// The frequencies that an axis follows with the model as payload: its own, those of the loaded oil column and of the controller
/// (records::check_axis).
scaling::Bandwidth find_bandwidth(const TableAxis& axis, scaling::Mass payload);

/// Mass of all blocks of a structure; zero where it is not known how many there are in a layer.
scaling::Mass find_mass(const scaling::StructureProperties& properties);

}  // namespace musim::records
