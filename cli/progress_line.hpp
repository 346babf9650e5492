#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace musim::cli {

/// A line on stderr with the percentage done and the time left. It says nothing during the first two seconds; on a terminal it is
/// rewritten in place, elsewhere a new line follows every ten seconds.
class ProgressLine {
  public:
    /// `fraction_before`: done by an earlier run that this one continues.
    explicit ProgressLine(std::string what, double fraction_before = 0.0);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `fraction` done, 0 to 1. May be called from any thread, as often as one likes.
    void update(double fraction);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    double fraction_before_;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point next_;
    std::mutex mutex_;
};

/// The progress of a preparation, and then that of a run: two lines one after the other.
class ProgressInParts {
  public:
    /// `fraction_before`: of the run, see ProgressLine.
    explicit ProgressInParts(std::string what, double fraction_before = 0.0) : what_(std::move(what)), fraction_before_(fraction_before) {}

    std::function<void(double)> of_preparation();
    std::function<void(double)> of_run();

  private:
    std::string what_;
    double fraction_before_;
    std::optional<ProgressLine> preparation_, run_;
};

}  // namespace musim::cli
