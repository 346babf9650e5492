#include <fmt/format.h>

#include "records/error.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/station_xml.hpp"
#include "records/formats/write_record.hpp"

/// Stands in a build without libmseed or pugixml.
namespace musim::records {
namespace {

constexpr const char* kWhatToDo = "build it where Debian's libmseed-dev and libpugixml-dev are, or take another format";

}  // namespace

GroundMotion detail::parse_miniseed(const BinaryFile& file, const ReadOptions& /*options*/) {
    file.fail("is miniSEED, which this build of musim does not read", kWhatToDo);
}

detail::StreamResponse detail::read_stream_response(const std::filesystem::path& path, const StreamCodes& /*codes*/, UtcTime /*first*/,
                                                    UtcTime /*last*/) {
    throw ReadError(fmt::format("{}: is StationXML, which this build of musim does not read", path.string()),
                    Remedy{"give ", Setting::sensitivity, ", or build it where Debian's libpugixml-dev is"});
}

void write_miniseed(const std::filesystem::path& path, const GroundMotion& /*motion*/) {
    throw WriteError(fmt::format("{}: this build of musim does not write miniSEED; {}", path.string(), kWhatToDo));
}

void write_miniseed(const std::filesystem::path& path, const std::vector<SeedStream>& /*streams*/) { write_miniseed(path, GroundMotion{}); }

}  // namespace musim::records
