#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "records/design/design_law.hpp"
#include "records/shake_table/shake_table.hpp"
#include "records/shake_table/table_check.hpp"
#include "scaling/laws/similitude.hpp"

/// Inverse design: from a prototype, a shake table and what a workshop can make to the length scales, materials and laws that will do.
namespace musim::records {

/// The structure to be modelled. What is optional leaves out the groups and limits that need it.
struct Prototype {
    std::array<scaling::Length, 3> block{};  ///< b, w, H
    scaling::Length height{};                ///< of the whole structure, l
    scaling::Density density{};
    double friction = 0.0;                              ///< μ between blocks [-]
    scaling::Mass mass{};                               ///< of the whole structure
    scaling::Length mass_center{};                      ///< above its base
    std::optional<double> restitution = {};             ///< normal coefficient e [-]
    std::optional<scaling::Stress> modulus = {};        ///< E_eff = k_n H/A of a face
    std::optional<scaling::Stress> shear_modulus = {};  ///< G_eff = k_s H/A of a face
    std::optional<scaling::Length> deviation = {};      ///< σ_H, standard deviation of the block heights
};

/// Material that blocks of the model can be made of, and how well.
struct Material {
    std::string name;
    scaling::Density density{};
    double friction = 0.0;                              ///< [-]
    std::optional<double> restitution = {};             ///< [-]
    std::optional<scaling::Stress> modulus = {};        ///< E_eff = k_n H/A, the solid's: the same at any size
    std::optional<scaling::Stress> shear_modulus = {};  ///< G_eff = k_s H/A
    std::optional<scaling::Length> deviation = {};      ///< σ_H that the workshop reaches, whatever the size
    std::optional<scaling::Length> smallest_edge = {};  ///< shortest edge that can be made
    std::optional<double> price = {};                   ///< per kilogram, in any currency [1/kg]
};

/// Limits besides the table's; what is not limited is not there.
struct Limits {
    std::optional<scaling::Length> hall_height = {};
    std::optional<double> deviation_ratio = {};          ///< largest σ_H/H of the model [-]
    std::optional<double> overlap_ratio = {};            ///< largest δ_w/σ_H of the model [-]
    std::optional<scaling::Frequency> camera_rate = {};  ///< pictures a second
    double pictures = 0.0;                               ///< wanted in one sliding time √(l/(μ g)), scaled as time is
};

/// Peaks of a motion for one axis, where there is no record. A limit of the axis needs its peak.
struct GivenPeaks {
    std::string axis;
    scaling::Acceleration acceleration{};  ///< always given of an axis that is a translation
    std::optional<scaling::Velocity> velocity = {};
    std::optional<scaling::Length> displacement = {};
    std::optional<scaling::Frequency> lowest_frequency = {}, highest_frequency = {};
    std::optional<scaling::AngularAcceleration> angular_acceleration = {};  ///< of an axis that is a rotation, where the others are missing
    std::optional<scaling::Frequency> angular_velocity = {};
    std::optional<scaling::Ratio> angle = {};  ///< [rad]
};

/// A record's file and (component, axis) pairs; without any, as records::assign_axes() has it.
struct RecordFile {
    std::string file;
    std::vector<std::pair<std::string, std::string>> axes = {};
    std::optional<scaling::Frequency> high_pass = {};  ///< of the prototype; none: as DriveSettings
};

/// All that a campaign starts from.
struct Design {
    std::string name;
    Prototype prototype;
    std::variant<RecordFile, std::vector<GivenPeaks>> motion;
    std::string table_file;  ///< of schema musim-table/1; empty: no table, and no motion
    Limits limits;
    std::vector<Material> materials;
    std::vector<DesignLaw> laws;
    std::optional<double> gravity = {};  ///< λ_g; none: 1, or what the law finds
    std::optional<double> length = {};   ///< λ_l that one has in mind
    std::vector<std::string> groups;     ///< that the ranking weighs (names of scaling::group_factors())
};

/// Loads that the axes have to make, from the record in its prototype form. Throws ReadError and ProcessingError as the steps do.
std::vector<AxisLoad> make_loads(const GroundMotion& motion, const RecordFile& record, const ShakeTable& table);

/// The same from given peaks. Throws ReadError for an axis that there is not, and for a peak that is missing where its axis has a limit.
std::vector<AxisLoad> make_loads(const std::vector<GivenPeaks>& peaks, const ShakeTable& table, const std::string& source);

}  // namespace musim::records
