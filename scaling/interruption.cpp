#include "scaling/interruption.hpp"

#include <atomic>
#include <csignal>

namespace musim::scaling {
namespace {

/// The signal that asked; 0: none.
std::atomic<int> asked{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch what needs no lock");

void ask_to_stop(int signal) { asked.store(signal); }

}  // namespace

void listen_for_interruption() {
    for (const int signal : {SIGINT, SIGTERM}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = ask_to_stop;
        // the second one finds the default again; calls that wait go on
        action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
}

bool is_interrupted() noexcept { return asked.load(std::memory_order_relaxed) != 0; }

void stop_if_interrupted() {
    if (const int signal = asked.load(std::memory_order_relaxed); signal != 0) throw Interrupted(signal);
}

}  // namespace musim::scaling
