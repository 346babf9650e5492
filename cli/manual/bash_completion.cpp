#include <fmt/format.h>

#include "cli/manual/command_text.hpp"

namespace musim::cli {
namespace {

const char* name_path(PathKind kind) {
    switch (kind) {
        case PathKind::file:
            return "file";
        case PathKind::folder:
            return "directory";
        case PathKind::none:
            break;
    }
    return "";
}

/// A branch of `case`: what a command takes.
std::string describe_command_case(const CommandText& command) {
    std::vector<std::string> commands, options;
    for (const CommandText& each : command.commands) commands.push_back(each.words.back());
    for (const OptionText& option : command.options) options.insert(options.end(), option.names.begin(), option.names.end());
    const PathKind path = command.arguments.empty() ? PathKind::none : command.arguments.front().path;
    const std::string values = command.arguments.empty() ? "" : join(command.arguments.front().choices, " ");
    std::string cases = fmt::format("        \"{}\") commands=\"{}\" options=\"{}\" arguments=\"{}\" values=\"{}\" ;;\n", command.name(),
                                    join(commands, " "), join(options, " "), name_path(path), values);
    for (const CommandText& each : command.commands) cases += describe_command_case(each);
    return cases;
}

/// Branches of `case`: what the options of a command take, but for flags.
std::string describe_option_cases(const CommandText& command) {
    std::string cases;
    for (const OptionText& option : command.options) {
        if (option.is_flag()) continue;
        std::vector<std::string> patterns;
        for (const std::string& name : option.names) patterns.push_back(fmt::format("\"{} {}\"", command.name(), name));
        cases += fmt::format("        {}) most={} choices=\"{}\" paths=\"{}\" ;;\n", join(patterns, " | "), option.most_values,
                             join(option.choices, " "), name_path(option.path));
    }
    for (const CommandText& each : command.commands) cases += describe_option_cases(each);
    return cases;
}

constexpr const char* kCompletion = R"(
_musim() {
    local current=${COMP_WORDS[COMP_CWORD]} command=musim option= given=0 most=0 word i
    local commands options arguments values choices paths
    _musim_command
    for ((i = 1; i < COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        if [[ $word == -* ]]; then
            option=$word given=0
            _musim_option
        elif [[ $word == "=" ]]; then # --format=text comes as three words
            continue
        elif ((given < most)); then
            ((++given))
        elif [[ " $commands " == *" $word "* ]]; then
            command+=" $word"
            _musim_command
        fi
    done
    [[ $current != "=" ]] || current=
    COMPREPLY=()
    if [[ $current == -* ]]; then
        choices=$options paths=
    elif ((given >= most)); then
        choices="$commands $values" paths=$arguments
    fi
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current"; [[ -z $paths ]] || compgen -A "$paths" -- "$current")
    [[ -z $paths ]] || compopt -o filenames 2>/dev/null
}
complete -F _musim musim
)";

}  // namespace

std::string make_bash_completion(const CommandText& root) {
    std::string script = "# bash completion for musim, made from the program's own commands\n\n";
    script += "# what $command takes\n_musim_command() {\n    case $command in\n" + describe_command_case(root) + "    esac\n}\n\n";
    script += "# what $option of $command takes; nothing, when it is a flag\n_musim_option() {\n    most=0 choices= paths=\n" +
              ("    case \"$command $option\" in\n" + describe_option_cases(root)) + "    esac\n}\n";
    return script + kCompletion;
}

}  // namespace musim::cli
