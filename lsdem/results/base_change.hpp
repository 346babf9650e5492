#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/model.hpp"
#include "records/processing/motion_change.hpp"

namespace musim::lsdem {

/// Motion that the base makes along one axis, against the record or the formula that it was made from. A formula has a PGA of its own only:
/// its velocity is the base's.
struct BaseChange {
    records::MotionChange peaks;
    bool of_record = false;
};

/// Changes along x, y and z; nothing for an axis that does not move or whose source is not known.
using BaseChanges = std::array<std::optional<BaseChange>, 3>;

/// Changes of a motion that runs until `end` [s], over the part that has run.
BaseChanges find_base_changes(const BaseComponents& motion, double end);

/// The same in the units of a prototype: accelerations, velocities and lengths are divided by these factors of each axis.
BaseChanges scale_back(BaseChanges changes, const std::array<double, 3>& acceleration, const std::array<double, 3>& velocity,
                       const std::array<double, 3>& length);

/// "PGA 0.52 g (record 0.5454 g, -4.7 %), PGV ...; largest difference at any time ..." of a record; "PGA 0.5 g", with that of the formula
/// where it is another one; `pga` [m/s²] alone where nothing is known.
std::string describe_base(double pga, const std::optional<BaseChange>& change);

/// A warning for each axis along which PGA or PGV are not those of the record, see records::kChangedPeak.
std::vector<std::string> warn_of_changes(const BaseChanges& changes);

/// {"of": "record" or "formula", "base", "source", "largest_difference"}, each of these with pga_g, pgv_m_s, pgd_m.
nlohmann::json to_json(const BaseChange& change);

/// The same along x, y and z; null where not known.
nlohmann::json to_json(const BaseChanges& changes);

/// Changes that to_json() wrote. Throws nlohmann::json::exception for anything else.
BaseChanges parse_base_changes(const nlohmann::json& json);

}  // namespace musim::lsdem
