#include "scaling/model_scales.hpp"

#include "scaling/detail/named_factors.hpp"
#include "scaling/law_similitude.hpp"

namespace musim::scaling {

ModelScales::ModelScales(const Similitude& similitude)
    : law(similitude.law_name()),
      height(similitude.length()),
      width(similitude.length()),
      friction(similitude.friction()),
      gravity(similitude.gravity()),
      mass(similitude.mass()),
      weight(similitude.force_vertical()),
      static_stiffness(similitude.stiffness_static()),
      time(similitude.time()),
      frequency(similitude.frequency()),
      displacement(similitude.length()),
      velocity(similitude.velocity()),
      acceleration(similitude.acceleration()),
      displacement_vertical(displacement),
      velocity_vertical(velocity),
      acceleration_vertical(acceleration) {}

ModelScales make_model_scales(const LawFormulas& formulas, const ChosenFactors& chosen) {
    const detail::NamedFactors factors(formulas, chosen);
    if (factors.find<Length>("l")) return make_similitude(formulas, chosen);
    ModelScales scales;
    scales.law = formulas.solved().law.name;
    scales.height = factors.require<Length>("H");
    scales.width = factors.require<Length>("b");
    scales.friction = factors.find<Ratio>("mu").value_or(1.0);
    scales.gravity = factors.find<Acceleration>("g").value_or(1.0);
    scales.mass = factors.require<Mass>("m");
    scales.weight = scales.mass * scales.gravity;
    scales.static_stiffness = scales.weight / scales.height;
    scales.time = factors.require<Time>("t");
    scales.frequency = 1.0 / scales.time;
    scales.displacement = factors.require<Length>("u");
    scales.velocity = factors.require<Velocity>("v");
    scales.acceleration = factors.require<Acceleration>("a");
    scales.displacement_vertical = factors.require<Length>("u_v");
    scales.velocity_vertical = scales.displacement_vertical / scales.time;
    scales.acceleration_vertical = factors.require<Acceleration>("a_v");
    return scales;
}

}  // namespace musim::scaling
