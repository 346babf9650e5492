#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>

#include "cli/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::cli {

/// What the program left behind.
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
    /// Runs `musim ARGUMENTS`, words as in a shell. On a slow machine a command may last long enough for progress lines, which are left
    /// out. A copy of the test's own process carries it out: under AddressSanitizer to load the program takes a hundred times as long as
    /// most commands. `shell` comes first on a command line of the shell, e.g. a limit, which runs the program itself.
    Outcome run(const std::string& arguments, const std::string& shell = "") const {
        const std::string out = folder_.path() / ".stdout";
        const std::string err = folder_.path() / ".stderr";
        const int status = shell.empty() && has_only_words(arguments)
                               ? run_copy(arguments, out, err)
                               : std::system(("cd '" + folder_.path().string() + "' && { " + shell + " " + MUSIM_PROGRAM + " " + arguments +
                                              "; } >'" + out + "' 2>'" + err + "'")
                                                 .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, musim::tests::bytes_of(out), without_progress(musim::tests::bytes_of(err))};
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

    /// How many files and folders there are, but for what run() leaves; in a folder of it, all.
    long count(const std::string& folder = ".") const {
        long n = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / folder)) {
            n += entry.path().filename().string().starts_with(".std") ? 0 : 1;
        }
        return n;
    }

  private:
    /// Whether it asks nothing of a shell but to part words: no redirection, no command of its own.
    static bool has_only_words(const std::string& arguments) {
        wordexp_t words;
        const int error = wordexp(arguments.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF);
        if (error == 0) wordfree(&words);
        return error == 0;
    }

    /// Carries out `musim ARGUMENTS` in a copy of this process; what waitpid() says of it.
    int run_copy(const std::string& arguments, const std::string& out, const std::string& err) const {
        std::fflush(nullptr);
        const pid_t child = fork();
        if (child == -1) throw std::runtime_error("no process can be made");
        if (child == 0) {
            if (chdir(folder_.path().c_str()) != 0 || setenv("PWD", folder_.path().c_str(), 1) != 0) std::exit(125);
            redirect(out, STDOUT_FILENO);
            redirect(err, STDERR_FILENO);
            wordexp_t words;
            if (wordexp(("musim " + arguments).c_str(), &words, WRDE_NOCMD) != 0) std::exit(125);
            const int exit_code = run_program(static_cast<int>(words.we_wordc), words.we_wordv);
            wordfree(&words);
            std::exit(exit_code);
        }
        int status = 0;
        if (waitpid(child, &status, 0) != child) throw std::runtime_error("a process is lost");
        return status;
    }

    static void redirect(const std::string& file, int descriptor) {
        const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);  // NOLINT(cppcoreguidelines-pro-type-vararg)
        if (opened == -1 || dup2(opened, descriptor) == -1) std::exit(125);
        close(opened);
    }

    static std::string without_progress(const std::string& text) {
        return std::regex_replace(text, std::regex("[^\n]*: [0-9]+ %, [^\n]* left\n"), "");
    }

    musim::tests::TemporaryFolder folder_;
};

/// Stands in for a full disk: no file may grow beyond 4 KiB.
inline constexpr const char* kFullDisk = "ulimit -f 4;";

}  // namespace musim::cli
