#include "lsdem/run/scale_specimen.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "scaling/error.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

/// Multiplies plain SI numbers in place by the factor of the quantity they are.
class Scaler {
  public:
    explicit Scaler(const scaling::Similitude& similitude) : similitude_(similitude) {}

    template <scaling::QuantityWithUnit Quantity, class... Numbers>
    void scale(Numbers&... numbers) const {
        const double factor = similitude_.factor<Quantity>();
        (multiply(numbers, factor), ...);
    }

    void scale_parts(BoxLevelSet& box) const { scale<scaling::Length>(box.half); }
    void scale_parts(GridLevelSet& grid) const {
        const double length = similitude_.length();
        const Vector3 origin = grid.origin() * length;
        const double spacing = grid.spacing() * length;
        const auto index = [&](const Vector3& x, int axis) {
            return static_cast<std::size_t>(std::lround((x[axis] - origin[axis]) / spacing));
        };
        const std::vector<double>& values = grid.values();
        const std::array<std::size_t, 3> counts = grid.counts();
        grid = GridLevelSet(origin, spacing, counts, [&](const Vector3& x) {
            return values[(index(x, 2) * counts[1] + index(x, 1)) * counts[0] + index(x, 0)] * length;
        });
    }

    void scale_parts(Shape& shape) const {
        std::visit([this](auto& level_set) { scale_parts(level_set); }, shape.level_set);
        SurfaceNodes& n = shape.nodes;
        scale<scaling::Length>(n.x, n.y, n.z, n.center_x, n.center_y, n.center_z, n.half_x, n.half_y, n.half_z);
        scale<scaling::Area>(n.area_x, n.area_y, n.area_z);
        scale<scaling::Length>(shape.node_spacing, shape.half_extents);
        scale<scaling::Area>(shape.face_area, shape.inertia_over_mass);
        scale<scaling::Volume>(shape.volume);
        scale<scaling::Length>(shape.own.position);
        if (shape.solid) shape.solid = std::make_shared<const Solid>(stretched(*shape.solid, Vector3::Constant(similitude_.length())));
    }

    void scale_parts(Material& material) const { scale<scaling::StiffnessPerArea>(material.normal_stiffness, material.shear_stiffness); }

    void scale_parts(Block& block) const {
        scale<scaling::Mass>(block.mass);
        scale<scaling::Length>(block.height_offset, block.position);
        scale<scaling::Velocity>(block.velocity);
        scale<scaling::Frequency>(block.angular_velocity);
    }

    void scale_parts(BaseComponents& motion) const {
        for (std::size_t axis = 0; axis < motion.shift.size(); ++axis) {
            BaseComponent& component = motion.shift[axis];
            scale<scaling::Time>(component.start, component.dt);
            multiply(component.velocity, axis == 2 ? similitude_.velocity_vertical() : similitude_.velocity());
            multiply(component.source.velocity, axis == 2 ? similitude_.velocity_vertical() : similitude_.velocity());
            const double acceleration = axis == 2 ? similitude_.acceleration_vertical() : similitude_.acceleration();
            multiply(component.source.acceleration, acceleration);
            multiply(component.source.peak_acceleration, acceleration);
        }
        for (BaseComponent& component : motion.turn) {
            scale<scaling::Time>(component.start, component.dt);
            const double rate = 1.0 / similitude_.time();
            multiply(component.velocity, rate);
            multiply(component.source.velocity, rate);
            multiply(component.source.acceleration, rate * rate);
            multiply(component.source.peak_acceleration, rate * rate);
        }
        scale<scaling::Length>(motion.pivot);
    }

    void scale_parts(Preload& preload) const {
        scale<scaling::Force>(preload.friction);
        scale<scaling::Moment>(preload.couple);
    }

    void scale_parts(Model& model) const {
        for (Shape& shape : model.shapes) scale_parts(shape);
        for (Material& material : model.materials) scale_parts(material);
        for (MaterialPair& pair : model.pairs) scale_parts(pair.joint);
        for (Block& block : model.blocks) scale_parts(block);
        scale_parts(model.ground.material);
        scale_parts(model.ground.motion);
        model.gravity *= similitude_.gravity();
        scale<scaling::Frequency>(model.velocity_damping);
        for (Preload& preload : model.preload) scale_parts(preload);
    }

  private:
    static void multiply(double& number, double factor) { number *= factor; }
    static void multiply(Vector3& vector, double factor) { vector *= factor; }
    static void multiply(std::vector<double>& numbers, double factor) {
        for (double& number : numbers) number *= factor;
    }

    const scaling::Similitude& similitude_;
};

}  // namespace

Specimen scale_specimen(const Specimen& specimen, const scaling::Similitude& similitude) {
    if (!similitude.keeps_statics()) {
        throw scaling::SimilitudeError(fmt::format(
            "similitude: law \"{}\" gives this specimen no image (friction becomes {:.4g} times the prototype's, contacts {:.4g} "
            "times as stiff for their weight); take law \"exact\", or scale the scene and prepare its specimen",
            similitude.law_name(), similitude.friction(), similitude.acceleration() / similitude.gravity()));
    }
    const Scaler scaler(similitude);
    Specimen image = specimen;
    scaler.scale_parts(image.model);
    for (std::size_t b = 0; b < image.drawn.size(); ++b) {
        BoxPose& box = image.drawn[b];
        scaler.scale<scaling::Length>(box.size, box.position);
        box.solid = image.model.shapes[image.model.blocks[b].shape].solid;
    }
    for (PlacedSensor& sensor : image.sensors) {
        if (sensor.place) scaler.scale<scaling::Length>(*sensor.place);
    }
    if (image.settling) scaler.scale<scaling::Frequency>(image.settling->damping_rate);
    return image;
}

BaseComponents scale_motion(BaseComponents motion, const scaling::Similitude& similitude) {
    const Scaler scaler(similitude);
    scaler.scale_parts(motion);
    return motion;
}

}  // namespace musim::lsdem
