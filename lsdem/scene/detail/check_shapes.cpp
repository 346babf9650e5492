#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "lsdem/scene/detail/each_structure.hpp"
#include "lsdem/scene/detail/require.hpp"
#include "scaling/angle.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem::detail {
namespace {

/// Part of the largest entry of a tensor by which it may be written unsymmetric [-].
constexpr double kSymmetric = 1e-9;

/// Checks the named shapes of a scene.
class ShapeCheck {
  public:
    ShapeCheck(const Scene& scene, JsonPlace place) : scene_(scene), place_(std::move(place)) {}

    void check(const std::string& name, const ShapeEntry& shape) const {
        const JsonPlace place = place_.at(name);
        std::visit([&](const auto& form) { require_fields(form, place), check_form(form, place); }, shape.form);
        require_fields(shape, place);
        require_rotation(shape.quaternion, place.at("quaternion"));
        check_mass(shape, place);
        if (const auto* compound = std::get_if<CompoundForm>(&shape.form)) check_parts(*compound, shape, name);
    }

    /// That a name is that of a shape.
    void require_known(const std::string& name, const JsonPlace& place) const {
        if (scene_.shapes.contains(name)) return;
        if (scene_.shapes.empty()) fail(place, fmt::format("\"{}\" is no shape of the scene (it has no /shapes); add it there", name));
        std::vector<std::string> known;
        for (const auto& [key, unused] : scene_.shapes) known.push_back(key);
        const std::string nearest = scaling::find_nearest_name(name, known);
        fail(place, fmt::format("\"{}\" is not among the scene's shapes ({}); {}", name, fmt::join(known, ", "),
                                nearest.empty() ? "add it under /shapes" : fmt::format("did you mean \"{}\"?", nearest)));
    }

  private:
    void check_form(const BoxForm& /*box*/, const JsonPlace& /*place*/) const {}
    void check_form(const SphereShape& /*sphere*/, const JsonPlace& /*place*/) const {}
    void check_form(const CylinderForm& /*cylinder*/, const JsonPlace& /*place*/) const {}
    void check_form(const PrismForm& prism, const JsonPlace& place) const {
        if (prism.outline.size() < 3)
            fail(place.at("outline"), fmt::format("{} corners (an outline has three at least); add some", prism.outline.size()));
    }
    void check_form(const PolyhedronForm& polyhedron, const JsonPlace& place) const {
        const std::size_t count = polyhedron.vertices.size();
        if (count < 4) fail(place.at("vertices"), fmt::format("{} points (a solid has four corners at least); add some", count));
        for (std::size_t f = 0; f < polyhedron.faces.size(); ++f) {
            const std::vector<std::uint32_t>& face = polyhedron.faces[f];
            const JsonPlace here = place.at("faces").at(f);
            if (face.size() < 3) fail(here, fmt::format("{} corners (a face has three at least); correct the list", face.size()));
            for (std::size_t k = 0; k < face.size(); ++k) {
                if (face[k] >= count)
                    fail(here.at(k), fmt::format("{} is no vertex (they are 0 to {}); correct the number", face[k], count - 1));
            }
        }
    }
    void check_form(const MeshForm& mesh, const JsonPlace& place) const { require_unit(mesh.unit, place.at("unit")); }
    void check_form(const CompoundForm& compound, const JsonPlace& place) const {
        if (compound.file.has_value() != compound.unit.has_value())
            fail(place.at("unit"), "a unit belongs to a file (parts have theirs as quantities); give both or none");
        if (compound.unit) require_unit(*compound.unit, place.at("unit"));
        if (!compound.file && compound.parts.empty()) fail(place.at("parts"), "no part (a compound has one at least); add one");
    }

    static void require_unit(const std::string& unit, const JsonPlace& place) {
        try {
            scaling::parse_quantity<scaling::Length>("1 " + unit);
        } catch (const scaling::ParseError&) {
            fail(place, fmt::format("\"{}\" is no unit of length; write \"m\", \"mm\" or another", unit));
        }
    }

