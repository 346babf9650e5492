#pragma once

#include "lsdem/model.hpp"
#include "lsdem/scene/material_presets.hpp"

namespace musim::lsdem {

/// One kind of block and what its contacts are made of, as tests on single blocks take it. Upright: b along x, w along y, H along z.
struct BlockSample {
    Vector3 size = Vector3::Zero();    ///< thin b, wide w, height H [m]
    double density = 0.0;              ///< [kg/m³]
    double normal_stiffness = 0.0;     ///< k_n of the face across z [N/m]
    double shear_stiffness = 0.0;      ///< k_s of the same face [N/m]
    double friction = 0.0;             ///< block on block [-]
    double ground_friction = 0.0;      ///< block on ground [-]
    double restitution = 1.0;          ///< [-]
    double shear_damping_ratio = 0.0;  ///< [-]
    double gravity = 0.0;              ///< [m/s²]

    double mass() const { return density * size.prod(); }                      ///< [kg]
    double face_area() const { return size.x() * size.y(); }                   ///< [m²]
    double normal_pressure() const { return normal_stiffness / face_area(); }  ///< K_n [Pa/m]
    double shear_pressure() const { return shear_stiffness / face_area(); }    ///< K_s [Pa/m]
};

/// The block of a preset under standard gravity; the ground is of the same material.
BlockSample make_sample(const MaterialPreset& preset);

/// The same block turned by 90° about the vertical: w along x.
BlockSample turned(BlockSample sample);

/// A model with one shape, one material, the ground, gravity downward, and no blocks yet. Throws std::invalid_argument for sizes, densities
/// or stiffnesses that are not positive, or a restitution outside (0, 1].
Model make_model(const BlockSample& sample);

/// A block of the sample.
Block make_block(const BlockSample& sample, const Vector3& position, const Quaternion& orientation = Quaternion::Identity());

}  // namespace musim::lsdem
