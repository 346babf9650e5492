#include "tests/benches/similitude_model.hpp"

#include <array>
#include <cstddef>
#include <variant>

#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::lsdem {
namespace {

/// A law that gives heights H from widths b, as seen by the widths.
scaling::Similitude make_width_similitude(const scaling::SolvedLaw& solved) {
    const scaling::ScaleFactors widths{.length = solved.factor("b").value(),
                                       .friction = solved.factor("mu").value(),
                                       .gravity = solved.factor("g").value(),
                                       .density = solved.factor("rho").value()};
    return scaling::Similitude(widths, solved.factor("a").value(), solved.law.name);
}

Triple<scaling::Length>& block_of(Scene& scene) { return std::get<Column>(scene.structure).block; }

void multiply_stiffness(double factor, BlockMaterial& material) {
    material.normal_stiffness *= factor;
    material.shear_stiffness *= factor;
}

void multiply(const Break& broken, Scene& scene) {
    switch (broken.group) {
        case BrokenGroup::none:
            break;
        case BrokenGroup::friction:
            scene.material.friction *= broken.factor;
            break;
        case BrokenGroup::gravity:
            for (scaling::Acceleration& component : scene.gravity) component *= broken.factor;
            break;
        case BrokenGroup::amplitude:
            scene.base_motion.factors.velocity *= broken.factor;
            break;
        case BrokenGroup::duration:
            scene.base_motion.factors.time *= broken.factor;
            scene.base_motion.factors.velocity *= broken.factor;
            break;
        case BrokenGroup::stiffness:
            multiply_stiffness(broken.factor, scene.material);
            break;
        case BrokenGroup::density:
            scene.material.density *= broken.factor;
            break;
        case BrokenGroup::height:
            block_of(scene)[2] *= broken.factor;
            break;
    }
}

}  // namespace

TwinScales make_twin_scales(const std::string& law, const std::vector<scaling::GivenFactor>& given) {
    const scaling::SolvedLaw solved = scaling::solve_law(scaling::load_scale_law(law), given);
    const double heights = 1.0 / solved.factor("tan_alpha").value_or(1.0);
    return {solved.factor("b") ? make_width_similitude(solved) : scaling::make_similitude(solved), heights};
}

std::string_view to_string(BrokenGroup group) {
    constexpr std::array<std::string_view, 8> kNames{"none",     "friction",  "gravity", "amplitude",
                                                     "duration", "stiffness", "density", "height"};
    return kNames[static_cast<std::size_t>(group)];
}

bool Break::shifts_frequencies() const {
    return group == BrokenGroup::stiffness || group == BrokenGroup::density || group == BrokenGroup::height;
}

Scene make_model_scene(BenchScene scene, const TwinScales& scales, const Break& broken) {
    Scene model = scale_scene(make_bench_scene(scene), scales.similitude);
    // higher blocks are heavier, and so much stiffer are their contacts: T²k/m stays
    block_of(model)[2] *= scales.heights;
    multiply_stiffness(scales.heights, model.material);
    multiply(broken, model);
    return model;
}

}  // namespace musim::lsdem
