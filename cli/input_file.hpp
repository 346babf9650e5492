#pragma once

#include <string>

namespace musim::cli {

/// All of a text file that the user names. Throws records::ReadError `file: cannot be read (...); give WANTED`.
std::string read_input_file(const std::string& file, const std::string& wanted);

}  // namespace musim::cli
