#pragma once

#include <string>
#include <string_view>

namespace musim::lsdem::study::detail {

/// Name for content: its 64-bit FNV-1a hash as 16 hexadecimal digits. Equal contents have equal names on every machine.
std::string name_content(std::string_view content);

}  // namespace musim::lsdem::study::detail
