#include <array>
#include <chrono>
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_text.hpp"
#include "cli/terminal.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/run/watched_folder.hpp"

namespace musim::cli {
namespace {

struct WatchOptions {
    std::string directory;
    bool once = false;
    bool json = false;
};

/// Looks in between, and how often a terminal is written to; a file gets a line every ten seconds.
constexpr auto kLook = std::chrono::milliseconds(500);
constexpr int kChecksPerLine = 20;

std::string describe(const lsdem::WatchedRun& run) {
    const lsdem::ProgressState& state = run.state;
    std::string text = fmt::format("{}: {}{:.0f} %", state.name, state.prepares ? "preparing, " : "", 100.0 * state.fraction);
    if (state.run) text += ", " + describe_progress(*state.run);
    if (!run.works) return text + ", killed";
    if (state.left) text += fmt::format(", {} left", describe_left(state.least_left.value_or(*state.left), *state.left));
    return text;
}

/// A line for each run; bars on a terminal, and no line longer than it is wide, so that they can be written anew.
std::vector<std::string> make_lines(const lsdem::WatchedFolder& watched) {
    const bool terminal = is_terminal(stdout);
    std::vector<std::string> lines;
    for (const lsdem::WatchedRun& run : watched.runs) {
        const std::string text = describe(run);
        const std::string bars = terminal && run.state.run ? draw_progress(*run.state.run) : "";
        const std::size_t columns = terminal ? count_columns(stdout) - 1 : text.size();
        const bool bars_fit = count_characters(text) + count_characters(bars) <= columns;
        const std::string line = bars_fit ? text + bars : fit(text, columns);
        lines.push_back(!run.works || (run.state.run && run.state.run->collapsed) ? in_red(line, stdout) : line);
    }
    if (lines.empty()) lines.emplace_back("it works, and will report its state after two seconds");
    return lines;
}

/// Writes lines over those that were written before on a terminal, below them elsewhere.
void show(const std::vector<std::string>& lines, std::size_t before) {
    if (is_terminal(stdout) && before > 0) print("\x1b[{}A\x1b[J", before);
    for (const std::string& line : lines) print("{}\n", line);
    std::fflush(stdout);
}

std::string to_text(lsdem::FolderState state) {
    constexpr std::array kNames{"empty", "working", "killed", "finished"};
    return kNames.at(static_cast<std::size_t>(state));
}

int report_json(const lsdem::WatchedFolder& watched, const std::string& directory) {
    nlohmann::json runs = nlohmann::json::array();
    for (const lsdem::WatchedRun& run : watched.runs) {
        runs.push_back(lsdem::to_json(run.state));
        runs.back()["folder"] = run.folder.string();
        runs.back()["works"] = run.works;
    }
    nlohmann::json object{{"directory", directory}, {"state", to_text(watched.state)}, {"runs", runs}};
    if (!watched.status.empty()) object["status"] = watched.status;
    print_json(object);
    return kDone;
}

/// Report of the end, and the exit code.
int report_end(const lsdem::WatchedFolder& watched, const std::string& directory) {
    if (watched.state == lsdem::FolderState::killed) {
        throw lsdem::ResultError(
            fmt::format("{}: what worked here was killed; go on with --resume {} of the command that began it (an ensemble: the same "
                        "command again)",
                        directory, directory));
    }
    if (watched.state == lsdem::FolderState::empty) {
        throw lsdem::ResultError(
            fmt::format("{}: nothing works here, and there are no results; give the directory of `musim run`, `pair`, `sequence` or "
                        "`ensemble` (-o)",
                        directory));
    }
    if (watched.status == "damaged") {
        throw lsdem::ResultError(fmt::format("{}: finished, but its summary is damaged; give the command again that made it", directory));
    }
    print("{}: finished{}{}\n", directory, watched.status.empty() ? "" : ", ", watched.status);
    return watched.status == "diverged" ? kNumericalFailure : kDone;
}

int run_watch(const WatchOptions& options) {
    lsdem::WatchedFolder watched = lsdem::look_into(options.directory);
    if (options.json && watched.state != lsdem::FolderState::empty) return report_json(watched, options.directory);
    std::size_t shown = 0;
    for (int look = 0; watched.state == lsdem::FolderState::working; ++look) {
        if (is_terminal(stdout) || look % kChecksPerLine == 0) {
            const std::vector<std::string> lines = make_lines(watched);
            show(lines, shown);
            shown = lines.size();
        }
        if (options.once) return kDone;
        std::this_thread::sleep_for(kLook);
        watched = lsdem::look_into(options.directory);
    }
    return report_end(watched, options.directory);
}

}  // namespace

void add_watch_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<WatchOptions>();
    CLI::App* command = app.add_subcommand("watch", "Follow a run, pair, sequence or ensemble that was started elsewhere");
    command->add_option("directory", options->directory, "The directory that it works on (-o)")->required()->type_name("DIR");
    command->add_flag("--once", options->once, "Report its state once and end");
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim watch out/tower\n"
        "  musim watch out/walls --once\n"
        "  musim watch out/tower --json\n"
        "Reports how much is done, the time of the model, kinetic energy, the largest drift between two blocks of the spine that are "
        "above\n"
        "each other, and on a terminal the velocity of the top so far, until it ends. --json reports once. A run reports its state "
        "every\n"
        "two seconds. Exit code: as the run's (4: it diverged); 3: it was killed, or nothing works there.");
    command->callback([&action, options] { action = [options] { return run_watch(*options); }; });
}

}  // namespace musim::cli
