#include "cli/progress_line.hpp"

#include <unistd.h>

#include <cmath>
#include <utility>

#include "cli/output.hpp"

namespace musim::cli {
namespace {

using namespace std::chrono_literals;

/// Nothing is shown before: most commands are done by then.
constexpr auto kPatience = 2s;

/// "1 h 05 min", "3 min 20 s" or "12 s".
std::string format_duration(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
    if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} s", whole);
}

}  // namespace

ProgressLine::ProgressLine(std::string what, bool continues)
    : what_(std::move(what)), continues_(continues), terminal_(isatty(STDERR_FILENO) == 1), next_(start_ + kPatience) {}

ProgressLine::~ProgressLine() {
    // leaves a clean line behind
    if (shown_ && terminal_) note("\r\x1b[K");
}

void ProgressLine::update(double fraction) {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (continues_) {
        continues_ = false;
        fraction_before_ = fraction;
        start_ = now;
    }
    if (now < next_ || !(fraction > fraction_before_)) return;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double left = elapsed * (1.0 - fraction) / (fraction - fraction_before_);
    note("{}{}: {:.0f} %, {} left{}", terminal_ ? "\r" : "", what_, 100.0 * fraction, format_duration(left), terminal_ ? "\x1b[K" : "\n");
    std::fflush(stderr);
    shown_ = true;
    next_ = now + (terminal_ ? Clock::duration(200ms) : Clock::duration(10s));
}

std::function<void(double)> ProgressInParts::of_preparation() {
    return [this](double fraction) {
        if (!preparation_) preparation_.emplace(what_ + ", preparing");
        preparation_->update(fraction);
    };
}

std::function<void(double)> ProgressInParts::of_run() {
    return [this](double fraction) {
        preparation_.reset();
        if (!run_) run_.emplace(what_, continues_);
        run_->update(fraction);
    };
}

}  // namespace musim::cli
