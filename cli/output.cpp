#include "cli/output.hpp"

#include <cerrno>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <system_error>

#include "records/error.hpp"

namespace musim::cli {
namespace {

/// Remarks of all threads, in an order that does not depend on them.
class Notes {
  public:
    void add(std::string line) {
        const std::lock_guard lock(mutex_);
        lines_.insert(std::move(line));
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        lines_.clear();
    }
    const std::set<std::string>& lines() const { return lines_; }

  private:
    std::mutex mutex_;
    std::set<std::string> lines_;
};

Notes& notes() {
    static Notes kept;
    return kept;
}

}  // namespace

void write_text(std::FILE* stream, std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); }

void note_at_end(std::string line) { notes().add(std::move(line)); }

void forget_notes() { notes().clear(); }

void print_notes() {
    for (const std::string& line : notes().lines()) note("{}\n", line);
}

void print_json(const nlohmann::json& object) { print("{}\n", object.dump(2)); }

void flush_output() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw records::WriteError("standard output: cannot write: " + std::generic_category().message(errno));
    }
}

}  // namespace musim::cli
