#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <string>
#include <string_view>

#include "records/headers/input_file.hpp"

namespace musim::records::detail {

/// The bytes of a binary file.
class BinaryFile : public InputFile {
  public:
    BinaryFile(std::filesystem::path path, std::string bytes) : InputFile(std::move(path)), bytes_(std::move(bytes)) {}

    std::string_view bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// The number whose bytes stand at `at` in the given order; the caller has checked that at + sizeof(Number) lies within `bytes`.
template <class Number>
requires std::integral<Number> || std::floating_point<Number> Number number_at(std::string_view bytes, std::size_t at, std::endian order) {
    std::array<char, sizeof(Number)> raw{};
    for (std::size_t i = 0; i < raw.size(); ++i) raw[order == std::endian::native ? i : raw.size() - 1 - i] = bytes[at + i];
    return std::bit_cast<Number>(raw);
}

}  // namespace musim::records::detail
