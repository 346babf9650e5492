#include "cli/manual/command_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/Option.hpp>
#include <initializer_list>
#include <set>
#include <sstream>
#include <utility>

#include "lsdem/scene/material_presets.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::cli {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Paths that a value of this type may be: types are named after files, folders and their endings.
PathKind find_path_kind(const std::string& type) {
    const auto any_of = [&type](std::initializer_list<const char*> parts) {
        return std::any_of(parts.begin(), parts.end(), [&type](const char* part) { return contains(type, part); });
    };
    if (any_of({"FILE", ".", "OUT", "RECORD", "DESIGN", "LAW"})) return PathKind::file;
    return contains(type, "DIR") ? PathKind::folder : PathKind::none;
}

/// The words of `{a,b}` at the end of a type that CLI11 names `TYPE:{a,b}`, and the names that a type stands for.
std::vector<std::string> find_choices(const std::string& full_type, const std::string& type) {
    std::vector<std::string> choices;
    if (const std::size_t open = full_type.find('{'); open != std::string::npos) {
        std::istringstream list(full_type.substr(open + 1, full_type.find('}') - open - 1));
        for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
    } else if (type == "LAW") {
        choices = scaling::scale_law_names();
    } else if (type.starts_with("PRESET")) {
        choices = lsdem::material_preset_names();
    }
    return choices;
}

/// Names of some of an App's options, in the order in which it shows them.
std::vector<std::string> list_names(const CLI::App& app, const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    names.reserve(options.size());
    for (const CLI::Option* option : app.get_options()) {
        const bool is_meant = std::any_of(options.begin(), options.end(), [option](const CLI::Option* each) { return each == option; });
        if (!is_meant) continue;
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        if (option->get_lnames().empty()) names.push_back(option->get_name());
    }
    return names;
}

OptionText describe_option(const CLI::App& app, const CLI::Option& option) {
    OptionText text;
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    if (option.get_positional()) text.names = {option.get_name(true)};
    text.help = option.get_description();
    text.is_required = option.get_required();
    text.needs = list_names(app, option.get_needs());
    text.bars = list_names(app, option.get_excludes());
    if (option.get_items_expected_max() == 0) return text;

    const std::string full_type = option.get_type_name();
    text.value = full_type.substr(0, full_type.find(":{"));
    text.choices = find_choices(full_type, text.value);
    text.path = find_path_kind(text.value);
    text.most_values = std::min(option.get_items_expected_max(), kManyValues);
    text.repeats = text.most_values == kManyValues || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    if (!contains(text.help, "(default")) text.default_value = option.get_default_str();
    return text;
}

void append_line(std::string& prose, const std::string& line) {
    prose += (prose.empty() ? "" : " ") + line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

FooterText read_footer(const std::string& footer) {
    FooterText text;
    std::vector<std::string>* section = nullptr;  // that indented lines belong to
    std::istringstream lines(footer);
    for (std::string line; std::getline(lines, line);) {
        if (line == "Examples:" || line == "Exit codes:") {
            section = line == "Examples:" ? &text.examples : &text.exit_codes;
        } else if (section != nullptr && line.starts_with("  ")) {
            section->push_back(line.substr(2));
        } else {
            section = nullptr;
            append_line(text.examples.empty() ? text.before : text.after, line);
        }
    }
    return text;
}

CommandText describe(const CLI::App& app, std::vector<std::string> words) {
    CommandText text;
    text.words = std::move(words);
    text.words.push_back(app.get_name());
    text.summary = app.get_description();
    text.group = app.get_group();
    text.footer = read_footer(app.get_footer());
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_group().empty()) continue;  // hidden
        (option->get_positional() ? text.arguments : text.options).push_back(describe_option(app, *option));
    }
    for (const CLI::App* each : app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); })) {
        text.commands.push_back(describe(*each, text.words));
    }
    return text;
}

}  // namespace

std::string join(const std::vector<std::string>& texts, const std::string& mark) { return fmt::format("{}", fmt::join(texts, mark)); }

std::string CommandText::name(const std::string& mark) const { return join(words, mark); }

CommandText describe_command(const CLI::App& app) { return describe(app, {}); }

}  // namespace musim::cli
