#pragma once

#include <exception>

/// End of a long computation when the user (SIGINT) or the system (SIGTERM) asks it to. It asks now and then whether it was, keeps what
/// it has, and throws. Nothing changes for a program that never calls listen_for_interruption().
namespace musim::scaling {

/// Thrown by a computation that was asked to stop. It is no std::runtime_error, so that nobody takes it for a failure of the computation.
class Interrupted : public std::exception {
  public:
    explicit Interrupted(int signal) noexcept : signal_(signal) {}
    const char* what() const noexcept override { return "interrupted"; }
    int signal() const noexcept { return signal_; }

  private:
    int signal_;
};

/// From now on the first SIGINT or SIGTERM asks computations to stop; the second ends the program at once, as ever. A signal that the
/// program was started to ignore, such as SIGINT in the background of a script, stays ignored.
void listen_for_interruption();

/// Was the program asked to stop?
bool is_interrupted() noexcept;

/// Throws Interrupted once the program was asked to stop.
void stop_if_interrupted();

}  // namespace musim::scaling
