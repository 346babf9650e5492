#pragma once

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/option_name.hpp"
#include "scaling/error.hpp"
#include "scaling/laws/scale_law.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_similitude.hpp"

namespace musim::cli {

/// A number on the command line; a fraction such as 1/107 will do.
struct Number {
    double value = 0.0;

    operator double() const { return value; }  // NOLINT(google-explicit-constructor): it is a number
};

/// Reads a Number for CLI11, which finds it by argument-dependent lookup. Throws CLI::ConversionError.
bool lexical_cast(const std::string& text, Number& number);

/// A part of one on the command line: a Number, or that many percent, such as 5%.
struct Share {
    double value = 0.0;
};
bool lexical_cast(const std::string& text, Share& share);

/// Whether a command can do without --length.
enum class LengthOption { required, optional };

/// The scale factors and the law of one similitude, as options --length, --friction, --gravity, --density, --law, --set. All factors may
/// carry standard uncertainties.
struct SimilitudeOptions {
    /// Without `others`; with structure and motion where the command has add_structure_options() and add_motion_options().
    scaling::UncertainScales chosen;
    std::string law = "mu";
    std::vector<std::string> factors;   ///< of other quantities of the law, "NAME=NUMBER", perhaps with an uncertainty
    const CLI::App* command = nullptr;  ///< that has the options

    /// Adds the options to a command.
    void add_to(CLI::App& app, LengthOption length_option = LengthOption::required);

    /// Factors of the law that the options give: --length is what scaling::find_length_name() says, --friction mu, --gravity g, --density
    /// rho. Throws CLI::ValidationError for a --set that is not NAME=NUMBER, scaling::ParseError, scaling::SimilitudeError.
    std::vector<scaling::UncertainFactor> given() const;

    /// The similitude of the factors' values by a law that settles length, time and mass. Throws
    /// scaling::SimilitudeError, as given() does.
    scaling::Similitude similitude() const;

    /// The model scales of the factors' values by the law; heights and widths may scale apart. Throws as
    /// similitude().
    scaling::ModelScales model_scales() const;

    /// Makes model scales of other factors by the same law, as long as these options live; the law is read once. Throws
    /// scaling::SimilitudeError, now and when called.
    scaling::MakeModelScales make_scales() const;

    /// All that is chosen with its uncertainties.
    scaling::UncertainScales scales() const;

    /// Remarks at the end about factors that may have been meant otherwise: a model larger than its prototype, and one number below 1 for
    /// the ratio of friction coefficients where the prototype's is not known.
    void note_doubtful_factors() const;

    /// A remark at the end when factors are uncertain: for commands that use their values alone.
    void note_values_used() const;
};

/// Warnings at the end for defaults of a law that given factors overrule.
void note_overruled(const scaling::SolvedLaw& solved);

/// Texts of --set, "NAME=NUMBER", with or without uncertainties. Throws CLI::ValidationError for another form.
std::vector<scaling::UncertainFactor> parse_factors(const std::vector<std::string>& texts);

/// A remark at the end on a length above one: 107 typed for 1/107 would be a scale, too.
void note_larger_model(double length);

/// A remark at the end on an option whose value is hardly meant, `words` being those of scaling/unlikely.hpp, if there are any.
void note_unlikely(const std::string& option, const std::optional<std::string>& words);

/// A remark at the end when one of the factors is uncertain: for commands that use their values alone.
void note_values_used(const std::vector<scaling::UncertainFactor>& factors);

/// The two sides of "NAME=REST", the mark being `=`. Throws CLI::ValidationError `option: 'text' is not WANTED`.
std::pair<std::string, std::string> split_option(const std::string& option, const std::string& text, char mark, const std::string& wanted);

/// Value that `read` makes of an option's text; what it refuses is a wrong use of the command line. Throws CLI::ValidationError that begins
/// with the place, such as "--set l: ".
template <class Read>
auto read_option(const std::string& place, const Read& read) {
    try {
        return read();
    } catch (const std::runtime_error& error) {
        throw CLI::ValidationError(place, word(error));
    }
}

/// `text` with small letters for A to Z.
std::string to_lower_case(std::string text);

/// Part of a file's name behind its last dot, in lower case: "csv"; empty without one.
std::string find_extension(const std::string& file);

/// Adds --json.
void add_json_option(CLI::App& command, bool& json);

/// Adds --format text, markdown or latex.
CLI::Option* add_format_option(CLI::App& command, scaling::ReportStyle& style, const std::string& help);

/// Adds --checkpoint-interval [s of wall time].
void add_checkpoint_interval_option(CLI::App& command, Number& seconds);

/// A check of a number on the command line: refused, with a line that ends with `what`, unless `accepts(number)`; likewise what is none.
CLI::Validator check_number(const std::function<bool(double)>& accepts, const std::string& what);

/// Such checks: above zero, not below it, from `low` to `high`.
CLI::Validator above_zero();
CLI::Validator not_negative();
CLI::Validator between(double low, double high);

/// A check of a --damping: one of an oscillator, and not above 2, where percent were meant.
CLI::Validator damping_ratio();

/// A check of a word that is one of `names`; another gets the nearest.
CLI::Validator one_of(const std::vector<std::string>& names);

/// Refuses the two numbers of an option, if there are, unless the first is below the second. Throws CLI::ValidationError.
void require_ascending(const std::string& option, const std::vector<Number>& ends);

/// Adds an option that takes a number, or several.
template <class Numbers>
CLI::Option* add_number_option(CLI::App& command, const std::string& name, Numbers& value, const std::string& help) {
    return command.add_option(name, value, help)->type_name("NUMBER");
}
/// Likewise; the numbers must be above zero.
template <class Numbers>
CLI::Option* add_positive_option(CLI::App& command, const std::string& name, Numbers& value, const std::string& help) {
    return add_number_option(command, name, value, help)->check(above_zero());
}

/// Adds --threads; 0 means all cores that the process may use, and is replaced by their number.
void add_threads_option(CLI::App& command, int& threads);

}  // namespace musim::cli
