#include "lsdem/scene/scale_scene.hpp"

#include <fmt/format.h>

#include "lsdem/scene/detail/scene_fields.hpp"
#include "lsdem/scene/reference_block.hpp"

namespace musim::lsdem {

namespace {

/// Multiplies quantities in place by the factors of one similitude.
class Scaler {
  public:
    explicit Scaler(const scaling::Similitude& similitude) : similitude_(similitude) {}

    template <class Value>
    void scale(Value& value) const {
        if constexpr (scaling::QuantityWithUnit<Value>) value = similitude_.to_model(value);
        if constexpr (detail::kHasFields<Value>) scale_part(value);
    }
    template <class Value, std::size_t Count>
    void scale(std::array<Value, Count>& values) const {
        for (Value& value : values) scale(value);
    }
    template <class Value>
    void scale(std::vector<Value>& values) const {
        for (Value& value : values) scale(value);
    }
    template <class Value>
    void scale(std::optional<Value>& value) const {
        if (value) scale(*value);
    }
    /// Every quantity of a part; numbers stay.
    template <class Part>
    void scale_part(Part& part) const {
        detail::for_each_field(part, [&](const auto& /*field*/, auto& value) { scale(value); });
    }
    void scale_part(BlockMaterial& material) const {
        scale_part<BlockMaterial>(material);
        material.friction *= similitude_.friction();
    }
    void scale_part(PairEntry& pair) const {
        scale_part<PairEntry>(pair);
        if (pair.friction) *pair.friction *= similitude_.friction();
    }
    void scale_part(BlockList& list) const {
        for (BlockEntry& block : list.blocks) {
            scale(block.size);
            scale_part(block);
        }
    }
    /// Coordinates of a file stay what they are, so that what multiplies them takes the factor.
    void scale_part(ShapeEntry& shape) const {
        const auto* compound = std::get_if<CompoundForm>(&shape.form);
        if (std::holds_alternative<MeshForm>(shape.form) || (compound != nullptr && compound->file)) {
            for (double& factor : shape.scale) factor *= similitude_.length();
        }
        std::visit([&](auto& form) { scale_part(form); }, shape.form);
        scale_part<ShapeEntry>(shape);
    }
    void scale_part(CompoundForm& compound) const {
        for (CompoundPart& part : compound.parts) scale_part(part);
    }
    void scale_part(Assembly& assembly) const {
        for (PlacedStructure& placed : assembly.structures) {
            std::visit([&](auto& structure) { scale_part(structure); }, placed.structure);
            scale_part(placed);
        }
    }
    /// The source stays, and takes the factors.
    void scale(SceneMotion& motion) const {
        if (std::holds_alternative<std::monostate>(motion.source)) return;
        scale(motion.pivot);
        motion.factors.time *= similitude_.time();
        motion.factors.velocity *= similitude_.velocity();
        motion.factors.velocity_vertical *= similitude_.velocity_vertical();
    }

  private:
    const scaling::Similitude& similitude_;
};

}  // namespace

Scene scale_scene(const Scene& scene, const scaling::Similitude& similitude) {
    const Scaler scaler(similitude);
    Scene scaled = scene;
    for (scaling::Acceleration& component : scaled.gravity) component *= similitude.gravity();
    scaler.scale_part(scaled.material);
    for (auto& [name, material] : scaled.materials) scaler.scale_part(material);
    for (PairEntry& pair : scaled.pairs) scaler.scale_part(pair);
    std::visit([&](auto& shape) { scaler.scale_part(shape); }, scaled.shape);
    for (auto& [name, shape] : scaled.shapes) scaler.scale_part(shape);
    std::visit([&](auto& structure) { scaler.scale_part(structure); }, scaled.structure);
    if (scaled.scatter) scaler.scale_part(*scaled.scatter);
    scaler.scale(scaled.base_motion);
    for (MotionEntry& entry : scaled.motions) {
        scaler.scale(entry.base_motion);
        scaler.scale_part(entry);
    }
    for (LoadEntry& load : scaled.loads) scaler.scale_part(load);
    if (scaled.ground.friction) *scaled.ground.friction *= similitude.friction();
    if (scaled.preparation) scaler.scale(scaled.preparation->damping_rate);
    scaler.scale(scaled.time.duration);
    scaler.scale(scaled.time.step);
    scaler.scale_part(scaled.output);
    for (SensorEntry& sensor : scaled.sensors) scaler.scale_part(sensor);
    check_scene(scaled, fmt::format("{} at 1:{:.6g}", scene.place(), 1.0 / similitude.length()));
    return scaled;
}

Scene scale_with_own_material(const Scene& scene, const scaling::Similitude& similitude, const MeasuredMaterial& measured) {
    Scene scaled = scale_scene(scene, similitude);
    const double shear_damping_ratio = scaled.material.shear_damping_ratio;
    scaled.material = fit_to_block(measured, reference_block(scaled));
    scaled.material.shear_damping_ratio = shear_damping_ratio;
    scaled.time.step.reset();
    return scaled;
}

}  // namespace musim::lsdem
