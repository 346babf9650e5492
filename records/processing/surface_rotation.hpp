#pragma once

#include "records/time_series.hpp"

/// Rotation of the ground's surface in a wave that runs along it, from the translations at a point.
///
/// A plane wave of any shape runs along +x with the apparent velocity c (that of the waves below over the sine of their angle from the
/// vertical), u(x, t) = f(t − x/c); z points up. The rotation vector is half the curl of the displacements. At the free surface no shear
/// stress acts, ∂u_x/∂z = −∂u_z/∂x and ∂u_y/∂z = −∂u_z/∂y = 0, so that
///   about y (rocking)   θ_y = ½(∂u_x/∂z − ∂u_z/∂x) = −∂u_z/∂x = u̇_z/c
///   about z (torsion)   θ_z = ½(∂u_y/∂x − ∂u_x/∂y) = ½ ∂u_y/∂x = −u̇_y/(2c)
///   about x             θ_x = 0
/// with rates ü_z/c and −ü_y/(2c), positive by the right hand about +y and +z. Sources: torsion [Newmark69], rocking and torsion of body
/// waves [Trifunac82]. Assumes one c for all frequencies: no dispersion, no waves from other directions, and a foundation that is short
/// beside the wave length, which it would average.
namespace musim::records {

/// Rotation about +y from the vertical component (positive up) of waves that run along +x; a negative velocity is along −x. An acceleration
/// gives the rate, a velocity the angle, a displacement is differentiated first. Throws ProcessingError for a rotation, for a velocity that
/// is zero or not finite, and as differentiate() does.
TimeSeries find_rocking(const TimeSeries& vertical, scaling::Velocity apparent);

/// Rotation about +z from the horizontal component across the waves (positive along +y), likewise.
TimeSeries find_torsion(const TimeSeries& transverse, scaling::Velocity apparent);

}  // namespace musim::records
