#pragma once

#include <CLI/App.hpp>
#include <string>

#include "scaling/similitude.hpp"
#include "scaling/uncertain_similitude.hpp"

namespace musim::cli {

/// A number on the command line; a fraction such as 1/107 will do.
struct Number {
    double value = 0.0;

    operator double() const { return value; }  // NOLINT(google-explicit-constructor): it is a number
};

/// Reads a Number for CLI11, which finds it by argument-dependent lookup. Throws CLI::ConversionError.
bool lexical_cast(const std::string& text, Number& number);

/// The scale factors and the law of one similitude, as options --length, --friction, --gravity, --density, --law. Factors may carry
/// standard uncertainties.
struct SimilitudeOptions {
    scaling::UncertainRatio length, friction, gravity, density;
    std::string law = "mu";

    /// Adds the options to a command; --length is required.
    void add_to(CLI::App& command);

    /// The similitude of the factors' values. Throws scaling::SimilitudeError.
    scaling::Similitude similitude() const;

    /// The similitude of other factors by the same law. Throws scaling::SimilitudeError.
    scaling::Similitude similitude(const scaling::ScaleFactors& factors) const;

    /// The factors with their uncertainties.
    scaling::UncertainScales scales() const;

    /// A remark at the end when factors are uncertain: for commands that use their values alone.
    void note_values_used() const;
};

/// `text` with small letters for A to Z.
std::string to_lower_case(std::string text);

/// What a file is called behind its last dot, in lower case: "csv"; empty without one.
std::string find_extension(const std::string& file);

/// Adds --json.
void add_json_option(CLI::App& command, bool& json);

/// Adds --checkpoint-interval [s of wall time].
void add_checkpoint_interval_option(CLI::App& command, Number& seconds);

/// Adds --threads; 0 means all cores.
void add_threads_option(CLI::App& command, int& threads);

}  // namespace musim::cli
