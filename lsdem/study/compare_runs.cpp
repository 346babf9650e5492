#include "lsdem/study/compare_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace musim::lsdem {
namespace {

/// Significant decimal digits of a double.
constexpr int kDoubleDigits = 16;

/// Model quantities that are to be compared with the prototype's after division by one factor.
struct BackScaling {
    double factor = 1.0;

    bool same(double prototype, double model) const { return model / factor == prototype; }
    bool same(const Vector3& prototype, const Vector3& model) const { return model / factor == prototype; }
    bool same(const std::vector<Vector3>& prototype, const std::vector<Vector3>& model) const {
        return std::equal(prototype.begin(), prototype.end(), model.begin(), model.end(),
                          [this](const Vector3& p, const Vector3& m) { return same(p, m); });
    }
};

bool same_energy(const Energy& p, const Energy& m, const BackScaling& back) {
    return back.same(p.kinetic, m.kinetic) && back.same(p.gravitational, m.gravitational) &&
           back.same(p.elastic_normal, m.elastic_normal) && back.same(p.elastic_shear, m.elastic_shear) &&
           back.same(p.friction_loss, m.friction_loss) && back.same(p.damping_loss, m.damping_loss) &&
           back.same(p.base_work, m.base_work) && back.same(p.load_work, m.load_work) && back.same(p.preparation_loss, m.preparation_loss);
}

bool same_losses(const Losses& p, const Losses& m, const BackScaling& back) {
    const auto same = [&](const PairWork& a, const PairWork& b) {
        return back.same(a.friction, b.friction) && back.same(a.damping, b.damping);
    };
    return same(p.ground, m.ground) && std::equal(p.block.begin(), p.block.end(), m.block.begin(), m.block.end(), same);
}

bool same_turn(const BaseState& p, const BaseState& m, const BackScaling& rate, const BackScaling& length) {
    return p.turn.coeffs() == m.turn.coeffs() && rate.same(p.turn_rates.velocity, m.turn_rates.velocity) &&
           BackScaling{rate.factor * rate.factor}.same(p.turn_rates.acceleration, m.turn_rates.acceleration) &&
           length.same(p.pivot, m.pivot);
}

bool are_bitwise_identical(const RunResult& prototype, const RunResult& model, const scaling::Similitude& similitude) {
    const History& p = prototype.history;
    const History& m = model.history;
    if (p.samples() != m.samples()) return false;
    const BackScaling time{similitude.time()};
    const BackScaling length{similitude.length()};
    const BackScaling velocity{similitude.velocity()};
    const BackScaling acceleration{similitude.acceleration()};
    const BackScaling energy{similitude.energy()};
    const BackScaling rate{similitude.frequency()};
    const BackScaling number{1.0};

    for (std::size_t k = 0; k < p.samples(); ++k) {
        if (!time.same(p.time[k], m.time[k]) || !same_energy(p.energy[k], m.energy[k], energy) ||
            !length.same(p.base[k].displacement, m.base[k].displacement) || !velocity.same(p.base[k].velocity, m.base[k].velocity) ||
            !acceleration.same(p.base[k].acceleration, m.base[k].acceleration) || !same_turn(p.base[k], m.base[k], rate, length)) {
            return false;
        }
    }
    const BackScaling force{similitude.force()};
    const bool same_loads =
        std::equal(p.load.begin(), p.load.end(), m.load.begin(), m.load.end(), [&](const LoadState& a, const LoadState& b) {
            return force.same(a.force, b.force) && length.same(a.displacement, b.displacement);
        });
    if (!same_loads) return false;
    const Kinematics& a = prototype.final;
    const Kinematics& b = model.final;
    const auto same_orientation = [](const Quaternion& x, const Quaternion& y) { return x.coeffs() == y.coeffs(); };
    return same_losses(prototype.losses.value(), model.losses.value(), energy) && length.same(p.spine_position, m.spine_position) &&
           velocity.same(p.spine_velocity, m.spine_velocity) && number.same(p.spine_rotation, m.spine_rotation) &&
           length.same(a.position, b.position) && velocity.same(a.velocity, b.velocity) &&
           rate.same(a.angular_velocity, b.angular_velocity) &&
           std::equal(a.orientation.begin(), a.orientation.end(), b.orientation.begin(), b.orientation.end(), same_orientation);
}

/// Sums over time for one spine block.
struct VelocityMeasure {
    double sum_of_squares = 0.0;
    double peak = 0.0;

