#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "lsdem/scene/detail/require.hpp"

namespace musim::lsdem::detail {

void check_name(const std::string& name, const JsonPlace& place) {
    const auto is_special = [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || std::string_view("\x7f,;\"'/\\").find(c) != std::string_view::npos;
    };
    if (std::any_of(name.begin(), name.end(), is_special) || name.front() == ' ' || name.back() == ' ') {
        fail(
            place,
            "a name heads columns of tables, so it has no comma, semicolon, quote, slash, line break or blank at an end; write it without");
    }
    const std::size_t from = name.starts_with("block ") ? 6 : name.starts_with("block") ? 5 : 0;
    const bool is_number = from < name.size() && name.find_first_not_of("0123456789", from) == std::string::npos;
    if (is_number || name == "base") {
        fail(place, fmt::format("\"{}\" is {} (results would confuse the two); choose a word of its own", name,
                                is_number ? "what blocks without a name are called" : "the ground in results"));
    }
}

}  // namespace musim::lsdem::detail
