#pragma once

#include <functional>
#include <string>

namespace musim::cli {

/// Carries out the work of a command that keeps what it has when SIGINT or SIGTERM asks it to stop. Says then in one line on stderr what
/// `go_on`, asked at that time, says: how to continue. The exit code is that of the work, or 128 + signal: 130 or 143.
int run_interruptible(const std::function<int()>& work, const std::function<std::string()>& go_on);

/// The same for what `COMMAND --resume DIRECTORY` continues from the checkpoint in a directory; without one nothing is kept.
int run_resumable(const std::function<int()>& work, const std::string& command, const std::string& directory);

/// The same for what the same command again continues from what is in a directory; without one nothing is kept.
int run_again(const std::function<int()>& work, const std::string& directory);

/// The same for work of which nothing is kept before its end.
int run_whole(const std::function<int()>& work);

}  // namespace musim::cli
