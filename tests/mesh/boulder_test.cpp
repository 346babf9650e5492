#include <doctest/doctest.h>

#include <filesystem>

#include "lsdem/mesh/mesh_solid.hpp"
#include "lsdem/mesh/read_mesh.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "tests/mesh/made_meshes.hpp"
#include "tests/support/gunzip.hpp"

/// Two granite boulders beside the checkout, used where they are there.
namespace musim::lsdem {
namespace {

const std::filesystem::path kRocks = std::filesystem::path(MUSIM_SOURCE_DIR) / ".." / "shared" / "rocks" / "rocks";

bool have_rocks() {
    if (std::filesystem::is_directory(kRocks)) return true;
    MESSAGE("skipped: there are no boulders in ../shared/rocks");
    return false;
}

}  // namespace

TEST_CASE("the hulls of two boulders are taken as they are") {
    if (!have_rocks()) return;
    for (const char* const name : {"SP1_hull.obj", "SP2_hull.obj"}) {
        const ClosedParts mesh = split_mesh(read_mesh(kRocks / name));
        CHECK(describe_parts(mesh) == "OBJ: 1 closed part, 396 triangles, 200 corners");
        const MeshSolids solids = make_mesh_solids(mesh, {});
        REQUIRE(solids.solids.size() == 1);
        CHECK(solids.solids[0].solid.faces.size() == 396);
        CHECK(solids.solids[0].dent < 1e-6);  // the last digit of its coordinates
    }
    // rocks.json, six digits
    const MeshSolids first = make_mesh_solids(split_mesh(read_mesh(kRocks / "SP1_hull.obj")), {});
    CHECK(compute_mass_properties({{first.solids[0].solid}}).volume == doctest::Approx(0.133335).epsilon(1e-5));
}

TEST_CASE("the scan of a boulder is refused with its deepest dent") {
    if (!have_rocks()) return;
    const musim::tests::TemporaryFolder folder;
    const auto path = folder.write("SP1_mesh.obj", musim::tests::gunzip(kRocks / "SP1_mesh.obj.gz"));
    const ClosedParts mesh = split_mesh(read_mesh(path));
    // rocks.json, five digits; four triangles that its five decimals make edges
    CHECK(mesh.parts[0].volume == doctest::Approx(0.12386).epsilon(1e-4));
    CHECK(mesh.left_out == 4);
    tests::check_mesh_refused(
        [&] { make_mesh_solids(mesh, {}); },
        "SP1_mesh.obj: part 0 is not convex: at (-0.271075805, 0.045532194, -0.22011819) m its surface lies 0.04614 m below");
}

}  // namespace musim::lsdem
