#include "lsdem/study/twin_specimen.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "lsdem/block_height.hpp"
#include "lsdem/run/scale_specimen.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/random_bits.hpp"

namespace musim::lsdem {
namespace {

/// Below this length a random vector has no direction to speak of [-].
constexpr double kLeastLength = 0.1;

/// Random vectors, one after another, the same on every machine: sums, products and a root only.
class RandomVectors {
  public:
    explicit RandomVectors(std::uint64_t seed) : seed_(seed) {}

    /// Next point of a cube with edges from −1 to 1.
    Vector3 next() {
        const double x = draw(), y = draw(), z = draw();
        return {x, y, z};
    }
    /// Evenly spread directions of unit length: what lies in the unit ball of the cube's points.
    Vector3 next_direction() {
        for (;;) {
            const Vector3 point = next();
            const double length = std::sqrt(point.x() * point.x() + point.y() * point.y() + point.z() * point.z());
            if (length > kLeastLength && length <= 1.0) return point / length;
        }
    }

  private:
    double draw() { return 2.0 * scaling::to_probability(scaling::random_bits(seed_, drawn_++)) - 1.0; }

    std::uint64_t seed_;
    std::uint64_t drawn_ = 0;
};

/// One unit in the last place of the largest coordinate.
double last_place(const Vector3& position) {
    const double largest = position.cwiseAbs().maxCoeff();
    return std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
}

}  // namespace

Specimen make_twin(const Specimen& prototype, const TwinChoice& choice) {
    Specimen twin = prototype;
    RandomVectors random(choice.directions);
    for (Block& block : twin.model.blocks) {
        if (block.fixed) continue;
        if (choice.shift != 0.0) {
            block.position += choice.shift * 2.0 * half_extents(twin.model, block).z() * random.next_direction();
        } else if (choice.last_place) {
            block.position += last_place(block.position) * random.next().array().round().matrix();
        }
    }
    return scale_specimen(twin, scaling::make_similitude("exact", {.length = choice.length}));
}

}  // namespace musim::lsdem
