#pragma once

#include <string>
#include <vector>

#include "records/design/design.hpp"
#include "records/shake_table/shake_table.hpp"

namespace musim::cli {

/// All of a text file that the user names. Throws records::ReadError `file: cannot be read (...); give WANTED`.
std::string read_input_file(const std::string& file, const std::string& wanted);

/// A file that another one names, as seen from the folder of that one.
std::string find_beside(const std::string& naming_file, const std::string& named);

/// The shake table of a file of schema musim-table/1; uncertain limits are for a reading, and refused without it. Throws
/// records::ReadError.
records::ShakeTable read_shake_table(const std::string& file, scaling::UncertainReading* reading = nullptr);

/// The measured materials of scenes by their names, face stiffnesses as moduli of the solid; for files of designs and properties.
std::vector<records::Material> make_preset_materials();

/// Can writing to `file` destroy something? Not in a device or pipe.
bool can_be_lost(const std::string& file);

/// Refuses an output that is one of the inputs or another output: the same path once links and relative parts are resolved. Asked before
/// anything is computed. Empty names are options that were not given; devices and pipes may occur twice, nothing in them is lost. Throws
/// records::WriteError `OUTPUT: cannot be written (...); name another file`.
void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace musim::cli
