#include "cli/options.hpp"

#include <algorithm>
#include <cctype>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <filesystem>

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
    command.add_option("--length", length, "Length factor, model/prototype, e.g. 1/107")->required()->type_name("NUMBER");
    command.add_option("--friction", friction, "Ratio of the friction coefficients, e.g. 0.63/0.59 (default 1)")->type_name("NUMBER");
    command.add_option("--gravity", gravity, "Ratio of gravity, above 1 in a centrifuge (default 1)")->type_name("NUMBER");
    command.add_option("--density", density, "Ratio of densities (default 1)")->type_name("NUMBER");
    command.add_option("--law", law, "Which force governs: mu, froude, exact or cauchy")->capture_default_str()->type_name("LAW");
}

scaling::Similitude SimilitudeOptions::similitude() const {
    const scaling::ScaleFactors chosen{.length = length, .friction = friction, .gravity = gravity, .density = density};
    return scaling::Similitude(chosen, scaling::parse_law(law));
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
