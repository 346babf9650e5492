#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

/// Man pages and completion of the program, from the commands and options that it has.
namespace musim::cli {

/// Paths that a value on the command line may be.
enum class PathKind { none, folder, file };

/// An option or argument, as --help gives it.
struct OptionText {
    std::vector<std::string> names;        ///< "-o", "--out"; of an argument one without dashes: "scene"
    std::string value;                     ///< "FROM TO"; empty for a flag
    std::vector<std::string> choices;      ///< values that are known by name
    PathKind path = PathKind::none;        ///< that a value may be
    int most_values = 0;                   ///< after the option, 0 for a flag; kManyValues: any number
    bool is_required = false;              ///< the command does not do without
    bool repeats = false;                  ///< may be given several times
    std::string default_value;             ///< empty where the help names it, or there is none
    std::string help;                      ///< one line
    std::vector<std::string> needs, bars;  ///< names of others that must, or must not, be given with it

    bool is_flag() const { return most_values == 0; }
};
inline constexpr int kManyValues = 1 << 10;

/// The text below the options, by what its lines are.
struct FooterText {
    std::string before, after;            ///< prose above and below the examples
    std::vector<std::string> examples;    ///< command lines
    std::vector<std::string> exit_codes;  ///< "0  done"
};

/// A command with all that belongs to it.
struct CommandText {
    std::vector<std::string> words;  ///< "musim", "record", "plot"
    std::string summary;             ///< one line
    std::string group;               ///< heading under which the command above shows it
    std::vector<OptionText> options, arguments;
    FooterText footer;
    std::vector<CommandText> commands;

    /// "musim record plot", or with another mark between the words.
    std::string name(const std::string& mark = " ") const;
};

/// The text of an App with all its commands. An App of CLI11 gives its choices only as a part of the name of an option's type, `{a,b}`.
CommandText describe_command(const CLI::App& app);

/// `texts` with `mark` between them.
std::string join(const std::vector<std::string>& texts, const std::string& mark);

/// "musim-run.1" and its page, to be read by man; `version` is that of the program. `root` is the program's command, whose exit codes are
/// those of all commands.
std::string make_man_page(const CommandText& command, const CommandText& root, const std::string& version);

/// Scripts that complete command lines of the program, as bash and zsh load them.
std::string make_bash_completion(const CommandText& root);
std::string make_zsh_completion(const CommandText& root);

}  // namespace musim::cli
