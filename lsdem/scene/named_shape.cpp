#include "lsdem/scene/named_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lsdem/mesh/mesh_solid.hpp"
#include "lsdem/mesh/read_mesh.hpp"
#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/compound.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {
namespace {

using detail::JsonPlace;

/// Part of the largest principal moment by which the other two may fall short of it: rounding of written tensors [-].
constexpr double kFlatBody = 1e-6;

template <class Quantity>
Vector3 to_si(const Triple<Quantity>& triple) {
    return {triple[0].value(), triple[1].value(), triple[2].value()};
}

/// Rotation by four numbers of any length; by those of quarter turns exactly.
Matrix3 find_rotation(const std::array<double, 4>& quaternion) {
    const auto& [w, x, y, z] = quaternion;
    const double n = w * w + x * x + y * y + z * z;
    Matrix3 rotation;
    rotation << w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),  //
        2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x),          //
        2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z;
    return rotation / n;
}

/// Makes the solids of a scene's shapes.
class SolidMaker {
  public:
    explicit SolidMaker(const Scene& scene) : scene_(scene), place_(JsonPlace{scene.place() + ": /"}.at("shapes")) {}

    DrawnSolid make(const std::string& name) const {
        const ShapeEntry& shape = scene_.shapes.at(name);
        try {
            const DrawnSolid drawn = std::visit([&](const auto& form) { return draw(form); }, shape.form);
            return place(drawn, shape);
        } catch (const std::invalid_argument& error) {
            detail::fail(place_.at(name), error.what());
        } catch (const MeshError& error) {
            detail::fail(place_.at(name), error.what());
        }
    }

  private:
    static DrawnSolid draw(const BoxForm& box) { return {make_box_solid(to_si(box.size))}; }

