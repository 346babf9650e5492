#pragma once

#include <sys/wait.h>
#include <wordexp.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>

#include "cli/run_program.hpp"
#include "tests/support/redirected_output.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/working_folder.hpp"

namespace musim::cli {

/// Outcome of the program: exit code and what it printed.
struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;

    nlohmann::json json() const { return nlohmann::json::parse(out); }

    /// Exactly one line on stderr, `musim: error: ...`.
    bool has_one_error_line() const { return err.starts_with("musim: error: ") && err.find('\n') == err.size() - 1; }
};

/// An empty folder for each test, gone at its end; the program runs in it.
class Workplace {
  public:
    /// Runs `musim ARGUMENTS`, words as in a shell, in this process: AddressSanitizer takes longer to load a program than most commands.
    /// Where the shell has more to do than to part words, and after `shell`, first on the same command line, e.g. a limit, it runs the
    /// program. On a slow machine a command may last long enough for progress lines, which are left out.
    Outcome run(const std::string& arguments, const std::string& shell = "") const {
        const std::string out = folder_.path() / ".stdout", err = folder_.path() / ".stderr";
        const std::optional<int> here = shell.empty() ? run_here(arguments, out, err) : std::nullopt;
        const int exit_code = here ? *here : run_in_shell(shell + " " MUSIM_PROGRAM " " + arguments, out, err);
        return {exit_code, musim::tests::bytes_of(out), without_progress(musim::tests::bytes_of(err))};
    }

    /// Starts `musim ARGUMENTS` and sends it a signal once it listens for SIGTERM (bit 14 of what it catches) and the shell's condition
    /// `halfway` is met.
    Outcome interrupt(const std::string& arguments, const std::string& signal, const std::string& halfway) const {
        // what a shell puts in the background ignores SIGINT, unless it is set otherwise
        write("interrupt.sh", "env --default-signal=INT " MUSIM_PROGRAM " " + arguments + " >.stdout 2>.stderr &\n" +
                                  "until { grep '^SigCgt:.*[4-7c-f]...$' /proc/$!/status && " + halfway +
                                  "; } >/dev/null 2>&1 || ! kill -0 $!; do sleep 0.01; done\nkill -" + signal + " $!\nwait $!\n");
        const int status = std::system(("cd '" + folder_.path().string() + "' && sh interrupt.sh 2>/dev/null").c_str());
        std::filesystem::remove(folder_.path() / "interrupt.sh");
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".stdout"), without_progress(read(".stderr"))};
    }

    /// Runs commands of the shell.
    void shell(const std::string& commands) const {
        const std::string command = "cd '" + folder_.path().string() + "' && { " + commands + "; }";
        if (std::system(command.c_str()) == -1) throw std::runtime_error("there is no shell");
    }

    /// Starts `musim ARGUMENTS`, which works on folder `out`, holds it once the shell's condition `halfway` is met, runs `meanwhile`, kills
    /// it. Should the program have ended before, as it may on a busy machine, all begins again from `out` as it was. The condition can ask
    /// for what is newer than the file `started`, as all that the program writes is.
    void kill_halfway(const std::string& arguments, const std::string& halfway, const std::string& meanwhile = ":") const {
        write("kill.sh", "start() { exec " MUSIM_PROGRAM " " + arguments + "; }\nhalfway() { " + halfway + "; }\nmeanwhile() { " +
                             meanwhile +
                             R"(; }
mkdir -p out
cp -a out kept
for attempt in 1 2 3 4 5 6 7 8; do
    touch started
    sleep 0.02
    start &
    until halfway || ! kill -0 $!; do sleep 0.002; done
    kill -STOP $! && halfway && meanwhile && killed=yes
    kill -9 $!
    wait $!
    [ "$killed" ] && break
    rm -rf out
    cp -a kept out
done
rm -rf kept started kill.sh
)");
        shell("sh kill.sh >/dev/null 2>&1");
    }

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_.path() / name) << text; }
    bool has(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
    std::string read(const std::string& name) const { return musim::tests::bytes_of(folder_.path() / name); }

    /// Number of files and folders, but for what run() leaves; in a folder of it, all.
    long count(const std::string& folder = ".") const {
        long n = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / folder)) {
            n += entry.path().filename().string().starts_with(".std") ? 0 : 1;
        }
        return n;
    }

  private:
    /// Nothing where a shell is needed: for a redirection, or a command within the command.
    std::optional<int> run_here(const std::string& arguments, const std::string& out, const std::string& err) const {
        const musim::tests::WorkingFolder there(folder_.path());
        wordexp_t words;
        if (wordexp(("musim " + arguments).c_str(), &words, WRDE_NOCMD) != 0) return std::nullopt;
        const musim::tests::RedirectedOutput redirected(out, err);
        const int exit_code = run_program(static_cast<int>(words.we_wordc), words.we_wordv);
        wordfree(&words);
        return exit_code;
    }

    int run_in_shell(const std::string& command, const std::string& out, const std::string& err) const {
        const int status =
            std::system(("cd '" + folder_.path().string() + "' && { " + command + "; } >'" + out + "' 2>'" + err + "'").c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    static std::string without_progress(const std::string& text) {
        return std::regex_replace(text, std::regex("[^\n]*: [0-9]+ %, [^\n]* left\n"), "");
    }

    musim::tests::TemporaryFolder folder_;
};

/// Stands in for a full disk: no file may grow beyond 4 KiB.
inline constexpr const char* kFullDisk = "ulimit -f 4;";

}  // namespace musim::cli
