#include "cli/output.hpp"

#include <cerrno>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

namespace musim::cli {

void print_json(const nlohmann::json& object) { print("{}\n", object.dump(2)); }

void flush_output() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw std::runtime_error("standard output: cannot write: " + std::generic_category().message(errno));
    }
}

}  // namespace musim::cli
