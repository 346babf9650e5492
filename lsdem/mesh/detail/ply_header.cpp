#include "lsdem/mesh/detail/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace musim::lsdem::detail {
namespace {

struct PlyTypeName {
    std::string_view name;
    PlyType type;
};

constexpr PlyTypeName kPlyTypes[] = {
    {"char", PlyType::int8},   {"uchar", PlyType::uint8},   {"short", PlyType::int16},     {"ushort", PlyType::uint16},
    {"int", PlyType::int32},   {"uint", PlyType::uint32},   {"float", PlyType::float32},   {"double", PlyType::float64},
    {"int8", PlyType::int8},   {"uint8", PlyType::uint8},   {"int16", PlyType::int16},     {"uint16", PlyType::uint16},
    {"int32", PlyType::int32}, {"uint32", PlyType::uint32}, {"float32", PlyType::float32}, {"float64", PlyType::float64},
};

PlyType parse_ply_type(MeshWords& words) {
    const std::string_view word = words.next();
    for (const PlyTypeName& known : kPlyTypes) {
        if (is_word(word, known.name)) return known.type;
    }
    words.fail(fmt::format("{} is no type of a property", quote_word(word)), "types are char to double and int8 to float64");
}

PlyProperty parse_ply_property(MeshWords& words) {
    PlyProperty property;
    MeshWords behind = words;
    if (is_word(behind.next(), "list")) {
        words.next();
        property.count = parse_ply_type(words);
        if (!is_whole(*property.count)) words.fail("the count of a list is no whole number", "correct the header");
    }
    property.type = parse_ply_type(words);
    property.name = words.next();
    return property;
}

PlyElement parse_ply_element(MeshWords& words) {
    PlyElement element;
    element.name = words.next();
    const std::string_view word = words.next();
    const std::optional<long long> rows = parse_whole(word);
    if (!rows || *rows < 0) {
        words.fail(fmt::format("element {} has {} rows", quote_word(element.name), quote_word(word)), "correct the header");
    }
    element.rows = static_cast<std::size_t>(*rows);
    return element;
}

std::optional<std::endian> parse_ply_format(MeshWords& words) {
    const std::string_view word = words.next();
    words.next();  // the version, 1.0 since 1994
    if (is_word(word, "ascii")) return std::nullopt;
    if (is_word(word, "binary_little_endian")) return std::endian::little;
    if (is_word(word, "binary_big_endian")) return std::endian::big;
    words.fail(fmt::format("{} is no format of a PLY", quote_word(word)), "formats are ascii, binary_little_endian and binary_big_endian");
}

/// Where a binary file's rows begin: behind one line end, which is that of the first line, since the first row may look like another.
std::size_t find_ply_rows(std::string_view bytes, std::size_t offset) {
    while (offset < bytes.size() && (bytes[offset] == ' ' || bytes[offset] == '\t')) ++offset;
    const std::size_t first = std::min(bytes.find_first_of("\r\n"), bytes.size());
    return offset + (bytes.substr(first).starts_with("\r\n") ? 2 : 1);
}

}  // namespace

std::size_t find_size(PlyType type) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

PlyHeader parse_ply_header(MeshWords& words, std::string_view bytes) {
    if (!is_word(words.next(), "ply")) words.fail("is no PLY: it does not begin with 'ply'", "is it the right file?");
    PlyHeader header;
    for (;;) {
        const std::string_view word = words.next();
        if (is_word(word, "end_header")) break;
        if (is_word(word, "format")) {
            header.order = parse_ply_format(words);
        } else if (is_word(word, "element")) {
            header.elements.push_back(parse_ply_element(words));
        } else if (is_word(word, "property") && !header.elements.empty()) {
            header.elements.back().properties.push_back(parse_ply_property(words));
        } else if (is_word(word, "comment") || is_word(word, "obj_info")) {
            words.skip_line();
        } else {
            words.fail(fmt::format("{} stands in the header", quote_word(word)),
                       word.empty() ? "the file has lost its end" : "correct the header");
        }
    }
    header.size = std::min(find_ply_rows(bytes, words.offset()), bytes.size());
    return header;
}

}  // namespace musim::lsdem::detail
