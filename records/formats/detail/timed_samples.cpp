#include "records/formats/detail/timed_samples.hpp"

#include <fmt/format.h>

#include <cmath>

namespace musim::records::detail {

TimedSamples read_timed_samples(const TextFile& file, const NumberBlock& block, double si) {
    if (block.count % 2 != 0) {
        file.fail(block.line, fmt::format("{} numbers announced (pairs of time and value need an even count)", block.count),
                  "correct the number of points");
    }
    const std::vector<double> numbers = read_block(file, block);
    const auto line_of_pair = [&](std::size_t pair) { return block.line + 2 * pair / block.columns.per_line; };

    TimedSamples timed{block.line, {}, {}};
    for (std::size_t pair = 0; 2 * pair < numbers.size(); ++pair) {
        const double sample = numbers[2 * pair + 1] * si;
        if (!std::isfinite(sample)) {
            file.fail(line_of_pair(pair), fmt::format("sample {} is {} (too large)", pair + 1, numbers[2 * pair + 1]), "repair the value");
        }
        timed.times.push_back(numbers[2 * pair]);
        timed.samples.push_back(sample);
    }
    if (const std::optional<std::size_t> found = find_time_out_of_order(timed.times)) {
        file.fail(line_of_pair(*found), fmt::format("time {} is {} s (not after the one before it)", *found + 1, timed.times[*found]),
                  "repair the time or fetch the file again");
    }
    return timed;
}

ResampledSeries resample(const TextFile& file, SampleQuantity quantity, const TimedSamples& timed) {
    try {
        return resample_uneven(quantity, timed.times, timed.samples);
    } catch (const ReadError& error) {
        const std::string_view message = error.what();
        const std::size_t advice = message.rfind("; ");
        file.fail(timed.line, message.substr(0, advice), message.substr(advice + 2));
    }
}

}  // namespace musim::records::detail
