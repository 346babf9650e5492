#pragma once

#include <boost/units/derived_dimension.hpp>
#include <boost/units/quantity.hpp>
#include <boost/units/systems/si/acceleration.hpp>
#include <boost/units/systems/si/area.hpp>
#include <boost/units/systems/si/dimensionless.hpp>
#include <boost/units/systems/si/energy.hpp>
#include <boost/units/systems/si/force.hpp>
#include <boost/units/systems/si/frequency.hpp>
#include <boost/units/systems/si/length.hpp>
#include <boost/units/systems/si/mass.hpp>
#include <boost/units/systems/si/mass_density.hpp>
#include <boost/units/systems/si/momentum.hpp>
#include <boost/units/systems/si/power.hpp>
#include <boost/units/systems/si/pressure.hpp>
#include <boost/units/systems/si/time.hpp>
#include <boost/units/systems/si/velocity.hpp>
#include <boost/units/systems/si/volume.hpp>
#include <type_traits>

/// Quantity types of every public API outside the kernel. Angles are dimensionless: Boost's SI angle would otherwise leak into rates,
/// torques and inertias.
namespace musim::scaling {

namespace units = boost::units;
namespace si = boost::units::si;

namespace detail {
template <class A, class B>
using Product = typename units::multiply_typeof_helper<A, B>::type;
template <class A, class B>
using Quotient = typename units::divide_typeof_helper<A, B>::type;
}  // namespace detail

using Ratio = units::quantity<si::dimensionless>;
using Length = units::quantity<si::length>;
using Area = units::quantity<si::area>;
using Volume = units::quantity<si::volume>;
using Time = units::quantity<si::time>;
using Frequency = units::quantity<si::frequency>;  ///< also rates and angular velocities [1/s]
using Velocity = units::quantity<si::velocity>;
using Acceleration = units::quantity<si::acceleration>;
using Mass = units::quantity<si::mass>;
using Density = units::quantity<si::mass_density>;
using Momentum = units::quantity<si::momentum>;
using Force = units::quantity<si::force>;
using Stress = units::quantity<si::pressure>;  ///< also elastic moduli
using Energy = units::quantity<si::energy>;
using Power = units::quantity<si::power>;
using Stiffness = units::quantity<detail::Quotient<si::force, si::length>>;              ///< [N/m]
using StiffnessPerArea = units::quantity<detail::Quotient<si::pressure, si::length>>;    ///< [Pa/m]
using Damping = units::quantity<detail::Quotient<si::force, si::velocity>>;              ///< [N·s/m]
using Moment = units::quantity<detail::Product<si::force, si::length>>;                  ///< [N·m]
using Inertia = units::quantity<detail::Product<si::mass, si::area>>;                    ///< [kg·m²]
using AngularAcceleration = units::quantity<detail::Quotient<si::frequency, si::time>>;  ///< [1/s²]

/// Arguments of one dimension, by name: a call with another names the concept that does not hold, where a plain parameter would only show
/// the units spelled out.
template <class Q>
concept IsLength = std::is_same_v<Q, Length>;
template <class Q>
concept IsTime = std::is_same_v<Q, Time>;
template <class Q>
concept IsFrequency = std::is_same_v<Q, Frequency>;
template <class Q>
concept IsVelocity = std::is_same_v<Q, Velocity>;
template <class Q>
concept IsAcceleration = std::is_same_v<Q, Acceleration>;
template <class Q>
concept IsMass = std::is_same_v<Q, Mass>;
template <class Q>
concept IsDensity = std::is_same_v<Q, Density>;
template <class Q>
concept IsForce = std::is_same_v<Q, Force>;
template <class Q>
concept IsStiffness = std::is_same_v<Q, Stiffness>;

/// Standard gravity g0 [m/s²].
inline const Acceleration kStandardGravity = 9.80665 * si::meters_per_second_squared;

}  // namespace musim::scaling
