#include "cli/input_file.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "records/error.hpp"

namespace musim::cli {

std::string read_input_file(const std::string& file, const std::string& wanted) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    if (std::filesystem::is_directory(file) || !in || !(text << in.rdbuf()))
        throw records::ReadError(file + ": cannot be read (missing, a folder, or empty); give " + wanted);
    return std::move(text).str();
}

}  // namespace musim::cli
