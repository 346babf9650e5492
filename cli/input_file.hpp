#pragma once

#include <string>

#include "records/shake_table/shake_table.hpp"

namespace musim::cli {

/// All of a text file that the user names. Throws records::ReadError `file: cannot be read (...); give WANTED`.
std::string read_input_file(const std::string& file, const std::string& wanted);

/// A file that another one names, as seen from the folder of that one.
std::string find_beside(const std::string& naming_file, const std::string& named);

/// The shake table of a file of schema musim-table/1; uncertain limits are for a reading, and refused without it. Throws
/// records::ReadError.
records::ShakeTable read_shake_table(const std::string& file, scaling::UncertainReading* reading = nullptr);

}  // namespace musim::cli
