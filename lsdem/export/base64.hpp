#pragma once

#include <string>

namespace musim::lsdem {

/// Bytes as text [RFC 4648].
std::string encode_base64(const std::string& bytes);

}  // namespace musim::lsdem
