#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "records/formats/detail/parsers.hpp"
#include "tests/fuzz/choose_reader.hpp"

/// Any bytes are a record or a ReadError of one line, whatever the options. MUSIM_READER names the reader that gets them, without asking
/// what they look like; "record", also when it is not set, is read_record's choice among all.
namespace {

using namespace musim::records;

template <GroundMotion (*parse)(const detail::TextFile&, const ReadOptions&)>
GroundMotion read_text_with(const std::string& bytes, const ReadOptions& options) {
    return parse(detail::TextFile("fuzzed", bytes), options);
}

template <GroundMotion (*parse)(const detail::BinaryFile&, const ReadOptions&)>
GroundMotion read_binary_with(const std::string& bytes, const ReadOptions& options) {
    return parse(detail::BinaryFile("fuzzed", bytes), options);
}

GroundMotion read_any(const std::string& bytes, const ReadOptions& options) { return detail::parse_record("fuzzed", bytes, options); }

struct Reader {
    std::string_view name;
    GroundMotion (*read)(const std::string& bytes, const ReadOptions& options);
};

constexpr Reader kReaders[] = {
    {"record", read_any},
    {"afad", read_text_with<detail::parse_afad>},
    {"asa", read_text_with<detail::parse_asa>},
    {"at2", read_text_with<detail::parse_at2>},
    {"bbp", read_text_with<detail::parse_bbp>},
    {"bhrc", read_text_with<detail::parse_bhrc>},
    {"cosmos", read_text_with<detail::parse_cosmos>},
    {"csmip", read_text_with<detail::parse_csmip>},
    {"csmnc", read_text_with<detail::parse_csmnc>},
    {"cwa", read_text_with<detail::parse_cwa>},
    {"deepsoil", read_text_with<detail::parse_deepsoil>},
    {"esm", read_text_with<detail::parse_esm>},
    {"geonet", read_text_with<detail::parse_geonet>},
    {"jma", read_text_with<detail::parse_jma>},
    {"knet", read_text_with<detail::parse_knet>},
    {"miniseed", read_binary_with<detail::parse_miniseed>},
    {"miniseed3", read_binary_with<detail::parse_miniseed3>},
    {"sac", read_binary_with<detail::parse_sac>},
    {"shake", read_text_with<detail::parse_shake>},
    {"slist", read_text_with<detail::parse_slist>},
    {"smc", read_text_with<detail::parse_smc>},
    {"text", read_text_with<detail::parse_text>},
    {"usc", read_text_with<detail::parse_usc>},
};

void read(const Reader& reader, const std::string& bytes, const ReadOptions& options) {
    try {
        if (reader.read(bytes, options).components.empty()) __builtin_trap();
    } catch (const ReadError& error) {
        if (std::string(error.what()).find('\n') != std::string::npos) __builtin_trap();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Reader& reader = musim::tests::choose_reader<Reader>(kReaders, "record");
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    ReadOptions counts, units;
    counts.sensitivity = 1.0;
    units.unit = "g";
    units.dt = 0.01 * musim::scaling::si::seconds;
    for (const ReadOptions& options : {ReadOptions{}, counts, units}) read(reader, bytes, options);
    return 0;
}
