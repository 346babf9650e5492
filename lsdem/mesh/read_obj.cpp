#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/mesh/detail/mesh_making.hpp"
#include "lsdem/mesh/detail/mesh_words.hpp"
#include "lsdem/mesh/read_mesh.hpp"

namespace musim::lsdem {
namespace {

using detail::is_word;
using detail::MeshMaking;
using detail::MeshWords;

Vector3 parse_obj_vertex(MeshWords& words) {
    Vector3 x;
    for (Eigen::Index a = 0; a < 3; ++a) {
        const std::string_view word = words.next_in_line();
        if (word.empty()) words.fail("a vertex has fewer than three coordinates", "correct the line");
        x[a] = detail::parse_coordinate(words, word, std::string_view("xyz").substr(static_cast<std::size_t>(a), 1));
    }
    return x;
}

/// The vertex, counted from 0, of a corner "v", "v/vt", "v//vn" or "v/vt/vn": from 1, or negative, back from the last one so far.
std::uint32_t parse_obj_corner(const MeshWords& words, std::string_view word, std::size_t vertices) {
    const std::optional<long long> number = detail::parse_whole(word.substr(0, word.find('/')));
    if (!number) words.fail(fmt::format("{} is no corner of a face", detail::quote_word(word)), "write v, v/vt, v//vn or v/vt/vn");
    const auto so_far = static_cast<long long>(vertices);
    const long long vertex = *number > 0 ? *number - 1 : so_far + *number;
    if (*number == 0 || vertex < 0 || vertex > std::numeric_limits<std::uint32_t>::max()) {
        words.fail(fmt::format("vertex {} does not exist: {} stand before this line, counted from 1", *number, so_far), "correct the face");
    }
    return static_cast<std::uint32_t>(vertex);
}

void parse_obj_face(MeshWords& words, MeshMaking& making) {
    const std::size_t line = words.line();
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line()) {
        making.add_corner(parse_obj_corner(words, word, making.vertices()));
    }
    making.end_face(line);
}

std::string parse_obj_name(MeshWords& words) {
    std::vector<std::string_view> name;
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line()) name.push_back(word);
    return fmt::format("{}", fmt::join(name, " "));
}

}  // namespace

Mesh parse_obj(std::string_view bytes, const std::string& file, const MeshLimits& limits) {
    MeshMaking making(file, "OBJ", limits);
    MeshWords words(bytes, file);
    Mesh::Group group;
    while (words.offset() < bytes.size()) {
        const std::string_view word = words.next_in_line();
        if (is_word(word, "v")) {
            making.add_vertex(parse_obj_vertex(words));
        } else if (is_word(word, "f")) {
            parse_obj_face(words, making);
        } else if (is_word(word, "g")) {
            group.name = parse_obj_name(words);
            making.choose_group(group);
        } else if (is_word(word, "o")) {
            group = {.object = parse_obj_name(words), .name = {}};
            making.choose_group(group);
        } else if (is_word(word, "curv") || is_word(word, "surf") || is_word(word, "call")) {
            words.fail(fmt::format("{} is not read: a solid is bounded by faces", detail::quote_word(word)), "write the surface as faces");
        }
        // what is left of the line, of materials, lines, points and lines that were skipped
        while (!words.next_in_line().empty()) continue;
        words.skip_line();
    }
    return making.take();
}

}  // namespace musim::lsdem
