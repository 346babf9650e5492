#include "cli/output_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <system_error>

#include "records/error.hpp"

namespace musim::cli {
namespace {

namespace fs = std::filesystem;

/// Can writing to `file` destroy something? Not in a device or pipe.
bool can_be_lost(const std::string& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return !file.empty() && (!fs::exists(status) || fs::is_regular_file(status));
}

/// One name for all paths to a file, as write_file_atomically() follows them.
fs::path resolve(const std::string& file) {
    std::error_code error;
    const fs::path path = fs::weakly_canonical(fs::absolute(file, error), error);
    return error ? fs::path(file) : path;
}

}  // namespace

void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    std::map<fs::path, std::string> taken;  // what each file is needed for
    for (const std::string& input : inputs) {
        if (can_be_lost(input)) taken.try_emplace(resolve(input), "the input " + input);
    }
    for (const std::string& output : outputs) {
        if (!can_be_lost(output)) continue;
        const auto [place, is_free] = taken.try_emplace(resolve(output), "the output " + output);
        if (!is_free)
            throw records::WriteError(fmt::format("{}: cannot be written (it is also {}); name another file", output, place->second));
    }
}

}  // namespace musim::cli
