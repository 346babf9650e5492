#include "tests/benches/similitude_scenes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "lsdem/run/no_slip.hpp"
#include "lsdem/scene/material_presets.hpp"

namespace musim::lsdem {
namespace {

using scaling::Acceleration;
using scaling::kStandardGravity;
using scaling::Length;
using scaling::Time;
using std::numbers::pi;
namespace si = scaling::si;

using Size = Triple<Length>;

/// Samples of a run; a peak between two is missed by (π/n)²/8 of it at most, n samples a half wave.
constexpr double kRunSamples = 2000.0;
/// Samples of a push.
constexpr double kPushSamples = 1000.0;
/// Stiffness of the rocking block's base over the preset's: Housner's is rigid. Stiffer, the rounding of its height over the
/// depth of its edge would show.
constexpr double kStiffBase = 1e3;

const Size kLying{4.25 * si::meters, 2.82 * si::meters, 1.36 * si::meters};
const Size kUpright{1.36 * si::meters, 2.82 * si::meters, 4.25 * si::meters};
const Size kSlender{kRockSlenderness * 6.0 * si::meters, 0.6 * si::meters, 6.0 * si::meters};

/// When the base begins to move: blocks that were put on each other without overlap have come to rest then.
const Time kStart = 0.1 * si::seconds;
const Time kSlidePush = 0.4 * si::seconds;

BlockMaterial concrete(const Size& block) { return fit_to_block(find_material_preset("concrete"), block); }

scaling::Mass mass(const BlockMaterial& material, const Size& size) { return material.density * size[0] * size[1] * size[2]; }

/// Housner's p = √(3g/(4R)).
scaling::Frequency frequency_parameter(const Size& size) {
    const double radius = 0.5 * std::hypot(size[0].value(), size[2].value());
    return std::sqrt(0.75 * kStandardGravity.value() / radius) * si::hertz;
}

Time rock_push() { return pi / (kRockRate * frequency_parameter(kSlender)); }

Scene make_column(BenchScene which, int layers, const Size& block, bool locked, Time duration) {
    Scene made;
    made.name = to_string(which);
    made.material = concrete(block);
    made.structure = Column{.layers = layers, .block = block, .rotation_locked = locked, .height_deviation = {}};
    made.time.duration = duration;
    made.output.spine_rate = kRunSamples / duration;
    // by nodes a flat contact has the papers' springs, K S d²/2; the rims of boxes that overlap depend on depth over width, a group that
    // only laws for elastic bodies keep
    made.face_contact = FaceContact::nodes;
    return made;
}

void shake(Scene& shaken, const Signal& signal, std::optional<Time> dt = {}) {
    shaken.base_motion.source = SignalMotion{.signal = signal, .axis = 0, .start = kStart, .dt = dt};
}

Scene make_slide() {
    Scene made = make_column(BenchScene::slide, 1, kLying, true, kStart + 10.0 * kSlidePush);
    shake(made, HalfSineSignal{kSlideStrength * made.material.friction * kStandardGravity, kSlidePush}, kSlidePush / kPushSamples);
    return made;
}

BlockMaterial stiff_concrete() {
    BlockMaterial material = concrete(kSlender);
    material.normal_stiffness *= kStiffBase;
    material.shear_stiffness *= kStiffBase;
    return material;
}

Scene make_rock() {
    // it is back at about 2/p after the push began
    Scene made = make_column(BenchScene::rock, 1, kSlender, false, kStart + 3.5 / frequency_parameter(kSlender));
    made.material = stiff_concrete();
    made.face_contact = FaceContact::overlap;
    shake(made, HalfSineSignal{kRockStrength * kRockSlenderness * kStandardGravity, rock_push()}, rock_push() / kPushSamples);
    return made;
}

Scene make_shaken_column() {
    Scene made = make_column(BenchScene::column, 5, kUpright, false, 2.5 * si::seconds);
    shake(made, SineSignal{0.5 * kStandardGravity, 1.0 * si::hertz, 2.0});
    return made;
}

Scene make_chain() {
    // the base starts between two samples, not on one, where rounding would decide which of its two velocities is seen
    Scene made = make_column(BenchScene::chain, 5, kUpright, true, 0.26 * si::seconds);
    made.material.friction = detail::kNoSlip;
    made.material.shear_damping_ratio = kChainDamping;
    made.time.safety = kChainSafety;
    shake(made, StepSignal{0.1 * si::meters_per_second});
    return made;
}

}  // namespace

std::string_view to_string(BenchScene scene) {
    constexpr std::array<std::string_view, 4> kNames{"slide", "rock", "column", "chain"};
    return kNames[static_cast<std::size_t>(scene)];
}

Scene make_bench_scene(BenchScene scene) {
    switch (scene) {
        case BenchScene::slide:
            return make_slide();
        case BenchScene::rock:
            return make_rock();
        case BenchScene::column:
            return make_shaken_column();
        case BenchScene::chain:
            break;
    }
    return make_chain();
}

double slide_rigidity() {
    const BlockMaterial material = concrete(kLying);
    return std::sqrt(scaling::Ratio(material.shear_stiffness / mass(material, kLying) * kSlidePush * kSlidePush).value());
}

double rock_sinking() {
    const BlockMaterial material = stiff_concrete();
    return scaling::Ratio(mass(material, kSlender) * kStandardGravity / material.normal_stiffness / kSlender[0]).value();
}

}  // namespace musim::lsdem
