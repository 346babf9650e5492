#pragma once

#include <filesystem>
#include <vector>

#include "records/shake_table/drive_motion.hpp"
#include "records/shake_table/shake_table.hpp"

namespace musim::records {

/// One direction of a table and how it is to move.
struct AxisMotion {
    std::string axis;
    DriveMotion motion;
};

/// Writes the motions of all axes as a controller reads them: text, a row a sample, the columns of ControllerFormat for each axis in turn
/// (the time once, where the first axis has it), in its units; time from zero. The file is complete or absent. Throws WriteError when there
/// is no motion, their clocks differ, a step is not that of the controller, or the file cannot be written.
void write_drive_file(const std::filesystem::path& path, const std::vector<AxisMotion>& axes, const ControllerFormat& format);

}  // namespace musim::records
