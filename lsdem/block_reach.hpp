#pragma once

#include "lsdem/solid/solid.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Reach of a block from the origin of its body frame along the world's axes [m]; of a box both are the same.
struct BlockReach {
    Vector3 below = Vector3::Zero();  ///< against the axes
    Vector3 above = Vector3::Zero();  ///< along them

    /// Edges of the box along the world's axes that holds the block [m].
    Vector3 extent() const { return below + above; }
};

/// Reach of a solid, or, without one, of a box of the given half edges, body frame [m]. `rotation`: body to world.
inline BlockReach find_block_reach(const Solid* solid, const Vector3& half, const Matrix3& rotation) {
    if (solid == nullptr) {
        const Vector3 reach = rotation.cwiseAbs() * half;
        return {reach, reach};
    }
    const Bounds bounds = find_bounds(*solid, {rotation, Vector3::Zero()});
    return {-bounds.low, bounds.high};
}

}  // namespace musim::lsdem
