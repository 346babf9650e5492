#include "cli/progress_line.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "cli/output.hpp"
#include "cli/progress_text.hpp"
#include "cli/terminal.hpp"

namespace musim::cli {
namespace {

using namespace std::chrono_literals;

/// Nothing is shown before: most commands are done by then.
constexpr auto kPatience = 2s;

/// A run is observed from so long before a line is due, since samples and progress come in turns, and so often.
constexpr std::chrono::milliseconds kAhead = 1s, kObserving = 100ms;

/// Letters of a name that stay on a line which is too short for it.
constexpr std::size_t kLeastOfName = 12;

/// All of a line but the name.
std::string compose_tail(double fraction, const std::optional<lsdem::RunProgress>& seen, const std::string& left) {
    return fmt::format(": {:.0f} %, {}{} left", 100.0 * fraction, seen ? describe_progress(*seen) + ", " : "", left);
}

/// A line that leaves the last column free, since a terminal goes to the next line there: of the name as much as there is room for, and
/// bars and state only where they fit.
std::string compose_line(const std::string& name, double fraction, const std::optional<lsdem::RunProgress>& seen, const std::string& left,
                         std::size_t columns) {
    std::vector<std::string> tails;
    if (seen) tails = {compose_tail(fraction, seen, left) + draw_progress(*seen), compose_tail(fraction, seen, left)};
    tails.push_back(compose_tail(fraction, std::nullopt, left));
    for (const std::string& tail : tails) {
        const std::size_t taken = count_characters(tail) + 1;
        const std::size_t room = columns > taken ? columns - taken : 0;
        if (room >= std::min(kLeastOfName, count_characters(name))) return fit(name, room) + tail;
    }
    return fit(tails.back(), columns - 1);
}

}  // namespace

ProgressLine::ProgressLine(std::string what, bool continues)
    : what_(std::move(what)), continues_(continues), terminal_(is_terminal(stderr)), next_(start_ + kPatience) {}

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
    const double rate = (fraction - fraction_before_) / elapsed;
    const std::string left = describe_left(std::max(0.0, 1.0 - spare_ - fraction) / rate, (1.0 - fraction) / rate);
    if (terminal_) {
        note("\r{}\x1b[K", compose_line(what_, fraction, seen_, left, count_columns(stderr)));
    } else {
        note("{}{}\n", what_, compose_tail(fraction, seen_, left));
    }
    std::fflush(stderr);
    shown_ = true;
    next_ = now + (terminal_ ? Clock::duration(200ms) : Clock::duration(10s));
}

void ProgressLine::spare(double part) {
    const std::lock_guard lock(mutex_);
    spare_ = part;
}

void ProgressLine::name(const std::string& what) {
    const std::lock_guard lock(mutex_);
    what_ = what;
}

void ProgressLine::see(const lsdem::RunResult& run, const lsdem::TimePlan& plan) {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (now < next_ - kAhead || now < observed_ + kObserving) return;
    seen_ = lsdem::observe_run(run, plan);
    observed_ = now;
}

void ProgressInParts::begin_part(const std::string& what, double share) {
    what_ = what;
    joined_.begin_part(share);
}

std::function<void(double)> ProgressInParts::of_spare() {
    return [this](double part) { line_.spare(joined_.of_all(part)); };
}

lsdem::RunObserver ProgressInParts::observer() {
    const auto show = [this](const std::string& what, double fraction) {
        line_.name(what);
        line_.update(fraction);
    };
    return {.on_progress = [=, this](double fraction) { show(what_, joined_.after_running(fraction)); },
            .on_preparation = [=, this](double fraction) { show(what_ + ", preparing", joined_.after_preparing(fraction)); },
            .on_preparation_spare = [this](double part) { line_.spare(joined_.of_whole_part(part)); },
            .on_sample = [this](const lsdem::RunResult& run, const lsdem::TimePlan& plan) { line_.see(run, plan); }};
}

}  // namespace musim::cli
