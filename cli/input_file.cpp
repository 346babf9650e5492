#include "cli/input_file.hpp"

#include <filesystem>
#include <optional>
#include <utility>

#include "records/error.hpp"
#include "scaling/regular_file.hpp"

namespace musim::cli {

std::string read_input_file(const std::string& file, const std::string& wanted) {
    const std::string obstacle = scaling::find_obstacle(file);
    std::optional<std::string> text = scaling::read_regular_file(file);
    if (!text || text->empty()) {
        throw records::ReadError(file + ": cannot be read (" + (obstacle.empty() ? "empty, or no permission" : obstacle) + "); give " +
                                 wanted);
    }
    return *std::move(text);
}

std::string find_beside(const std::string& naming_file, const std::string& named) {
    return (std::filesystem::path(naming_file).parent_path() / named).string();
}

records::ShakeTable read_shake_table(const std::string& file, scaling::UncertainReading* reading) {
    return records::parse_shake_table(read_input_file(file, "the limits of a shake table (musim-table/1)"), file, reading);
}

}  // namespace musim::cli