    void add(const Vector3& v) {
        sum_of_squares += v.squaredNorm();
        peak = std::max(peak, v.norm());
    }
    void cover(const VelocityMeasure& other) {
        sum_of_squares = std::max(sum_of_squares, other.sum_of_squares);
        peak = std::max(peak, other.peak);
    }
};

/// See RunDifference::losses.
std::optional<double> compare_losses(const RunResult& prototype, const RunResult& model, double energy_factor) {
    const Losses &whole = prototype.losses.value(), &of_model = model.losses.value();
    const std::vector<PairWork>&p = whole.block, &m = of_model.block;
    const std::vector<int>& layer = prototype.blocks.layer;
    if (p.size() != m.size() || p.size() > layer.size())
        throw std::invalid_argument("compare_runs: the runs have losses of different blocks");
    const double all = whole.total().total();
    if (!(all > 0.0)) return std::nullopt;
    double widest = std::abs(of_model.ground.total() / energy_factor - whole.ground.total());
    std::map<int, double> of_level;
    for (std::size_t b = 0; b < p.size(); ++b) of_level[layer[b]] += m[b].total() / energy_factor - p[b].total();
    for (const auto& [level, difference] : of_level) widest = std::max(widest, std::abs(difference));
    return widest / all;
}

double ratio(double difference, double reference) {
    if (difference == 0.0) return 0.0;
    return reference > 0.0 ? difference / reference : std::numeric_limits<double>::infinity();
}

}  // namespace

int RunDifference::digits() const {
    if (bitwise_identical || rms_velocity == 0.0) return kDoubleDigits;
    if (!(rms_velocity < 1.0)) return 0;
    return std::min(kDoubleDigits, static_cast<int>(std::floor(-std::log10(rms_velocity))));
}

RunDifference compare_runs(const RunResult& prototype, const RunResult& model, const scaling::Similitude& similitude) {
    const std::size_t spine = prototype.spine.size(), line = prototype.spine.line();
    if (model.spine.size() != spine) throw std::invalid_argument("compare_runs: the runs have spines of different length");
    const std::size_t samples = std::min(prototype.history.samples(), model.history.samples());
    const double velocity_factor = similitude.velocity();

    std::vector<VelocityMeasure> reference(line);
    std::vector<VelocityMeasure> difference(line);
    VelocityMeasure liveliest;
    for (std::size_t s = 0; s < line; ++s) {
        for (std::size_t k = 0; k < samples; ++k) {
            const Vector3& of_prototype = prototype.history.spine_velocity[k * spine + s];
            reference[s].add(of_prototype);
            difference[s].add(model.history.spine_velocity[k * spine + s] / velocity_factor - of_prototype);
        }
        liveliest.cover(reference[s]);
    }

    RunDifference worst;
    for (std::size_t s = 0; s < line; ++s) {
        const VelocityMeasure& scale = reference[s].sum_of_squares > 0.0 ? reference[s] : liveliest;
        worst.rms_velocity = std::max(worst.rms_velocity, std::sqrt(ratio(difference[s].sum_of_squares, scale.sum_of_squares)));
        worst.max_velocity = std::max(worst.max_velocity, ratio(difference[s].peak, scale.peak));
    }
    worst.losses = compare_losses(prototype, model, similitude.energy());
    worst.bitwise_identical = are_bitwise_identical(prototype, model, similitude);
    return worst;
}

}  // namespace musim::lsdem
