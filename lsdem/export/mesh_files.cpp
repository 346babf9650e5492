#include "lsdem/export/mesh_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include "lsdem/export/surface_mesh.hpp"

namespace musim::lsdem {
namespace {

/// A name as one word of OBJ.
std::string write_word(std::string name) {
    for (char& letter : name) {
        if (static_cast<unsigned char>(letter) <= ' ') letter = '_';
    }
    return name;
}

template <class Number>
void append_bytes(std::string& bytes, Number number) {
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), &number, sizeof(Number));
    bytes.append(raw.data(), raw.size());
}

void append_vector(std::string& bytes, const Vector3& vector) {
    for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, static_cast<float>(vector[axis]));
}

}  // namespace

std::string make_obj(const ExportedBlocks& exported) {
    std::string text = fmt::format("# {}: {} blocks, in m, z up\n", write_word(exported.name), exported.blocks.size());
    std::size_t before = 1;  // corners are counted from 1
    for (const ExportedBlock& block : exported.blocks) {
        const SurfacePolygons polygons = make_surface_polygons(*block.shape);
        fmt::format_to(std::back_inserter(text), "o {}\n", write_word(block.name));
        if (!block.material.empty()) fmt::format_to(std::back_inserter(text), "usemtl {}\n", write_word(block.material));
        for (const Vector3& corner : polygons.corners) {
            const Vector3 place = block.position + block.orientation * corner;
            fmt::format_to(std::back_inserter(text), "v {} {} {}\n", place.x(), place.y(), place.z());
        }
        for (const auto& face : polygons.faces) {
            text += 'f';
            for (const std::uint32_t corner : face) fmt::format_to(std::back_inserter(text), " {}", before + corner);
            text += '\n';
        }
        before += polygons.corners.size();
    }
    return text;
}

std::string make_stl(const ExportedBlocks& exported) {
    constexpr std::size_t kStlHeader = 80;
    std::string triangles;
    std::uint32_t count = 0;
    for (const ExportedBlock& block : exported.blocks) {
        const SurfaceMesh mesh = make_surface_mesh(*block.shape);
        for (const auto& triangle : mesh.triangles) {
            std::array<Vector3, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) corners[i] = block.position + block.orientation * mesh.places[triangle[i]];
            append_vector(triangles, (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
            for (const Vector3& corner : corners) append_vector(triangles, corner);
            append_bytes(triangles, std::uint16_t{0});
            ++count;
        }
    }
    // a text STL begins with "solid"
    std::string header = "musim, in m, z up";
    header.resize(kStlHeader, ' ');
    append_bytes(header, count);
    return header + triangles;
}

}  // namespace musim::lsdem
