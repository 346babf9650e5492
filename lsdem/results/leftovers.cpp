#include "lsdem/results/leftovers.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

namespace musim::lsdem::detail {

void remove_leftovers(const std::filesystem::path& file) noexcept {
    std::error_code ignored;
    const std::string begin = fmt::format(".{}.", file.filename().string());
    std::vector<std::filesystem::path> leftovers;
    for (std::filesystem::directory_iterator entry(file.parent_path(), ignored), last; !ignored && entry != last;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(begin) && name.ends_with(".tmp")) leftovers.push_back(entry->path());
    }
    for (const std::filesystem::path& leftover : leftovers) std::filesystem::remove(leftover, ignored);
}

void remove_with_leftovers(const std::filesystem::path& file) noexcept {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    remove_leftovers(file);
}

}  // namespace musim::lsdem::detail
