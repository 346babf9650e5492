#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <string>

#ifdef MUSIM_SANITIZED
#include <sanitizer/common_interface_defs.h>
#endif

namespace musim::tests {

/// Sends what this process prints to two files while the object is there; what a sanitizer finds goes where it went before.
class RedirectedOutput {
  public:
    RedirectedOutput(const std::string& out, const std::string& err) : out_(STDOUT_FILENO, out), err_(STDERR_FILENO, err) {
#ifdef MUSIM_SANITIZED
        __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(err_.before())));  // NOLINT(performance-no-int-to-ptr)
#endif
    }
    RedirectedOutput(const RedirectedOutput&) = delete;
    RedirectedOutput& operator=(const RedirectedOutput&) = delete;
    ~RedirectedOutput() {
#ifdef MUSIM_SANITIZED
        __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(STDERR_FILENO)));  // NOLINT(performance-no-int-to-ptr)
#endif
    }

  private:
    /// A descriptor that is another file's for a while.
    class Descriptor {
      public:
        Descriptor(int descriptor, const std::string& file) : descriptor_(descriptor), before_(fcntl(descriptor, F_DUPFD_CLOEXEC, 0)) {
            flush();
            const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
            if (before_ == -1 || opened == -1 || dup2(opened, descriptor_) == -1) throw std::runtime_error("cannot redirect to " + file);
            close(opened);
        }
        Descriptor(const Descriptor&) = delete;
        Descriptor& operator=(const Descriptor&) = delete;
        ~Descriptor() {
            flush();
            dup2(before_, descriptor_);
            close(before_);
        }
        int before() const { return before_; }

      private:
        static void flush() {
            std::cout.flush();
            std::fflush(nullptr);
        }

        int descriptor_, before_;
    };

    Descriptor out_, err_;
};

}  // namespace musim::tests