    static void check_mass(const ShapeEntry& shape, const JsonPlace& place) {
        if (shape.centre && !shape.inertia)
            fail(place.at("centre"),
                 "a body whose centre is given is not homogeneous, so its inertia is not known; give \"inertia\" as well");
        if (!shape.inertia) return;
        if (!shape.mass) fail(place.at("inertia"), "the mass that it belongs to is not given; give \"mass\" as well");
        const auto& tensor = *shape.inertia;
        double largest = 0.0;
        for (const auto& row : tensor) {
            for (const scaling::Inertia& entry : row) largest = std::max(largest, std::abs(entry.value()));
        }
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                if (std::abs((tensor[i][k] - tensor[k][i]).value()) <= kSymmetric * largest) continue;
                fail(place.at("inertia").at(i).at(k), fmt::format("{:.6g} is not {:.6g} on the other side of the diagonal (a tensor of "
                                                                  "inertia is symmetric); correct one of the two",
                                                                  tensor[i][k].value(), tensor[k][i].value()));
            }
        }
    }

    /// Parts are solids of known shapes, and no compound is a part of itself.
    void check_parts(const CompoundForm& compound, const ShapeEntry& whole, const std::string& name) const {
        for (std::size_t k = 0; k < compound.parts.size(); ++k) {
            const CompoundPart& part = compound.parts[k];
            const JsonPlace place = place_.at(name).at("parts").at(k);
            require_known(part.shape, place.at("shape"));
            require_fields(part, place);
            require_rotation(part.quaternion, place.at("quaternion"));
            const ShapeEntry& shape = scene_.shapes.at(part.shape);
            if (shape.is_sphere())
                fail(place.at("shape"), fmt::format("\"{}\" is a sphere (parts have flat faces); use another", part.shape));
            if (shape.mass && !whole.mass) {
                fail(place.at("shape"), fmt::format("\"{}\" has a mass of its own (that of the whole does not follow from it); give the "
                                                    "compound its \"mass\", \"centre\" and \"inertia\"",
                                                    part.shape));
            }
            std::set<std::string> seen;
            if (contains(part.shape, name, seen))
                fail(place.at("shape"), fmt::format("\"{}\" has \"{}\" as a part of itself; use another", part.shape, name));
        }
    }

    /// Is `wanted` this shape or, at any level, a part of it? `seen`: shapes that have been asked.
    bool contains(const std::string& name, const std::string& wanted, std::set<std::string>& seen) const {
        if (name == wanted) return true;
        const auto found = scene_.shapes.find(name);
        const auto* compound = found == scene_.shapes.end() ? nullptr : std::get_if<CompoundForm>(&found->second.form);
        return compound != nullptr && seen.insert(name).second &&
               std::any_of(compound->parts.begin(), compound->parts.end(),
                           [&](const CompoundPart& part) { return contains(part.shape, wanted, seen); });
    }

    const Scene& scene_;
    JsonPlace place_;
};

}  // namespace

void require_rotation(const std::array<double, 4>& quaternion, const JsonPlace& place) {
    const auto& [w, x, y, z] = quaternion;
    const double norm_squared = w * w + x * x + y * y + z * z;
    if (!(norm_squared > 0.0) || !std::isfinite(norm_squared)) {
        fail(place, "no rotation (all four numbers are zero, or one is not finite); write [1, 0, 0, 0] for none");
    }
}

namespace {

/// Checks the names of shapes in a structure, and what must hold before its blocks are listed.
class NameCheck {
  public:
    NameCheck(const Scene& scene, const ShapeCheck& shapes) : scene_(scene), shapes_(shapes) {}

    void check(const BlockList& list, const JsonPlace& place) const {
        for (std::size_t k = 0; k < list.blocks.size(); ++k) {
            const BlockEntry& block = list.blocks[k];
            if (block.shape.empty()) continue;
            const JsonPlace here = place.at("blocks").at(k);
            shapes_.require_known(block.shape, here.at("shape"));
            if (block.density && scene_.shapes.at(block.shape).mass) {
                fail(here.at("density"),
                     fmt::format("the shape \"{}\" has a mass, whatever the density; leave one of the two out", block.shape));
            }
        }
    }
    void check(const ShapeColumn& column, const JsonPlace& place) const {
        if (column.blocks.empty()) fail(place.at("blocks"), "no block (nothing to simulate); name a shape");
        for (std::size_t k = 0; k < column.blocks.size(); ++k) require_flat(column.blocks[k], place.at("blocks").at(k));
    }
    void check(const Tower& tower, const JsonPlace& place) const {
        if (!tower.shape.empty()) require_flat(tower.shape, place.at("shape"));
    }
    void check(const Arch& arch, const JsonPlace& place) const {
        require_fields(arch, place);
        constexpr double kTurn = 2.0 * std::numbers::pi, kLeast = 1e-3;
        const double embrace = arch.embrace.value(), part = embrace / arch.voussoirs;
        if (!(embrace < kTurn)) {
            fail(place.at("embrace"),
                 fmt::format("{:.6g} deg (an arch has two springings, so it embraces less than 360 deg); correct the angle",
                             embrace * scaling::kDegrees));
        }
        if (!(part < std::numbers::pi && part >= kLeast)) {
            fail(place.at("voussoirs"),
                 fmt::format("{} (a voussoir embraces {:.3g} deg, and must from {:.3g} to below 180 deg); correct the number",
                             arch.voussoirs, part * scaling::kDegrees, kLeast * scaling::kDegrees));
        }
        if (!(arch.thickness < 2.0 * arch.radius)) {
            fail(place.at("thickness"),
                 fmt::format("{} (the radius is that of the middle of the thickness, and must be more than half of it: "
                             "{}); correct one of the two",
                             describe(arch.thickness), describe(arch.radius)));
        }
    }
    void check(const Column& /*column*/, const JsonPlace& /*place*/) const {}
    void check(const Wall& /*wall*/, const JsonPlace& /*place*/) const {}

