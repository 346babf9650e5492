#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lsdem/scene/detail/require.hpp"
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

void check_shapes(const Scene& scene, const JsonPlace& root) {
    const ShapeCheck shapes(scene, root.at("shapes"));
    for (const auto& [name, shape] : scene.shapes) shapes.check(name, shape);
    const auto* list = std::get_if<BlockList>(&scene.structure);
    if (list == nullptr) return;
    const JsonPlace place = root.at("structure").at("blocks");
    for (std::size_t k = 0; k < list->blocks.size(); ++k) {
        const BlockEntry& block = list->blocks[k];
        if (block.shape.empty()) continue;
        shapes.require_known(block.shape, place.at(k).at("shape"));
        if (block.density && scene.shapes.at(block.shape).mass) {
            fail(place.at(k).at("density"),
                 fmt::format("the shape \"{}\" has a mass, whatever the density; leave one of the two out", block.shape));
        }
    }
}

void check_kinds(const Scene& scene, const JsonPlace& root) {
    const auto* list = std::get_if<BlockList>(&scene.structure);
    if (list == nullptr) return;
    const JsonPlace place = root.at("structure").at("blocks");
    for (std::size_t k = 0; k < list->blocks.size(); ++k) {
        const ShapeEntry* shape = scene.find_shape(list->blocks[k]);
        const JsonPlace here = shape != nullptr ? place.at(k).at("shape") : place.at(k);
        if (scene.is_sphere(list->blocks[k]) != scene.is_sphere(list->blocks.front())) {
            fail(here,
                 "spheres and bodies of flat faces in one scene (spheres meet by surface nodes, flat faces by their overlap); use one of "
                 "the two");
        }
        if (shape == nullptr || shape->is_sphere() || shape->is_box()) continue;
        if (scene.face_contact == FaceContact::overlap && std::holds_alternative<BoxShape>(scene.shape)) continue;
        fail(here, fmt::format("\"{}\" has no surface nodes (only boxes and spheres have); leave \"faces\": \"nodes\" and \"level_set\": "
                               "\"grid\" out",
                               list->blocks[k].shape));
    }
}

}  // namespace musim::lsdem::detail
