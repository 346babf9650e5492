#include "cli/interruption.hpp"

#include <fmt/format.h>

#include <csignal>
#include <filesystem>

#include "cli/output.hpp"
#include "lsdem/results/checkpoint.hpp"
#include "scaling/interruption.hpp"

namespace musim::cli {
namespace {

constexpr const char* kWithoutFolder = "nothing was written; with -o DIR the command could be continued";

}  // namespace

int run_interruptible(const std::function<int()>& work, const std::function<std::string()>& go_on) {
    scaling::listen_for_interruption();
    try {
        return work();
    } catch (const scaling::Interrupted& interrupted) {
        note("musim: interrupted by {}: {}\n", interrupted.signal() == SIGINT ? "SIGINT" : "SIGTERM", go_on());
        return 128 + interrupted.signal();
    }
}

int run_resumable(const std::function<int()>& work, const std::string& command, const std::string& directory) {
    return run_interruptible(work, [&]() -> std::string {
        if (directory.empty()) return kWithoutFolder;
        if (!std::filesystem::exists(std::filesystem::path(directory) / lsdem::kCheckpointName)) {
            return "it had not begun to compute, and nothing was written; start the command again";
        }
        return fmt::format("continue with `{} --resume {}`", command, directory);
    });
}

int run_again(const std::function<int()>& work, const std::string& directory) {
    return run_interruptible(work, [&]() -> std::string {
        return directory.empty() ? kWithoutFolder : fmt::format("the same command again goes on from what is in {}", directory);
    });
}

int run_whole(const std::function<int()>& work) {
    return run_interruptible(work, [] { return std::string("nothing was written; start the command again"); });
}

}  // namespace musim::cli
