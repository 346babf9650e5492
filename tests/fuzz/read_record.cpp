#include <cstddef>
#include <cstdint>
#include <string>

#include "records/detail/parsers.hpp"

/// Any bytes are a record or a ReadError of one line, whatever the options.
namespace {

using musim::records::ReadOptions;

void read(const std::string& bytes, const ReadOptions& options) {
    try {
        const musim::records::GroundMotion motion = musim::records::detail::parse_record("fuzzed", bytes, options);
        if (motion.components.empty()) __builtin_trap();
    } catch (const musim::records::ReadError& error) {
        if (std::string(error.what()).find('\n') != std::string::npos) __builtin_trap();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    ReadOptions counts, units;
    counts.sensitivity = 1.0;
    units.unit = "g";
    units.dt = 0.01 * musim::scaling::si::seconds;
    for (const ReadOptions& options : {ReadOptions{}, counts, units}) read(bytes, options);
    return 0;
}
