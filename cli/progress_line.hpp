#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "lsdem/run/joined_progress.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/run/simulate.hpp"

namespace musim::cli {

/// A line on stderr with the percentage done, where a run stands if that is known, and the time left. It says nothing during the first two
/// seconds; on a terminal it is rewritten in place, with the velocity of the top as bars, elsewhere a new line follows every ten seconds.
class ProgressLine {
  public:
    /// `continues`: the first fraction was done by an earlier run, and the time left is counted from there.
    explicit ProgressLine(std::string what, bool continues = false);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `fraction` done, 0 to 1. May be called from any thread, as often as one likes.
    void update(double fraction);

    /// The part at the end, 0 to 1, that may not be needed: from now on the time left is a range.
    void spare(double part);

    /// Name that the lines begin with from now on.
    void name(const std::string& what);

    /// Where the run stands, for the lines from now on. As often as one likes: observed only shortly before a line is due.
    void see(const lsdem::RunResult& run, const lsdem::TimePlan& plan);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    std::optional<lsdem::RunProgress> seen_;
    bool continues_;
    double fraction_before_ = 0.0, spare_ = 0.0;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point next_, observed_{};
    std::mutex mutex_;
};

/// The progress of preparations and of the runs after them, as one scale on one line.
class ProgressInParts {
  public:
    /// `continues`: what was done before is not counted in the time left, see ProgressLine.
    explicit ProgressInParts(const std::string& what, bool continues = false) : what_(what), line_(what, continues) {}

    /// Begins another preparation with its runs, called `what`, which are this share of all; without, one is all.
    void begin_part(const std::string& what, double share);

    /// Shows what is observed, samples before the part that is done then.
    lsdem::RunObserver observer();
    /// The part of the runs, 0 to 1, that may not be needed.
    std::function<void(double)> of_spare();

  private:
    std::string what_;
    ProgressLine line_;
    lsdem::JoinedProgress joined_;
};

}  // namespace musim::cli
