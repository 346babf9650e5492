#include "records/formats/detail/parsers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

/// Two time steps count as the same when they agree to this [relative]: files print at least three digits, 0.0049 against .005 is wrong.
constexpr double kSameTimeStep = 1e-3;

}  // namespace

SampleUnit requested_unit(const InputFile& file, const ReadOptions& options) {
    const SampleQuantity quantity = options.quantity.value_or(SampleQuantity::acceleration);
    if (!options.unit) return *find_sample_unit(si_unit_name(quantity));

    const std::optional<SampleUnit> unit = find_sample_unit(*options.unit);
    if (!unit) {
        file.fail(fmt::format("unit '{}' is unknown (known: {})", *options.unit, all_sample_unit_names()),
                  Remedy{"give one of these as ", Setting::unit});
    }
    if (options.quantity && unit->quantity != quantity) {
        file.fail(fmt::format("unit {} measures {} (asked for: {})", unit->name, to_string(unit->quantity), to_string(quantity)),
                  Remedy{"correct ", Setting::unit, " or ", Setting::quantity});
    }
    return *unit;
}

scaling::Time checked_dt(const TextFile& file, std::size_t index, double seconds) {
    if (!(seconds > 0.0) || !std::isfinite(seconds)) {
        file.fail(index, fmt::format("time step is {} s (must be positive)", seconds), "correct the time step in the file");
    }
    return seconds * scaling::si::seconds;
}

std::size_t checked_count(const TextFile& file, std::size_t index, std::string_view text, std::string_view what_to_do,
                          std::string_view noun) {
    const std::optional<std::size_t> count = parse_count(text);
    if (count && *count > 0) return *count;
    file.fail(index, fmt::format("number of {}s {} is unusable (must be a positive integer)", noun, quoted(text)), what_to_do);
}

double checked_sample(const TextFile& file, std::size_t index, std::string_view text, std::size_t ordinal, double si) {
    const std::optional<double> value = parse_real(text);
    if (!value || !std::isfinite(*value * si)) {
        file.fail(index, fmt::format("sample {} is {} (no finite number)", ordinal, quoted(text)),
                  "repair the value or fetch the file again");
    }
    return *value * si;
}

bool is_same_time_step(double a, double b) { return std::abs(a - b) <= kSameTimeStep * b; }

void refuse_contradictions(const InputFile& file, const ReadOptions& options, const SampleUnit& unit, scaling::Time dt) {
    if (options.quantity && *options.quantity != unit.quantity) {
        file.fail(fmt::format("file holds {} (asked for: {})", to_string(unit.quantity), to_string(*options.quantity)),
                  Remedy{"drop ", Setting::quantity});
    }
    if (options.unit) {
        const std::optional<SampleUnit> asked = find_sample_unit(*options.unit);
        if (!asked || asked->quantity != unit.quantity || asked->si != unit.si) {
            file.fail(fmt::format("file states its unit {} (asked for: {})", unit.name, *options.unit), Remedy{"drop ", Setting::unit});
        }
    }
    if (options.dt && !is_same_time_step(options.dt->value(), dt.value())) {
        file.fail(fmt::format("file states its time step {} s (asked for: {} s)", dt.value(), options.dt->value()),
                  Remedy{"drop ", Setting::time_step});
    }
}

bool is_miniseed_header(std::string_view bytes) {
    // six digits, a quality letter, a blank
    return bytes.size() >= kMiniseedHeaderBytes && std::all_of(bytes.begin(), bytes.begin() + 6, is_digit) &&
           std::string_view("DRQM").find(bytes[6]) != std::string_view::npos && bytes[7] == ' ';
}

}  // namespace musim::records::detail
