#include "lsdem/results/content_name.hpp"

#include <fmt/format.h>

namespace musim::lsdem::detail {

void ContentHash::add(std::string_view piece) {
    for (const char c : piece) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
}

std::string ContentHash::name() const { return fmt::format("{:016x}", hash_); }

std::string name_content(std::string_view content) {
    ContentHash hash;
    hash.add(content);
    return hash.name();
}

}  // namespace musim::lsdem::detail
