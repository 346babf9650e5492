#pragma once

#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lsdem/mesh/detail/mesh_words.hpp"

namespace musim::lsdem::detail {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_whole(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

/// Bytes of a number.
std::size_t find_size(PlyType type);

/// A number that each row of an element has, or a list of numbers behind their count.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> count;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t rows = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    std::optional<std::endian> order;  ///< none: text
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< bytes, up to the first row of a binary file
};

/// Reads the header, up to the end of its last line.
PlyHeader parse_ply_header(MeshWords& words, std::string_view bytes);

}  // namespace musim::lsdem::detail
