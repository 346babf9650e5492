#include "lsdem/mesh/read_mesh.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>

#include "lsdem/mesh/detail/mesh_making.hpp"
#include "lsdem/mesh/detail/mesh_words.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {

Mesh read_mesh(const std::filesystem::path& path, const MeshLimits& limits) {
    const std::string file = path.string(), ending = path.extension().string();
    const std::string obstacle = scaling::find_obstacle(path);
    if (!obstacle.empty()) detail::fail_mesh(file, 0, "cannot be read as a mesh: " + obstacle, "check the path");

    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > limits.bytes) {
        detail::fail_mesh(file, 0, fmt::format("has {} bytes (limit {})", size, limits.bytes), "take a coarser mesh");
    }
    const std::optional<std::string> bytes = scaling::read_regular_file(path);
    if (!bytes) detail::fail_mesh(file, 0, fmt::format("cannot be read: {}", std::strerror(errno)), "check its permissions");

    if (detail::is_word(ending, ".stl")) return parse_stl(*bytes, file, limits);
    if (detail::is_word(ending, ".obj")) return parse_obj(*bytes, file, limits);
    if (detail::is_word(ending, ".ply")) return parse_ply(*bytes, file, limits);
    detail::fail_mesh(file, 0, fmt::format("ends in {}, not in .stl, .obj or .ply", detail::quote_word(ending)),
                      "write it as one of these");
}

}  // namespace musim::lsdem
