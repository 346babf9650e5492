#include "cli/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>

#include "cli/output.hpp"
#include "cli/uncertain_options.hpp"
#include "cli/whole_option.hpp"
#include "records/error.hpp"
#include "records/measures/response_spectrum.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/number.hpp"
#include "scaling/shorten.hpp"
#include "scaling/side_by_side.hpp"
#include "scaling/unlikely.hpp"

namespace musim::cli {
namespace {

/// Ratios that the options of scaling::kChosenScales give, in their order.
constexpr scaling::UncertainRatio scaling::UncertainScales::*kRatios[] = {
    &scaling::UncertainScales::length, &scaling::UncertainScales::friction, &scaling::UncertainScales::gravity,
    &scaling::UncertainScales::density};

/// One of them that is given, with the quantity of the law at hand.
struct GivenOption {
    scaling::UncertainRatio scaling::UncertainScales::*ratio;
    double scaling::ScaleFactors::*value;
    std::string quantity;
};

/// Those of a command line with the factors of --set.
std::vector<GivenOption> find_given(const SimilitudeOptions& options, const std::vector<scaling::UncertainFactor>& set) {
    std::vector<GivenOption> list;
    for (std::size_t i = 0; i < std::size(kRatios); ++i) {
        const scaling::ChosenScale& scale = scaling::kChosenScales[i];
        if (options.command->count(fmt::format("--{}", scale.name)) > 0) list.push_back({kRatios[i], scale.factor, scale.quantity});
    }
    if (options.command->count("--length") > 0) {
        list.front().quantity = find_length_name(scaling::load_scale_law(options.law), scaling::values_of(set));
    }
    return list;
}

/// A law with the given factors; a default of it that these overrule is a warning at the end.
scaling::SolvedLaw solve_noting(const std::string& law, const std::vector<scaling::GivenFactor>& given) {
    scaling::SolvedLaw solved = scaling::solve_law(scaling::load_scale_law(law), given);
    note_overruled(solved);
    return solved;
}

/// The library takes any; a spectrum of more than twice the critical damping is a slip.
constexpr double kMostDamping = 2.0;

/// More threads are a slip of the keyboard.
constexpr std::uint64_t kMostThreads = 100'000;

}  // namespace

bool lexical_cast(const std::string& text, Number& number) {
    try {
        number.value = scaling::parse_number(text);
    } catch (const scaling::ParseError& error) {
        throw CLI::ConversionError(error.what());
    }
    return true;
}

bool lexical_cast(const std::string& text, Share& share) {
    const bool percent = text.ends_with('%');
    Number number;
    lexical_cast(percent ? text.substr(0, text.size() - 1) : text, number);
    share.value = percent ? number.value / 100.0 : number.value;
    return true;
}

void SimilitudeOptions::add_to(CLI::App& app, LengthOption length_option) {
    command = &app;
    add_uncertain_option(app, "--length", chosen.length,
                         "Length factor, model/prototype, e.g. 1/107 or 1/107+/-1%; by mu_vertical_distortion that of heights")
        ->required(length_option == LengthOption::required);
    add_uncertain_option(app, "--friction", chosen.friction,
                         "Ratio of the friction coefficients, e.g. 0.63/0.59 or \"(0.63+/-5%)/(0.59+/-5%)\" (default 1)");
    add_uncertain_option(app, "--gravity", chosen.gravity, "Ratio of gravity, above 1 in a centrifuge (default 1)");
    add_uncertain_option(app, "--density", chosen.density, "Ratio of densities (default 1)");
    app.add_option(
           "--law", law,
           "Which force governs: mu, froude, exact, cauchy, another of `musim scale --laws` with one length to be chosen, or a law file")
        ->capture_default_str()
        ->type_name("LAW");
    app.add_option("--set", factors, "Factor of another quantity of the law, e.g. F_R=1/500; repeat for several")
        ->type_name("NAME=NUMBER")
        ->expected(1)
        ->take_all();
}

std::vector<scaling::UncertainFactor> SimilitudeOptions::given() const {
    const std::vector<scaling::UncertainFactor> set = parse_factors(factors);
    std::vector<scaling::UncertainFactor> list;
    for (const GivenOption& option : find_given(*this, set)) list.push_back({option.quantity, chosen.*option.ratio});
    list.insert(list.end(), set.begin(), set.end());
    return list;
}

scaling::Similitude SimilitudeOptions::similitude() const {
    return scaling::make_similitude(solve_noting(law, scaling::values_of(given())));
}

scaling::ModelScales SimilitudeOptions::model_scales() const {
    const scaling::LawFormulas formulas(solve_noting(law, scaling::values_of(given())));
    return scaling::make_model_scales(formulas, formulas.solved().problem.chosen);
}

scaling::MakeModelScales SimilitudeOptions::make_scales() const {
    const std::vector<GivenOption> named = find_given(*this, parse_factors(factors));
    const scaling::LawFormulas formulas(scaling::solve_law(scaling::load_scale_law(law), scaling::values_of(given())));
    return [named, formulas](const scaling::ScaleFactors& values, std::vector<scaling::GivenFactor> others) {
        for (const GivenOption& option : named) others.push_back({option.quantity, values.*option.value});
        return scaling::make_model_scales(formulas, formulas.choose(others));
    };
}

scaling::UncertainScales SimilitudeOptions::scales() const {
    scaling::UncertainScales scales = chosen;
    scales.others = parse_factors(factors);
    return scales;
}

void note_larger_model(double length) {
    if (const auto words = scaling::describe_unlikely_length_factor(length, "--length ")) note_at_end("musim: note: " + *words);
}

void note_unlikely(const std::string& option, const std::optional<std::string>& words) {
    if (words) note_at_end(fmt::format("musim: note: {}: {}", option, *words));
}

void SimilitudeOptions::note_doubtful_factors() const {
    note_larger_model(chosen.length.value());
    if (chosen.friction_prototype || command->count("--friction") == 0 || chosen.friction.value() >= 1.0) return;
    std::string text = command->get_option("--friction")->results().back();
    if (const std::size_t mark = text.find("+/-"); mark != std::string::npos) text.erase(mark, 3);
    if (text.find('/') != std::string::npos) return;
    note_at_end(
        fmt::format("musim: note: --friction {0:.7g} is taken as the ratio model/prototype; of two coefficients write {0:.7g}/PROTOTYPE",
                    chosen.friction.value()));
}

void SimilitudeOptions::note_values_used() const { cli::note_values_used(given()); }

void note_values_used(const std::vector<scaling::UncertainFactor>& factors) {
    if (std::none_of(factors.begin(), factors.end(), [](const auto& each) { return each.factor.is_uncertain(); })) return;
    note_at_end(
        "musim: note: only the values of uncertain factors are used here; musim scale and musim rescale say what the uncertainty does");
}

void note_overruled(const scaling::SolvedLaw& solved) {
    for (const std::size_t j : solved.overruled) {
        note_at_end(fmt::format("musim: warning: law {}: {} is {:.7g} by the factors given, not its default", solved.law.name,
                                solved.problem.quantities[j].name, *solved.solution.quantities[j].factor.value));
    }
}

std::vector<scaling::UncertainFactor> parse_factors(const std::vector<std::string>& texts) {
    std::vector<scaling::UncertainFactor> list;
    for (const std::string& text : texts) {
        const auto [name, number] = split_option("--set", text, '=', "NAME=NUMBER, e.g. l=1/25");
        list.push_back({name, read_option("--set " + name, [&text = number] { return parse_factor(text); })});
    }
    return list;
}

std::pair<std::string, std::string> split_option(const std::string& option, const std::string& text, char mark, const std::string& wanted) {
    const std::size_t position = text.find(mark);
    if (position == 0 || position == std::string::npos || position + 1 == text.size()) {
        throw CLI::ValidationError(option, "'" + text + "' is not " + wanted);
    }
    return {text.substr(0, position), text.substr(position + 1)};
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

CLI::Option* add_format_option(CLI::App& command, scaling::ReportStyle& style, const std::string& help) {
    static const std::map<std::string, scaling::ReportStyle> kStyles{
        {"text", scaling::ReportStyle::plain}, {"markdown", scaling::ReportStyle::markdown}, {"latex", scaling::ReportStyle::latex}};
    const auto take = [&style](const CLI::results_t& texts) {
        style = kStyles.at(texts.front());
        return true;
    };
    return command.add_option("--format", CLI::callback_t(take), help)
        ->type_name("FORMAT")
        ->check(one_of({"text", "markdown", "latex"}))
        ->default_str("text");
}

CLI::Validator check_number(const std::function<bool(double)>& accepts, const std::string& what) {
    return {[accepts, what](const std::string& text) -> std::string {
                try {
                    return accepts(scaling::parse_number(text)) ? "" : text + what;
                } catch (const scaling::ParseError& error) {
                    return error.what();
                }
            },
            ""};
}

CLI::Validator above_zero() {
    return check_number([](double number) { return number > 0.0; }, " is not above zero");
}

CLI::Validator not_negative() {
    return check_number([](double number) { return number >= 0.0; }, " is negative");
}

CLI::Validator between(double low, double high) {
    return check_number([low, high](double number) { return number >= low && number <= high; },
                        fmt::format(" is not from {:g} to {:g}", low, high));
}

CLI::Validator damping_ratio() {
    return {[](const std::string& text) -> std::string {
                double damping = 0.0;
                try {
                    damping = scaling::parse_number(text);
                    records::require_damping(damping);
                } catch (const std::runtime_error& error) {
                    return error.what();
                }
                if (damping <= kMostDamping) return "";
                return fmt::format("{} is {:g} % of critical (at most {:g} %); write 0.05 for 5 %", text, 100.0 * damping,
                                   100.0 * kMostDamping);
            },
            ""};
}

CLI::Validator one_of(const std::vector<std::string>& names) {
    return {[names](const std::string& text) {
                if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
                return fmt::format("\"{}\" is not known{}; give one of {}", scaling::shorten(text), scaling::hint_at_name(text, names),
                                   fmt::join(names, ", "));
            },
            fmt::format("{{{}}}", fmt::join(names, ","))};
}

void add_checkpoint_interval_option(CLI::App& command, Number& seconds) {
    command
        .add_option("--checkpoint-interval", seconds,
                    "Seconds of wall time between two checkpoints in DIR, the first after 5 at most; 0 for one per sample (default 60)")
        ->type_name("SECONDS")
        ->check(not_negative());
}

void require_ascending(const std::string& option, const std::vector<Number>& ends) {
    if (ends.size() != 2 || ends[0].value < ends[1].value) return;
    throw CLI::ValidationError(option, fmt::format("{:g} is not below {:g}; give the lower end first", ends[0].value, ends[1].value));
}

void add_threads_option(CLI::App& command, int& threads) {
    threads = scaling::count_usable_cores();
    const auto take = [&threads, all = threads](std::uint64_t number) { threads = number == 0 ? all : static_cast<int>(number); };
    add_whole_option(command, "--threads", take, "Threads; results are the same for any number (default: all cores)", {0, kMostThreads});
}

}  // namespace musim::cli
