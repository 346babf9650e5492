#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace musim::lsdem {

/// The faces of two boxes that meet at an angle: one across axis k of the follower, on the side `side`, and the one across axis n of the
/// leader that looks at it.
struct TiltedFaces {
    std::uint8_t k = 2, n = 2;
    double side = 1.0;

    bool operator==(const TiltedFaces&) const = default;

    /// As one number from 1 to kCodes.
    std::uint8_t code() const { return static_cast<std::uint8_t>(1 + 2 * (3 * k + n) + (side < 0.0 ? 1 : 0)); }
    static constexpr std::uint8_t kCodes = 18;
    static TiltedFaces of_code(std::uint8_t code) {
        const int faces = (code - 1) / 2;
        return {static_cast<std::uint8_t>(faces / 3), static_cast<std::uint8_t>(faces % 3), code % 2 == 0 ? -1.0 : 1.0};
    }
};

/// Forces at points of the leader, summed so that their moment and their work over a step follow exactly.
struct PlacedForce {
    std::array<double, 3> force{};                    ///< Σ f, follower's frame [N]
    std::array<std::array<double, 3>, 3> by_place{};  ///< Σ f_r p_c, p in the leader's frame [N·m]

    void add(const std::array<double, 3>& f, const std::array<double, 3>& p) {
        for (std::size_t r = 0; r < 3; ++r) {
            force[r] += f[r];
            for (std::size_t c = 0; c < 3; ++c) by_place[r][c] += f[r] * p[c];
        }
    }
    void add(const PlacedForce& other, double weight) {
        for (std::size_t r = 0; r < 3; ++r) {
            force[r] += weight * other.force[r];
            for (std::size_t c = 0; c < 3; ++c) by_place[r][c] += weight * other.by_place[r][c];
        }
    }
};

/// What a pair of boxes that meet at an angle remembers, see lsdem/README.md, "Tilted boxes".
struct TiltedContact {
    bool touches = false;
    TiltedFaces faces;
    double inherited = 0.0;               ///< elastic energy of the patch that this contact follows, before it has met [J]
    double late = 0.0;                    ///< overlap that carries no force [m]
    double area = 0.0;                    ///< of the leader's face inside the follower [m²]
    double polar = 0.0;                   ///< J, second moment of that area about its middle [m⁴]
    std::array<double, 3> slip{};         ///< ξ, follower's frame [m]
    double twist = 0.0;                   ///< θ, elastic turn about the direction of `elastic` [rad]
    std::array<double, 3> place{};        ///< where friction acts, leader's frame [m]
    std::array<double, 3> shear{};        ///< friction and tangential dashpot at the last step, follower's frame [N]
    std::array<double, 3> drag{};         ///< the tangential dashpot alone [N]
    std::array<double, 3> couple{};       ///< friction and dashpot against turning, on the leader, follower's frame [N·m]
    std::array<double, 3> couple_drag{};  ///< the dashpot against turning alone [N·m]
    PlacedForce elastic;                  ///< gradient of the energy, at the last step
    double damping = 0.0;                 ///< the dashpot as a part of it [-]
};

}  // namespace musim::lsdem
