#include "lsdem/study/base_shaking.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lsdem/base_motion.hpp"

namespace musim::lsdem {
namespace {

/// A step is given at a time that rounding may move by this part of it [-].
constexpr double kAtStart = 1e-9;

bool is_step(const BaseComponent& component) { return component.velocity.size() == 1; }

/// √(∫t² v² dt/∫v² dt) over the samples of all components; 0 where nothing has a time.
double find_mean_time(const BaseComponents& motion) {
    double weighted = 0.0, sum = 0.0;
    for (const BaseComponent& component : motion.shift) {
        for (std::size_t k = 0; k < component.velocity.size() && !is_step(component); ++k) {
            const double t = component.start + static_cast<double>(k) * component.dt;
            const double square = component.velocity[k] * component.velocity[k] * component.dt;
            weighted += t * t * square;
            sum += square;
        }
    }
    return sum > 0.0 ? std::sqrt(weighted / sum) : 0.0;
}

/// Least squares of v_M = ν v_P.
struct Fit {
    double pp = 0.0, pm = 0.0, mm = 0.0;

    void add(const BaseComponent& prototype, const BaseMotion& model, int axis, double duration, double time) {
        const double scale = is_step(prototype) ? time * (1.0 + kAtStart) : time;
        for (std::size_t k = 0; k < prototype.velocity.size(); ++k) {
            const double t = prototype.start + static_cast<double>(k) * prototype.dt;
            if (t > duration) break;
            const double of_prototype = prototype.velocity[k], of_model = model.velocity(scale * t)[axis];
            pp += of_prototype * of_prototype, pm += of_prototype * of_model, mm += of_model * of_model;
        }
    }
    bool moves() const { return pp > 0.0; }
    double velocity() const { return pm / pp; }
    /// √(Σ|v_M/ν − v_P|²/Σ|v_P|²)
    double misfit() const {
        if (!moves()) return mm > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
        if (!(pm > 0.0)) return std::numeric_limits<double>::infinity();
        return std::sqrt(std::max(pp * mm / (pm * pm) - 1.0, 0.0));
    }
};

struct Fits {
    Fit horizontal, vertical;

    Fits(const BaseComponents& prototype, const BaseMotion& model, double duration, double time) {
        for (int axis = 0; axis < 3; ++axis) {
            (axis == 2 ? vertical : horizontal).add(prototype.shift[static_cast<std::size_t>(axis)], model, axis, duration, time);
        }
    }
    double misfit() const { return std::max(horizontal.misfit(), vertical.misfit()); }
};

std::vector<double> find_candidates(const BaseComponents& prototype, const BaseComponents& model, const std::vector<double>& expected) {
    std::vector<double> times;
    for (std::size_t axis = 0; axis < prototype.shift.size(); ++axis) {
        const BaseComponent &p = prototype.shift[axis], &m = model.shift[axis];
        if (p.velocity.size() > 1 && m.velocity.size() == p.velocity.size()) times.push_back(m.dt / p.dt);
    }
    times.insert(times.end(), expected.begin(), expected.end());
    const double of_prototype = find_mean_time(prototype), of_model = find_mean_time(model);
    if (of_prototype > 0.0 && of_model > 0.0) times.push_back(of_model / of_prototype);
    return times;
}

}  // namespace

std::optional<BaseShaking> measure_base_shaking(const BaseComponents& prototype, const BaseComponents& model, double duration,
                                                const std::vector<double>& expected) {
    bool has_time = false;
    for (std::size_t axis = 0; axis < prototype.shift.size(); ++axis) {
        const BaseComponent &p = prototype.shift[axis], &m = model.shift[axis];
        if (p.velocity.empty() != m.velocity.empty() || is_step(p) != is_step(m)) return std::nullopt;
        has_time = has_time || prototype.shift[axis].velocity.size() > 1;
    }
    const BaseMotion moves(model);
    std::optional<double> best;
    double least = kSameShaking;
    for (const double time : find_candidates(prototype, model, expected)) {
        // half as far off: of candidates that differ by rounding alone the first is taken
        const double misfit = Fits(prototype, moves, duration, time).misfit();
        if (misfit < (best ? 0.5 * least : least)) best = time, least = misfit;
    }
    if (!best) return std::nullopt;
    const Fits fits(prototype, moves, duration, *best);
    BaseShaking shaking;
    if (has_time) shaking.time = best;
    if (fits.horizontal.moves()) shaking.velocity = fits.horizontal.velocity();
    if (fits.vertical.moves()) shaking.velocity_vertical = fits.vertical.velocity();
    if (!shaking.velocity && !shaking.velocity_vertical) return std::nullopt;
    return shaking;
}

}  // namespace musim::lsdem