  private:
    void require_flat(const std::string& name, const JsonPlace& place) const {
        shapes_.require_known(name, place);
        if (scene_.shapes.at(name).is_sphere()) fail(place, fmt::format("\"{}\" is a sphere (nothing stands on it); use another", name));
    }

    const Scene& scene_;
    const ShapeCheck& shapes_;
};

/// Checks that all blocks of a scene meet in one way.
class KindCheck {
  public:
    explicit KindCheck(const Scene& scene) : scene_(scene) {}

    void see(const BlockList& list, const JsonPlace& place) {
        for (std::size_t k = 0; k < list.blocks.size(); ++k) {
            const ShapeEntry* shape = scene_.find_shape(list.blocks[k]);
            const JsonPlace here = place.at("blocks").at(k);
            see_block(scene_.is_sphere(list.blocks[k]), shape != nullptr ? here.at("shape") : here);
            if (shape != nullptr) see_shape(list.blocks[k].shape, here.at("shape"));
        }
    }
    void see(const ShapeColumn& column, const JsonPlace& place) {
        for (std::size_t k = 0; k < column.blocks.size(); ++k) {
            see_block(false, place.at("blocks").at(k));
            see_shape(column.blocks[k], place.at("blocks").at(k));
        }
    }
    void see(const Arch& /*arch*/, const JsonPlace& place) {
        see_block(false, place);
        require_faces("voussoir", place);
    }
    /// A column, a tower or a wall.
    template <class Layered>
    void see(const Layered& layered, const JsonPlace& place) {
        if constexpr (requires { layered.shape; }) {
            if (!layered.shape.empty()) return see_block(false, place), see_shape(layered.shape, place.at("shape"));
        }
        see_block(std::holds_alternative<SphereShape>(scene_.shape), place);
    }

  private:
    void see_block(bool is_sphere, const JsonPlace& place) {
        if (!has_spheres_) has_spheres_ = is_sphere;
        if (is_sphere == *has_spheres_) return;
        fail(place,
             "spheres and bodies of flat faces in one scene (spheres meet by surface nodes, flat faces by their overlap); use one of "
             "the two");
    }
    void see_shape(const std::string& name, const JsonPlace& place) const {
        const ShapeEntry& shape = scene_.shapes.at(name);
        if (!shape.is_sphere() && !shape.is_box()) require_faces(name, place);
    }
    void require_faces(const std::string& name, const JsonPlace& place) const {
        if (scene_.face_contact == FaceContact::overlap && !std::holds_alternative<GridShape>(scene_.shape)) return;
        fail(place, fmt::format("\"{}\" has no surface nodes (only boxes and spheres have); leave \"faces\": \"nodes\" and \"level_set\": "
                                "\"grid\" out",
                                name));
    }

    const Scene& scene_;
    std::optional<bool> has_spheres_;  ///< is the first block one?
};

}  // namespace

void check_shapes(const Scene& scene, const JsonPlace& root) {
    const ShapeCheck shapes(scene, root.at("shapes"));
    for (const auto& [name, shape] : scene.shapes) shapes.check(name, shape);
    const NameCheck names(scene, shapes);
    for_each_structure(scene, root, [&](const auto& structure, const JsonPlace& place) { names.check(structure, place); });
}

void check_kinds(const Scene& scene, const JsonPlace& root) {
    KindCheck kinds(scene);
    for_each_structure(scene, root, [&](const auto& structure, const JsonPlace& place) { kinds.see(structure, place); });
}

}  // namespace musim::lsdem::detail
