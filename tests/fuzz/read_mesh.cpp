#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "lsdem/mesh/mesh_solid.hpp"
#include "lsdem/mesh/read_mesh.hpp"
#include "tests/fuzz/choose_reader.hpp"

/// Any bytes are a mesh of closed, convex parts or a MeshError of one line. MUSIM_READER names the format: stl, obj or ply.
namespace {

using namespace musim::lsdem;

struct Reader {
    std::string_view name;
    Mesh (*read)(std::string_view bytes, const std::string& file, const MeshLimits& limits);
};

constexpr Reader kReaders[] = {{"stl", parse_stl}, {"obj", parse_obj}, {"ply", parse_ply}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Reader& reader = musim::tests::choose_reader<Reader>(kReaders, "stl");
    try {
        const ClosedParts mesh = split_mesh(reader.read({reinterpret_cast<const char*>(data), size}, "fuzzed", {}));
        for (const ClosedPart& part : mesh.parts) {
            if (!(part.volume > 0.0)) __builtin_trap();
        }
        if (make_mesh_solids(mesh, {}).solids.size() != mesh.parts.size()) __builtin_trap();
    } catch (const MeshError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
