#pragma once

#include "lsdem/scene/scene.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// The similar twin of a scene: every quantity multiplied by its scale factor, which its dimension and the law give.
///
/// Friction coefficients are multiplied by λ_μ and gravity by λ_g (not by the law's factor of accelerations). The base motion keeps its
/// description; the factors of time and velocity, of a vertical shaking its own, are noted in it and applied to its samples.
/// Multiplications only: for λ_l = 1/16, 1/64,
/// ... and the other factors powers of two, models and histories are exactly similar, bit for bit. Throws SceneError when a scaled value
/// leaves the range of doubles.
Scene scale_scene(const Scene& scene, const scaling::Similitude& similitude);

/// The twin built of a measured material: geometry, motion, times and rates scaled; density, stiffnesses (fitted to the scaled block,
/// fit_to_block), friction and restitution replaced by that material's; the time step becomes automatic, because stiffness is not similar.
/// The optional shear damping ratio and further materials of a block list stay those of scale_scene.
Scene scale_with_own_material(const Scene& scene, const scaling::Similitude& similitude, const MeasuredMaterial& measured);

}  // namespace musim::lsdem