    static DrawnSolid draw(const PrismForm& prism) {
        std::vector<Eigen::Vector2d> outline;
        for (const auto& [u, v] : prism.outline) outline.emplace_back(u.value(), v.value());
        // a tapered one is about the outline's own origin
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        if (prism.taper == 1.0) {
            Eigen::Vector2d low = outline.front(), high = low;
            for (const Eigen::Vector2d& p : outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
            middle = 0.5 * low + 0.5 * high;
            for (Eigen::Vector2d& p : outline) p -= middle;
        }
        const int w = static_cast<int>(prism.axis), u = (w + 1) % 3, v = (w + 2) % 3;
        Matrix3 axes = Matrix3::Zero();
        axes(u, 0) = axes(v, 1) = axes(w, 2) = 1.0;
        const Solid solid = make_prism(outline, prism.length.value(), prism.taper);
        return {moved(solid, {axes, Vector3::Zero()}), axes * Vector3(middle.x(), middle.y(), 0.0)};
    }

    static DrawnSolid draw(const CylinderForm& drum) {
        return {make_drum(drum.radius.value(), drum.height.value(), drum.flats, drum.top_radius.value_or(drum.radius).value())};
    }

    static DrawnSolid draw(const PolyhedronForm& polyhedron) {
        Mesh mesh;
        for (const auto& vertex : polyhedron.vertices) mesh.vertices.push_back(to_si(vertex));
        if (polyhedron.faces.empty()) {
            Vector3 low = mesh.vertices.front(), high = low;
            for (const Vector3& x : mesh.vertices) low = low.cwiseMin(x), high = high.cwiseMax(x);
            const Vector3 middle = 0.5 * low + 0.5 * high;
            for (Vector3& x : mesh.vertices) x -= middle;
            return {{{make_convex_hull(mesh.vertices)}}, middle};
        }
        mesh.file = "faces";
        mesh.groups.emplace_back();
        for (const std::vector<std::uint32_t>& face : polyhedron.faces) {
            mesh.faces.push_back({.first = static_cast<std::uint32_t>(mesh.loops.size()),
                                  .count = static_cast<std::uint32_t>(face.size()),
                                  .group = 0,
                                  .line = 0});
            mesh.loops.insert(mesh.loops.end(), face.begin(), face.end());
        }
        return join(make_mesh_solids(choose_part(split_mesh(mesh)), {}));
    }

    static DrawnSolid draw(const MeshForm& mesh) {
        const ClosedParts parts = split_mesh(read_mesh(mesh.file));
        if (!mesh.part) return join(make_mesh_solids(choose_part(parts), find_unit(mesh.unit)));
        return std::visit([&](const auto& part) { return join(make_mesh_solids(choose_part(parts, part), find_unit(mesh.unit))); },
                          *mesh.part);
    }

    DrawnSolid draw(const CompoundForm& compound) const {
        if (compound.file) return join(make_mesh_solids(split_mesh(read_mesh(*compound.file)), find_unit(*compound.unit)));
        DrawnSolid whole;
        std::vector<Polyhedron> pieces;
        for (std::size_t k = 0; k < compound.parts.size(); ++k) {
            const CompoundPart& part = compound.parts[k];
            const DrawnSolid drawn = make(part.shape);
            const Matrix3 rotation = find_rotation(part.quaternion);
            const Vector3 at = to_si(part.position) + rotation * drawn.origin;
            if (k == 0) whole.origin = at;
            const Solid solid = moved(drawn.solid, {rotation, at - whole.origin});
            pieces.insert(pieces.end(), solid.pieces.begin(), solid.pieces.end());
        }
        whole.solid = make_compound(pieces);
        return whole;
    }

    static DrawnSolid draw(const SphereShape& /*sphere*/) { throw std::invalid_argument("a sphere has no flat faces"); }

    static MeshUnit find_unit(const std::string& name) { return {name, scaling::parse_quantity<scaling::Length>("1 " + name).value()}; }

    /// The solid of all parts of a file, of which those that share a face touch to the rounding of its digits.
    static DrawnSolid join(const MeshSolids& mesh) {
        constexpr double kTouchingInFile = 2.0 * MeshLimits{}.dent;  // both faces are rounded
        if (mesh.solids.size() == 1) return {{{mesh.solids.front().solid}}, mesh.origin};
        std::vector<Polyhedron> parts;
        for (const MeshSolid& part : mesh.solids) parts.push_back(part.solid);
        return {make_compound(parts, kTouchingInFile), mesh.origin};
    }

    /// Scaled, mirrored and turned.
    static DrawnSolid place(DrawnSolid drawn, const ShapeEntry& shape) {
        Vector3 factors(shape.scale[0], shape.scale[1], shape.scale[2]);
        if (shape.mirror) factors[static_cast<int>(*shape.mirror)] *= -1.0;
        if (factors != Vector3::Ones()) drawn = {stretched(drawn.solid, factors), factors.cwiseProduct(drawn.origin)};
        const Matrix3 rotation = find_rotation(shape.quaternion);
        if (rotation != Matrix3::Identity()) drawn = {moved(drawn.solid, {rotation, Vector3::Zero()}), rotation * drawn.origin};
        return drawn;
    }

    const Scene& scene_;
    JsonPlace place_;
};

/// Mass properties with what is given apart from the shape, about the point that the solid is drawn about.
MassProperties find_given_mass(const ShapeEntry& shape, const DrawnSolid& drawn, const JsonPlace& place) {
    MassProperties mass = compute_mass_properties(drawn.solid);
    if (shape.centre) {
        mass.centre = to_si(*shape.centre) - drawn.origin;
        const Bounds bounds = find_bounds(drawn.solid);
        if ((mass.centre - bounds.low).minCoeff() < 0.0 || (bounds.high - mass.centre).minCoeff() < 0.0) {
            const Vector3 low = bounds.low + drawn.origin, high = bounds.high + drawn.origin;
            detail::fail(place.at("centre"),
                         fmt::format("it lies outside of the solid, which is from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m; "
                                     "correct it, or its unit",
                                     low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
        }
    }
    if (!shape.inertia) return mass;
    const auto& tensor = *shape.inertia;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(k);
            mass.inertia_over_mass(i, k) = 0.5 * (tensor[row][column] + tensor[column][row]).value() / shape.mass->value();
        }
    }
    const Vector3 moments = find_principal_axes(mass.inertia_over_mass).moments;
    if (!(moments.minCoeff() > 0.0) || moments.sum() - 2.0 * moments.maxCoeff() < -kFlatBody * moments.maxCoeff()) {
        detail::fail(
            place.at("inertia"),
            fmt::format("principal moments {:.4g}, {:.4g} and {:.4g} kg m^2 are those of no body (each is positive, and at most the sum "
                        "of the other two); correct the tensor",
                        shape.mass->value() * moments[0], shape.mass->value() * moments[1], shape.mass->value() * moments[2]));
    }
    return mass;
}

}  // namespace

DrawnSolid make_drawn_solid(const Scene& scene, const std::string& name) { return SolidMaker(scene).make(name); }

Shape make_named_shape(const Scene& scene, const std::string& name) {
    const ShapeEntry& entry = scene.shapes.at(name);
    const JsonPlace place = JsonPlace{scene.place() + ": /"}.at("shapes").at(name);
    const DrawnSolid drawn = make_drawn_solid(scene, name);
    try {
        Shape shape = make_solid_shape(drawn.solid, find_given_mass(entry, drawn, place));
        shape.own = shape.own * Placing{Matrix3::Identity(), -drawn.origin};
        return shape;
    } catch (const std::invalid_argument& error) {
        detail::fail(place, error.what());
    }
}

Triple<scaling::Length> find_box_size(const ShapeEntry& box) {
    Triple<scaling::Length> size = std::get<BoxForm>(box.form).size;
    for (std::size_t k = 0; k < size.size(); ++k) size[k] *= box.scale[k];
    return size;
}

}  // namespace musim::lsdem
