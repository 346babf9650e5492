#pragma once

#include <cstdint>
#include <vector>

namespace musim::lsdem {

/// When a sensor is read, in steps, so that similar runs read at the same.
struct ReadingPlan {
    double steps = 1.0;         ///< between readings, one at least; in between two steps readings are linear
    std::uint64_t count = 0;    ///< readings after the one at t = 0
    double corner_steps = 0.0;  ///< corner of its low-pass times the time step [-]; 0: none
    int order = 0;              ///< of the low-pass

    bool operator==(const ReadingPlan&) const = default;
};

/// When a run steps, samples and ends. Counts, so that similar runs do exactly the same steps.
struct TimePlan {
    double time_step = 0.0;  ///< [s]
    std::uint64_t steps_per_sample = 1;
    std::uint64_t samples = 0;               ///< after the one at t = 0
    std::uint64_t samples_per_frame = 0;     ///< 0: no frames
    std::vector<ReadingPlan> readings = {};  ///< of each sensor

    bool operator==(const TimePlan&) const = default;

    std::uint64_t steps() const { return steps_per_sample * samples; }
    double duration() const { return static_cast<double>(steps()) * time_step; }  ///< [s]

    /// The plan of a similar run: the same counts, the time step multiplied by λ_t.
    TimePlan scaled(double time_factor) const {
        TimePlan plan = *this;
        plan.time_step = time_step * time_factor;
        return plan;
    }

    /// The same samples and readings, with so many times the steps.
    TimePlan with_finer_step(std::uint64_t times) const {
        TimePlan plan = *this;
        plan.time_step = time_step / static_cast<double>(times);
        plan.steps_per_sample *= times;
        for (ReadingPlan& reading : plan.readings) {
            reading.steps *= static_cast<double>(times);
            reading.corner_steps /= static_cast<double>(times);
        }
        return plan;
    }
};

}  // namespace musim::lsdem
