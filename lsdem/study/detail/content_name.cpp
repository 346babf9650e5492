#include "lsdem/study/detail/content_name.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace musim::lsdem::study::detail {

std::string name_content(std::string_view content) {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return fmt::format("{:016x}", hash);
}

}  // namespace musim::lsdem::study::detail
