#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "cli/manual/command_text.hpp"

namespace musim::cli {
namespace {

/// Text with a backslash before each of `special`, for a word between single quotes.
std::string escape_words(const std::string& text, const std::string& special) {
    std::string escaped;
    for (const char c : text) {
        if (special.find(c) != std::string::npos) escaped += '\\';
        escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return escaped;
}

std::string name_function(const CommandText& command) { return "_" + command.name("_"); }

/// Action that completes a value, as _arguments takes it.
std::string find_action(const OptionText& option) {
    const std::string files = option.path == PathKind::folder ? "_files -/" : "_files";
    std::string names = "(" + join(option.choices, " ") + ")";
    if (option.choices.empty()) return option.path == PathKind::none ? " " : files;
    if (option.path == PathKind::none) return names;
    return fmt::format("{{_alternative \"names:name:{}\" \"files:file:{}\"}}", names, files);
}

/// ":FROM: :TO: ", the values of an option.
std::string list_values(const OptionText& option) {
    const int count = option.most_values == kManyValues ? 1 : option.most_values;
    std::istringstream names(option.value);
    std::string text, name = option.value;
    for (int i = 0; i < count; ++i) {
        if (count > 1) names >> name;
        text += fmt::format(":{}:{}", escape_words(name, ":\\"), escape_words(find_action(option), ":"));
    }
    return text;
}

/// The lines of _arguments for an option, one for each of its names.
std::string list_option(const OptionText& option) {
    std::vector<std::string> barred = option.repeats ? std::vector<std::string>() : option.names;
    std::copy_if(option.bars.begin(), option.bars.end(), std::back_inserter(barred),
                 [](const auto& name) { return name.starts_with('-'); });
    std::string text;
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        text += fmt::format(" \\\n        '{}{}{}{}[{}]{}'", barred.empty() ? "" : "(" + join(barred, " ") + ")", option.repeats ? "*" : "",
                            name, is_long && !option.is_flag() ? "=" : "", escape_words(option.help, "[]:\\"), list_values(option));
    }
    return text;
}

std::string list_argument(const OptionText& argument) {
    const char* const mark = argument.most_values == kManyValues ? "*:" : argument.is_required ? ":" : "::";
    return fmt::format(" \\\n        '{}{}:{}'", mark, argument.names.front(), escape_words(find_action(argument), ":"));
}

/// The function that completes a command, and those of its commands above it.
std::string define_function(const CommandText& command) {
    std::string above;
    std::string text = name_function(command) + "() {\n";
    std::string words;
    for (const OptionText& option : command.options) words += list_option(option);
    for (const OptionText& argument : command.arguments) words += list_argument(argument);
    if (command.commands.empty()) return text + "    _arguments -S" + words + "\n}\n\n";

    std::string names, branches;
    for (const CommandText& each : command.commands) {
        above += define_function(each);
        names += fmt::format("                '{}:{}'\n", each.words.back(), escape_words(each.summary, ":\\"));
        branches += fmt::format("                {}) {} ;;\n", each.words.back(), name_function(each));
    }
    text += "    local curcontext=$curcontext state line\n    local -a commands\n    typeset -A opt_args\n";
    text += "    _arguments -C" + words + " \\\n        '1:command:->command' \\\n        '*::argument:->argument' && return\n";
    text += "    case $state in\n        command)\n            commands=(\n" + names +
            "            )\n            _describe command commands ;;\n";
    text += "        argument)\n            curcontext=${curcontext%:*}-$words[1]:\n            case $words[1] in\n" + branches +
            "            esac ;;\n";
    return above + text + "    esac\n}\n\n";
}

}  // namespace

std::string make_zsh_completion(const CommandText& root) {
    return "#compdef musim\n# zsh completion for musim, made from the program's own commands\n\n" + define_function(root) +
           name_function(root) + " \"$@\"\n";
}

}  // namespace musim::cli
