#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/manual/command_text.hpp"

namespace musim::cli {
namespace {

/// Text as roff prints it letter by letter; `-`, quotes and their like would become typographic signs, which nobody can paste into a shell.
std::string escape(const std::string& text) {
    static const std::map<char, const char*> kSigns{{'\\', "\\(rs"}, {'-', "\\-"},   {'\'', "\\(aq"}, {'`', "\\(ga"},
                                                    {'^', "\\(ha"},  {'~', "\\(ti"}, {'"', "\\(dq"}};
    std::string escaped;
    for (const char c : text) {
        const auto sign = kSigns.find(c);
        escaped += sign == kSigns.end() ? std::string(1, c) : sign->second;
    }
    if (escaped.starts_with('.')) escaped = "\\&" + escaped;
    return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + escape(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escape(text) + "\\fR"; }

/// A reference to another page, such as musim-run(1).
std::string refer_to(const CommandText& command) { return bold(command.name("-")) + "(1)"; }

std::string join_bold(const std::vector<std::string>& names) {
    std::vector<std::string> list(names.size());
    std::transform(names.begin(), names.end(), list.begin(), bold);
    return join(list, ", ");
}

/// "--length NUMBER", as it is typed.
std::string show_option(const OptionText& option, const std::string& name) {
    std::string shown = bold(name);
    if (!option.is_flag()) shown += " " + italic(option.value);
    return shown + (option.most_values == kManyValues ? "\\ ..." : "");
}

std::string show_argument(const OptionText& argument) {
    const std::string shown = italic(argument.names.front()) + (argument.most_values == kManyValues ? "\\ ..." : "");
    return argument.is_required ? shown : "[" + shown + "]";
}

std::string make_synopsis(const CommandText& command) {
    std::string line = bold(command.name());
    for (const OptionText& option : command.options) {
        if (option.is_required) line += " " + show_option(option, option.names.back());
    }
    line += " [" + italic("OPTION") + " ...]";
    for (const OptionText& argument : command.arguments) line += " " + show_argument(argument);
    if (!command.commands.empty()) line += " " + italic("COMMAND") + " ...";
    return line + "\n";
}

/// A definition: a term in a line of its own, its text indented below.
std::string define(const std::string& term, const std::string& text) { return fmt::format(".TP\n{}\n{}\n", term, text); }

/// Explanation of an option: effect, values, and what goes with it.
std::string explain(const OptionText& option) {
    std::string text = escape(option.help) + ".";
    if (!option.choices.empty()) {
        text += fmt::format("\n{}: {}.", option.path == PathKind::none ? "One of" : "Known by name", join_bold(option.choices));
    }
    if (!option.default_value.empty()) text += fmt::format("\nDefault: {}.", bold(option.default_value));
    if (option.is_required) text += "\nRequired.";
    if (!option.needs.empty()) text += fmt::format("\nOnly with {}.", join_bold(option.needs));
    if (!option.bars.empty()) text += fmt::format("\nNot with {}.", join_bold(option.bars));
    return text;
}

std::string explain_all(const std::vector<OptionText>& options) {
    std::string text;
    for (const OptionText& option : options) {
        std::string term;
        if (option.names.front().starts_with('-')) {
            term = join_bold({option.names.begin(), option.names.end() - 1});
            term += (term.empty() ? "" : ", ") + show_option(option, option.names.back());
        } else {
            term = italic(option.names.front()) + (option.value.empty() ? "" : " (" + italic(option.value) + ")");
        }
        text += define(term, explain(option));
    }
    return text;
}

std::string list_commands(const CommandText& command) {
    std::string text, group;
    for (const CommandText& each : command.commands) {
        if (each.group != group) text += fmt::format(".SS {}\n", escape(each.group));
        group = each.group;
        text += define(bold(each.words.back()), fmt::format("{}; see\n{}.", escape(each.summary), refer_to(each)));
    }
    return text;
}

std::string show_examples(const std::vector<std::string>& lines) {
    std::string text = ".EX\n";
    for (const std::string& line : lines) text += escape(line) + "\n";
    return text + ".EE\n";
}

std::string list_exit_codes(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        const std::size_t gap = line.find("  ");
        text += define(bold(line.substr(0, gap)), escape(line.substr(line.find_first_not_of(' ', gap))) + ".");
    }
    return text;
}

/// The pages beside, above and below this one.
std::string list_neighbours(const CommandText& command, const CommandText& root) {
    std::vector<std::string> pages;
    const CommandText* above = &root;
    const CommandText* beside = nullptr;  // the command whose commands stand beside this one
    for (std::size_t depth = 1; depth < command.words.size(); ++depth) {
        beside = above;
        pages.push_back(refer_to(*above));
        const auto next = std::find_if(above->commands.begin(), above->commands.end(),
                                       [&](const CommandText& each) { return each.words.back() == command.words[depth]; });
        above = &*next;
    }
    for (const CommandText& each : command.commands) pages.push_back(refer_to(each));
    if (beside != nullptr && beside != &root) {
        for (const CommandText& each : beside->commands) {
            if (each.words != command.words) pages.push_back(refer_to(each));
        }
    }
    return join(pages, ",\n") + "\n";
}

std::string section(const std::string& title, const std::string& text) {
    return text.empty() ? "" : fmt::format(".SH {}\n{}", title, text);
}

std::string to_paragraph(const std::string& prose) { return prose.empty() ? "" : ".PP\n" + escape(prose) + "\n"; }

}  // namespace

std::string make_man_page(const CommandText& command, const CommandText& root, const std::string& version) {
    std::string page = fmt::format(".\\\" Made from the program's own help\n.TH {} 1 \"\" \"musim {}\" \"musim manual\"\n",
                                   escape(command.name("-")), version);
    const FooterText& footer = command.footer;
    page += section("NAME", fmt::format("{} \\- {}\n", escape(command.name("-")), escape(command.summary)));
    page += section("SYNOPSIS", make_synopsis(command));
    page += section("DESCRIPTION", escape(command.summary) + ".\n" + to_paragraph(footer.before) + to_paragraph(footer.after));
    page += section("COMMANDS", list_commands(command));
    page += section("ARGUMENTS", explain_all(command.arguments));
    page += section("OPTIONS", explain_all(command.options));
    if (!footer.examples.empty()) page += section("EXAMPLES", show_examples(footer.examples));
    page += section("EXIT STATUS", list_exit_codes(root.footer.exit_codes));
    return page + section("SEE ALSO", list_neighbours(command, root));
}

}  // namespace musim::cli
