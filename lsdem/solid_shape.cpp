#include <memory>
#include <stdexcept>

#include "lsdem/shape.hpp"
#include "lsdem/solid/bearing_side.hpp"

namespace musim::lsdem {
Shape make_solid_shape(const Solid& drawn, const std::optional<MassProperties>& given) {
    const MassProperties mass = given ? *given : compute_mass_properties(drawn);
    if (!(mass.volume > 0.0)) throw std::invalid_argument("make_solid_shape: the solid has no volume");
    const PrincipalAxes principal = find_principal_axes(mass.inertia_over_mass);
    if (!(principal.moments.minCoeff() > 0.0)) throw std::invalid_argument("make_solid_shape: moments of inertia must be positive");
    Shape shape;
    shape.own = Placing{principal.axes, mass.centre}.inverse();
    const auto solid = std::make_shared<const Solid>(moved(drawn, shape.own));
    const Bounds bounds = find_bounds(*solid);
    shape.half_extents = bounds.high.cwiseMax(-bounds.low);
    shape.level_set = BoxLevelSet{shape.half_extents};
    shape.solid = solid;
    shape.volume = mass.volume;
    shape.inertia_over_mass = principal.moments;
    shape.face_area = find_bearing_side(drawn, -Vector3::UnitZ()).area();
    return shape;
}

}  // namespace musim::lsdem
