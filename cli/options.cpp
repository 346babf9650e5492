#include "cli/options.hpp"

#include <algorithm>
#include <cctype>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <filesystem>

#include "cli/output.hpp"
#include "cli/uncertain_options.hpp"
#include "scaling/number.hpp"

namespace musim::cli {

bool lexical_cast(const std::string& text, Number& number) {
    try {
        number.value = scaling::parse_number(text);
    } catch (const scaling::ParseError& error) {
        throw CLI::ConversionError(error.what());
    }
    return true;
}

void SimilitudeOptions::add_to(CLI::App& command) {
    add_uncertain_option(command, "--length", length, "Length factor, model/prototype, e.g. 1/107 or 1/107+/-1%")->required();
    add_uncertain_option(command, "--friction", friction,
                         "Ratio of the friction coefficients, e.g. 0.63/0.59 or \"(0.63+/-5%)/(0.59+/-5%)\" (default 1)");
    add_uncertain_option(command, "--gravity", gravity, "Ratio of gravity, above 1 in a centrifuge (default 1)");
    add_uncertain_option(command, "--density", density, "Ratio of densities (default 1)");
    command.add_option("--law", law, "Which force governs: mu, froude, exact or cauchy")->capture_default_str()->type_name("LAW");
}

scaling::Similitude SimilitudeOptions::similitude() const { return similitude(scales().factors()); }

scaling::Similitude SimilitudeOptions::similitude(const scaling::ScaleFactors& factors) const {
    return scaling::Similitude(factors, scaling::parse_law(law));
}

scaling::UncertainScales SimilitudeOptions::scales() const {
    scaling::UncertainScales scales;
    scales.length = length;
    scales.friction = friction;
    scales.gravity = gravity;
    scales.density = density;
    return scales;
}

void SimilitudeOptions::note_values_used() const {
    if (!scales().is_uncertain()) return;
    note_at_end(
        "musim: note: only the values of uncertain factors are used here; musim scale and musim rescale tell what the uncertainty does");
}

std::string to_lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string find_extension(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    return to_lower_case(extension.substr(extension.empty() ? 0 : 1));
}

void add_json_option(CLI::App& command, bool& json) {
    command.add_flag("--json", json, "Print one JSON object on stdout and nothing else there");
}

void add_checkpoint_interval_option(CLI::App& command, Number& seconds) {
    command
        .add_option("--checkpoint-interval", seconds,
                    "Seconds of wall time between two checkpoints in DIR, 0 for one per sample (default 60)")
        ->type_name("SECONDS")
        ->check([](const std::string& text) {
            Number number;
            return lexical_cast(text, number) && number >= 0.0 ? std::string() : text + " is negative";
        });
}

void add_threads_option(CLI::App& command, int& threads) {
    command.add_option("--threads", threads, "Threads; results are the same for any number (default: all cores)")
        ->check(CLI::NonNegativeNumber);
}

}  // namespace musim::cli
