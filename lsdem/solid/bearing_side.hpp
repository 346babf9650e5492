#pragma once

#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Points that stand for an area, with its moments up to the second.
struct AreaPoint {
    Vector3 place;  ///< frame of the solid [m]
    double area;    ///< [m²]
};

/// A face of a solid and all others within 15° of it, which may bear together.
struct BearingSide {
    Vector3 normal = Vector3::UnitZ();  ///< of the face, outward
    std::vector<AreaPoint> points;

    double area() const;  ///< [m²]
};

/// The side about the face whose normal is closest to a direction; of several as close the first.
BearingSide find_bearing_side(const Solid& solid, const Vector3& direction);

/// The sides about all faces on the surface of a solid.
std::vector<BearingSide> find_bearing_sides(const Solid& solid);

}  // namespace musim::lsdem
