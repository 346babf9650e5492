#include "cli/usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <string_view>
#include <vector>

#include "scaling/nearest_name.hpp"

namespace musim::cli {
namespace {

/// Words on an empty value.
constexpr const char* kEmpty = "is empty; give a value, or leave it out";

/// A command as it was typed, down to the last subcommand.
struct TypedCommand {
    const CLI::App* app;
    std::string name;  ///< "musim record info"
};

TypedCommand find_command(const CLI::App& app) {
    TypedCommand typed{&app, app.get_name()};
    for (auto given = app.get_subcommands(); !given.empty(); given = typed.app->get_subcommands()) {
        typed.app = given.front();
        typed.name += " " + typed.app->get_name();
    }
    return typed;
}

std::vector<std::string> list_subcommands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(each->get_name());
    return names;
}

/// The option that an unknown one was meant to be, as ` (did you mean "--length"?)`; or nothing.
std::string hint_at_option(const std::string& name, const CLI::App& app) {
    if (!name.starts_with("--")) return "";
    std::vector<std::string> known;
    for (const CLI::Option* option : app.get_options()) known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
    const std::string nearest = scaling::find_nearest_name(std::string_view(name).substr(2), known);
    return nearest.empty() ? "" : fmt::format(" (did you mean \"--{}\"?)", nearest);
}

/// About the first word that nothing takes: a subcommand that is not known, else an option before others, as these may be its values.
std::string describe_extra_word(const TypedCommand& typed, const std::vector<std::string>& words) {
    const std::vector<std::string> subcommands = list_subcommands(*typed.app);
    if (!subcommands.empty() && !words.front().starts_with('-')) {
        return fmt::format("\"{}\": {} has no such command; {}", words.front(), typed.name,
                           scaling::suggest_name(words.front(), subcommands));
    }
    const auto option = std::find_if(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
    if (option == words.end()) {
        const CLI::Option* const record = typed.app->get_option_no_throw("--record");
        const char* const merging =
            record != nullptr && record->count() > 0
                ? " (--record takes one file); merge the files of one station with `musim record process A B --step "
                  "'{\"step\": \"align\"}' -o both.csv`"
                : "";
        return fmt::format("\"{}\": {} takes no further argument{}", words.front(), typed.name, merging);
    }
    const std::string name = option->substr(0, option->find('='));
    return fmt::format("{}: {} has no such option{}", name, typed.name, hint_at_option(name, *typed.app));
}

/// The option whose value could not be read: options are read in order, and the reading ended there.
const CLI::Option* find_unread_option(const CLI::App& app) {
    const CLI::Option* last = nullptr;
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() > 0 && option->get_callback_run()) last = option;
    }
    return last;
}

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t") == std::string_view::npos; }

}  // namespace

void refuse_empty_values(CLI::App& app) {
    const CLI::Validator not_empty{[](std::string& text) { return is_blank(text) ? std::string(kEmpty) : ""; }, ""};
    for (CLI::Option* option : app.get_options()) {
        if (option->get_expected_min() > 0) option->transform(not_empty);  // before all other checks
    }
    for (CLI::App* each : app.get_subcommands([](CLI::App*) { return true; })) refuse_empty_values(*each);
}

void refuse_empty_values(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word.starts_with("--") && word.find('=') == word.size() - 1) {
            throw CLI::ValidationError(std::string(word.substr(0, word.size() - 1)), kEmpty);
        }
    }
}

void group_commands(CLI::App& app, const std::string& title, const std::vector<std::string>& names) {
    for (const std::string& name : names) app.get_subcommand(name)->group(title);
}

std::string describe_usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const TypedCommand typed = find_command(app);
    const std::vector<std::string> words = app.remaining(true);
    const bool is_incomplete = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    std::string what = error.what();
    if (!words.empty() && (is_incomplete || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)) {
        what = describe_extra_word(typed, words);
    } else if (const CLI::Option* option = find_unread_option(*typed.app);
               option != nullptr && dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
        if (!what.starts_with("--")) what = option->get_name() + ": " + what;
    }
    return fmt::format("{}; see {} --help", what, typed.name);
}

}  // namespace musim::cli
