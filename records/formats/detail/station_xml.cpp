#include "records/formats/detail/station_xml.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>

#include <cmath>
#include <string>

#include "records/detail/text.hpp"
#include "records/headers/header_fields.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {
namespace {

// "2012-04-13T17:28:00.25Z", fraction and Z optional; nothing otherwise
std::optional<UtcTime> parse_iso_time(std::string text) {
    constexpr std::size_t kTime = 11, kLetters = 19;  // of "yyyy-mm-ddT", of "yyyy-mm-ddThh:mm:ss"
    if (text.size() < kLetters || text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':' || text[16] != ':' ||
        text.find_first_of(" _-", kTime) != std::string::npos) {
        return std::nullopt;
    }
    text[4] = text[7] = '/';
    text[10] = ' ';
    if (text.ends_with('Z')) text.pop_back();
    return parse_date_time(text);
}

// an epoch without an end, or without a readable one, is open
bool covers(const pugi::xml_node& channel, UtcTime first, UtcTime last) {
    const auto start = parse_iso_time(channel.attribute("startDate").value());
    const auto end = parse_iso_time(channel.attribute("endDate").value());
    return start && *start <= first && (!end || last <= *end);
}

bool has_location(const pugi::xml_node& channel, std::string_view location) {
    const std::string_view code = trim(channel.attribute("locationCode").value());
    return (code == "--" ? std::string_view{} : code) == location;
}

/// Text of a child element without blanks at its ends. A comment in it is left out; child_value() would end there.
std::string text_of(const pugi::xml_node& parent, const char* child) {
    std::string text;
    for (const pugi::xml_node& piece : parent.child(child).children()) {
        if (piece.type() == pugi::node_pcdata || piece.type() == pugi::node_cdata) text += piece.value();
    }
    return std::string(trim(text));
}

pugi::xml_node find_epoch(const BinaryFile& file, const pugi::xml_node& root, const StreamCodes& codes, UtcTime first, UtcTime last) {
    pugi::xml_node found;
    bool has_other_epochs = false;
    for (const pugi::xml_node& network : root.children("Network")) {
        if (codes.network != network.attribute("code").value()) continue;
        for (const pugi::xml_node& station : network.children("Station")) {
            if (codes.station != station.attribute("code").value()) continue;
            for (const pugi::xml_node& channel : station.children("Channel")) {
                if (codes.channel != channel.attribute("code").value() || !has_location(channel, codes.location)) continue;
                if (!covers(channel, first, last)) {
                    has_other_epochs = true;
                    continue;
                }
                if (found) {
                    file.fail(fmt::format("two epochs of {} cover the record (their sensitivities may differ)", to_string(codes)),
                              Remedy{"give ", Setting::sensitivity});
                }
                found = channel;
            }
        }
    }
    if (!found) {
        file.fail(fmt::format("no response of {} ({})", to_string(codes),
                              has_other_epochs ? "its epochs do not cover the record's time" : "channel is not in the file"),
                  "fetch the StationXML of this station and time");
    }
    return found;
}

}  // namespace

StreamResponse read_stream_response(const std::filesystem::path& path, const StreamCodes& codes, UtcTime first, UtcTime last) {
    const BinaryFile file(path, read_bytes(path));
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(file.bytes().data(), file.bytes().size());
    if (!result) {
        file.fail(fmt::format("is no XML (byte {}: {})", result.offset, result.description()), "name a StationXML file");
    }
    const pugi::xml_node root = document.child("FDSNStationXML");
    if (!root) file.fail("is no StationXML (no FDSNStationXML element)", "name a StationXML file");

    const pugi::xml_node channel = find_epoch(file, root, codes, first, last);
    const pugi::xml_node sensitivity = channel.child("Response").child("InstrumentSensitivity");
    const std::string name = to_string(codes);
    const std::string value_text = text_of(sensitivity, "Value");
    const std::optional<double> value = parse_real(value_text);
    if (!value || *value == 0.0) {
        file.fail(fmt::format("sensitivity of {} is {} (must be a number, not 0)", name, detail::quoted(value_text)),
                  "fetch the StationXML at level=response");
    }
    const std::string input = text_of(sensitivity.child("InputUnits"), "Name");
    const std::optional<SampleUnit> unit = find_sample_unit(input);
    if (!unit) {
        file.fail(fmt::format("{} senses {} (known: {})", name, detail::quoted(input), all_sample_unit_names()), "read another channel");
    }
    const std::string output = text_of(sensitivity.child("OutputUnits"), "Name");
    if (!equal_ignoring_case(output, "counts") && !equal_ignoring_case(output, "count")) {
        file.fail(fmt::format("{} gives out {} (must be counts)", name, detail::quoted(output)), Remedy{"give ", Setting::sensitivity});
    }

    StreamResponse response{.quantity = unit->quantity, .sensitivity = *value / unit->si};
    const std::optional<double> dip = parse_real(text_of(channel, "Dip"));
    constexpr double kVertical = 90.0;  // [deg]
    if (dip && std::abs(*dip) != kVertical) response.azimuth_deg = parse_real(text_of(channel, "Azimuth"));
    return response;
}

}  // namespace musim::records::detail
