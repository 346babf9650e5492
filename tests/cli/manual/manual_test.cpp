#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

const std::string kScripts = MUSIM_SOURCE_DIR "/tests/cli/manual/";

/// The words that begin the lines of a help below a heading.
std::vector<std::string> list_words(const std::string& help, const std::string& heading) {
    std::vector<std::string> words;
    std::istringstream lines(help.substr(std::min(help.find(heading + "\n"), help.size())));
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line) && !line.empty();) {
        if (line[2] == ' ') continue;  // the line before goes on
        std::istringstream(line) >> words.emplace_back();
    }
    return words;
}

/// The commands that a help lists, under headings that say what they are for.
std::vector<std::string> list_commands(const std::string& help) {
    std::vector<std::string> commands;
    std::istringstream lines(help);
    for (std::string line, before; std::getline(lines, line) && line != "Examples:" && line != "Exit codes:"; before = line) {
        const bool is_heading = before.empty() && line.size() > 1 && line.front() != ' ' && line.back() == ':';
        if (!is_heading || line == "Positionals:" || line == "Options:") continue;
        const std::vector<std::string> below = list_words(help, line);
        commands.insert(commands.end(), below.begin(), below.end());
    }
    return commands;
}

/// Calls `visit` with the words of a command and its help, then for each of its commands.
void visit_commands(const Workplace& here, const std::string& words,
                    const std::function<void(const std::string&, const std::string&)>& visit) {
    const std::string help = here.run(words + " --help").out;
    visit("musim" + words, help);
    for (const std::string& each : list_commands(help)) visit_commands(here, fmt::format("{} {}", words, each), visit);
}

std::string replace_all(const std::string& text, const std::string& what, const std::string& by) {
    return std::regex_replace(text, std::regex(what), by);
}

/// Output of a command of the shell.
std::string print_of(const Workplace& here, const std::string& command) {
    here.shell("{ " + command + "; } >printed 2>&1");
    return here.read("printed");
}

}  // namespace

TEST_CASE("every command has a man page with all its options and examples and every completion knows it") {
    const Workplace here;
    const std::string bash = musim::tests::bytes_of(MUSIM_PAGES "/bash/musim"), zsh = musim::tests::bytes_of(MUSIM_PAGES "/zsh/_musim");
    int commands = 0;
    visit_commands(here, "", [&](const std::string& words, const std::string& help) {
        CAPTURE(words);
        ++commands;
        const std::string page = musim::tests::bytes_of(MUSIM_PAGES "/man1/" + replace_all(words, " ", "-") + ".1");
        for (const std::string& names : list_words(help, "Options:")) {
            for (const std::string& name : {names.substr(0, names.find(',')), names.substr(names.find(',') + 1)}) {
                CHECK_MESSAGE(page.find("\\fB" + replace_all(name, "-", "\\-") + "\\fR") != std::string::npos, name);
                CHECK_MESSAGE(bash.find("\"" + words + "\") ") != std::string::npos, name);
                CHECK_MESSAGE(zsh.find(name) != std::string::npos, name);
            }
        }
        for (const std::string& name : list_commands(help)) {
            CHECK(page.find("\\fB" + name + "\\fR") != std::string::npos);
            CHECK(zsh.find("'" + name + ":") != std::string::npos);
        }
        CHECK((help.find("\nExamples:\n") != std::string::npos) == (page.find("\n.SH EXAMPLES\n.EX\nmusim ") != std::string::npos));
        for (const char* const title : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "SEE ALSO"}) {
            CHECK(page.find("\n.SH " + std::string(title) + "\n") != std::string::npos);
        }
    });
    CHECK(commands > 30);
}

TEST_CASE("commands stand under what people want to do") {
    const Workplace here;
    const std::string help = here.run("--help").out;
    CHECK(list_words(help, "Compare prototype and models:") == std::vector<std::string>{"pair"});
    CHECK(list_words(help, "See results:") == std::vector<std::string>{"report", "response", "field", "export"});
    CHECK(list_commands(help).size() == 21);
    const std::string page = musim::tests::bytes_of(MUSIM_PAGES "/man1/musim.1");
    CHECK(page.find(".SS See results\n.TP\n\\fBreport\\fR\n") != std::string::npos);
    for (const char* const command : {"record", "record make", "calibrate", "bench"}) {
        CAPTURE(command);
        CHECK(here.run(std::string(command) + " --help").out.find("Subcommands") == std::string::npos);
    }
}

TEST_CASE("bash completes commands, options, values known by name and files") {
    const Workplace here;
    here.write("scene.json", "");
    here.shell("mkdir results");
    struct Case {
        const char *words, *offers;
    };
    for (const Case& line : {Case{"musim rec", "record\n"},
                             Case{"musim record pl", "plot\n"},
                             Case{"musim record make s", "sweep\nstochastic\n"},
                             Case{"musim run --thr", "--threads\n"},
                             Case{"musim run sc", "scene.json\n"},
                             Case{"musim run -o re", "results\n"},
                             Case{"musim run -o sc", "\n"},
                             Case{"musim run scene.json --thr", "--threads\n"},
                             Case{"musim run --threads ''", "\n"},
                             Case{"musim scale --law tr", "true_replica\n"},
                             Case{"musim scale --law sc", "scene.json\n"},
                             Case{"musim scale --format la", "latex\n"},
                             Case{"musim scale --format = la", "latex\n"},
                             Case{"musim scale --format =", "text\nmarkdown\nlatex\n"},
                             Case{"musim scale --json --format la", "latex\n"},
                             Case{"musim calibrate friction --material w", "wood\n"},
                             Case{"musim watch r", "results\n"},
                             Case{"musim new to", "tower\n"},
                             Case{"musim new tower --mat", "--material\n"},
                             Case{"musim record plot --window 1 s", "\n"},
                             Case{"musim record plot --window 1 2 s", "scene.json\n"}}) {
        CAPTURE(line.words);
        CHECK(print_of(here, "bash " + kScripts + "complete.bash " MUSIM_PAGES "/bash/musim " + line.words) == line.offers);
    }
}

#ifdef MUSIM_GROFF
TEST_CASE("man pages are set without a warning") {
    const Workplace here;
    const std::string set = MUSIM_GROFF " -man -Tutf8 -ww -rLL=80n ";
    CHECK(print_of(here, "for page in " MUSIM_PAGES "/man1/*.1; do " + set + "$page >/dev/null; done") == "");
    const std::string page = print_of(here, set + "-P -c " MUSIM_PAGES "/man1/musim-scale.1 | sed 's/.\\x08//g'");
    CHECK_MESSAGE(page.find("(0.63+/-5%)/(0.59+/-5%)\" --slenderness") != std::string::npos, page);
    CHECK_MESSAGE(page.find("       --format FORMAT\n") != std::string::npos, page);
}
#endif

#ifdef MUSIM_ZSH
TEST_CASE("zsh completes commands, options and values known by name") {
    const Workplace here;
    struct Case {
        const char *line, *shows;
    };
    for (const Case& each : {Case{"musim rec", "record  -- Ground"}, Case{"musim scale --law c", "cauchy[^a-z]*centrifuge"},
                             Case{"musim run x.json --th", "--threads  -- Threads;"}}) {
        CAPTURE(each.line);
        const std::string command = fmt::format("timeout 20 " MUSIM_ZSH " -f {}complete.zsh " MUSIM_PAGES "/zsh '{}' '{}' && echo shown",
                                                kScripts, each.line, each.shows);
        CHECK(print_of(here, command) == "shown\n");
    }
}
#endif
