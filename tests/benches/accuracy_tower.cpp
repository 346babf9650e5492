#include "tests/benches/accuracy_tower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lsdem/run/equilibrium.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/time_step.hpp"
#include "records/synthesis/synthetic.hpp"
#include "scaling/interruption.hpp"
#include "scaling/laws/law_similitude.hpp"

namespace musim::lsdem {
namespace {

/// Parts of the earthquake that are used: a part alone may by chance agree well or badly.
constexpr std::size_t kParts = 3;
/// Length of a part, and how much of it comes before its peak acceleration [s of the prototype].
constexpr double kWindow = 0.4, kBeforePeak = 0.15;
/// Samples of the top's velocity over the window.
constexpr std::uint64_t kTopSamples = 300;
/// Samples that are compared one by one: 0.24 s, about as long as a run moved by one unit in the last place agrees with its twin.
constexpr std::size_t kCompared = 180;

const scaling::Similitude& mini_scale() {
    static const scaling::Similitude kScale = scaling::make_similitude("mu", {.length = 1.0 / 107.0});
    return kScale;
}

Scene make_wall(int courses) {
    Scene wall;
    wall.name = "mini-tower";
    wall.material = find_material_preset("wood").material;
    const auto mm = [](double length) { return 1e-3 * length * scaling::si::meters; };
    Wall made;
    made.layers = courses;
    made.blocks_per_layer = 3;
    made.block = {mm(12.710), mm(26.355), mm(39.780)};
    wall.structure = made;
    wall.time.duration = 1.0 * scaling::si::seconds;
    return wall;
}

/// The earthquake along x at the wall's scale; whole.
BaseComponent make_earthquake(const std::filesystem::path& record, const AxisComponents& components, std::string& description) {
    Scene scene;
    if (record.empty()) {
        const records::SyntheticSettings synthetic;
        scene.base_motion.source =
            SignalMotion{.signal = SyntheticSignal{synthetic.pga, synthetic.pgv, synthetic.duration, synthetic.dt, synthetic.seed},
                         .axis = 0,
                         .start = {},
                         .dt = {}};
        description = "synthetic record";
    } else {
        const std::vector<std::string> steps = use_record(scene, record, components);
        description = fmt::format("{}, {}", record.filename().string(), steps.front());
    }
    scene.base_motion.factors = {mini_scale().time(), mini_scale().velocity()};
    return make_base_components(scene.base_motion).shift[0];
}

/// The part of a motion from `start` to `start + duration` [s], from rest.
BaseComponent cut(const BaseComponent& whole, double start, double duration) {
    const auto last = whole.velocity.size() - 1;
    const auto first = std::min(static_cast<std::size_t>(std::max(0.0, std::floor(start / whole.dt))), last);
    const auto end = std::min(first + static_cast<std::size_t>(std::ceil(duration / whole.dt)) + 1, last);
    BaseComponent part{0.0, whole.dt, {}};
    for (std::size_t k = first; k <= end; ++k) part.velocity.push_back(whole.velocity[k] - whole.velocity[first]);
    return part;
}

/// Times of the highest peaks of acceleration, at least `apart` from each other [s].
std::vector<double> find_peak_times(const BaseComponent& motion, double apart) {
    std::vector<double> times;
    while (times.size() < kParts) {
        double largest = 0.0, at = 0.0;
        for (std::size_t k = 0; k + 1 < motion.velocity.size(); ++k) {
            const double time = static_cast<double>(k) * motion.dt, change = std::abs(motion.velocity[k + 1] - motion.velocity[k]);
            const bool near = std::any_of(times.begin(), times.end(), [&](double t) { return std::abs(t - time) < apart; });
            if (change > largest && !near) largest = change, at = time;
        }
        times.push_back(at);
    }
    return times;
}

Specimen build_specimen(const Scene& wall) {
    BuiltModel built = build_model(wall);
    return {std::move(built.model), {}, std::move(built.structure.layer), {}};
}

/// The wall at rest under its weight: in equilibrium by overlaps. By nodes it stands in the same places, where its faces are parallel and
/// bear as much; what friction holds in joints that do not slip is then left out.
Specimen make_specimen(int courses, const AccuracySetting& setting) {
    Scene wall = make_wall(courses);
    Specimen at_rest = build_specimen(wall);
    put_in_equilibrium(at_rest, compute_critical_time_step(at_rest.model));
    wall.shape = BoxShape{setting.nodes_per_face};
    if (setting.voxel > 0.0) {
        const auto thin = std::get<Wall>(wall.structure).block[0];
        wall.shape = GridShape{setting.nodes_per_face, setting.voxel * thin};
    }
    wall.face_contact = setting.faces;
    wall.contact_nodes = setting.sides;
    Specimen specimen = build_specimen(wall);
    apply(setting, specimen.model);
    for (std::size_t b = 0; b < specimen.model.blocks.size(); ++b) {
        specimen.model.blocks[b].position = at_rest.model.blocks[b].position;
        specimen.model.blocks[b].orientation = at_rest.model.blocks[b].orientation;
    }
    if (setting.faces == FaceContact::overlap) specimen.model.preload = at_rest.model.preload;
    return specimen;
}

/// Largest magnitude [m/s]; not a number when the run diverged.
double find_peak(const TopVelocity& velocity) {
    if (velocity.size() != kTopSamples) return std::numeric_limits<double>::quiet_NaN();
    double peak = 0.0;
    for (const double v : velocity) peak = std::max(peak, std::abs(v));
    return peak;
}

/// Mean velocity of the top course along x, relative to the base [m/s].
double find_top_velocity(const Simulation& s, const std::vector<int>& layer, int top) {
    double sum = 0.0, count = 0.0;
    for (std::size_t b = 0; b < layer.size(); ++b) {
        if (layer[b] != top) continue;
        sum += s.velocity(b).x();
        count += 1.0;
    }
    return sum / count - s.base().velocity.x();
}

}  // namespace

double compare_tops(const TopMotion& motion, const TopMotion& reference) {
    if (motion.parts.size() != reference.parts.size()) return std::numeric_limits<double>::infinity();
    double difference = 0.0, size = 0.0;
    for (std::size_t p = 0; p < reference.parts.size(); ++p) {
        if (std::min(motion.parts[p].size(), reference.parts[p].size()) < kCompared) return std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < kCompared; ++k) {
            const double d = motion.parts[p][k] - reference.parts[p][k];
            difference += d * d;
            size += reference.parts[p][k] * reference.parts[p][k];
        }
    }
    const double ratio = std::sqrt(difference / size);
    return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

double compare_peaks(const TopMotion& motion, const TopMotion& reference) {
    if (motion.parts.size() != reference.parts.size()) return std::numeric_limits<double>::infinity();
    double squares = 0.0;
    for (std::size_t p = 0; p < reference.parts.size(); ++p) {
        const double difference = find_peak(motion.parts[p]) / find_peak(reference.parts[p]) - 1.0;
        squares += difference * difference / static_cast<double>(reference.parts.size());
    }
    return std::isfinite(squares) ? std::sqrt(squares) : std::numeric_limits<double>::infinity();
}

MiniTower::MiniTower(const std::filesystem::path& record, const AxisComponents& components, int courses)
    : courses_(courses), duration_(kWindow * mini_scale().time()) {
    const BaseComponent whole = make_earthquake(record, components, description_);
    for (const double peak : find_peak_times(whole, duration_))
        motions_.push_back(cut(whole, peak - kBeforePeak * mini_scale().time(), duration_));
}

TopMotion MiniTower::run(const AccuracySetting& setting, bool copy) const {
    Specimen specimen = make_specimen(courses_, setting);
    if (copy) specimen = make_moved_copy(std::move(specimen));
    // the sampling interval is a whole number of steps
    const double interval = duration_ / static_cast<double>(kTopSamples);
    const auto per_sample = static_cast<std::uint64_t>(std::ceil(interval / (setting.safety * compute_critical_time_step(specimen.model))));

    TopMotion motion;
    for (const BaseComponent& part : motions_) {
        specimen.model.ground.motion.shift[0] = part;
        MeteredSimulation run(specimen.model, interval / static_cast<double>(per_sample));
        TopVelocity velocity;
        for (std::uint64_t k = 0; k < kTopSamples && !run.simulation().divergence(); ++k) {
            scaling::stop_if_interrupted();
            run.simulation().advance(per_sample);
            velocity.push_back(find_top_velocity(run.simulation(), specimen.layer, courses_));
        }
        if (run.simulation().divergence()) velocity.clear();
        run.add_to(motion.cost);
        motion.parts.push_back(std::move(velocity));
    }
    return motion;
}

}  // namespace musim::lsdem
