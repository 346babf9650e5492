#include "cli/records/record_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/records/record_peaks.hpp"
#include "records/error.hpp"
#include "records/formats/write_record.hpp"

namespace musim::cli {
namespace {

/// A format by its name in --format, and how files of it end.
struct NamedFormat {
    std::string_view name;
    std::array<std::string_view, 4> extensions;  ///< the rest empty
};

constexpr NamedFormat kFormats[] = {
    {"csv", {"csv"}}, {"at2", {"at2", "vt2", "dt2"}}, {"cosmos", {"v1", "v2", "v1c", "v2c"}}, {"mseed", {"mseed", "msd", "miniseed"}}};

/// From --format or else from the extension.
std::string_view find_format(const RecordOutputOptions& options) {
    const std::string wanted = options.format.empty() ? find_extension(options.out) : to_lower_case(options.format);
    for (const NamedFormat& format : kFormats) {
        const bool known =
            !wanted.empty() && std::find(format.extensions.begin(), format.extensions.end(), wanted) != format.extensions.end();
        if (known || wanted == format.name) return format.name;
    }
    throw CLI::ValidationError(
        options.format.empty() ? "--out" : "--format",
        fmt::format("\"{}\" implies no format; {}csv, at2, cosmos or mseed", options.format.empty() ? options.out : options.format,
                    options.format.empty() ? "add --format " : "write "));
}

/// PEER files have an extension for each quantity of translations, by which others take them for that.
void refuse_wrong_extension(const std::string& file, const records::Component& component) {
    constexpr std::array<std::pair<records::SampleQuantity, std::string_view>, 3> kExtensions{
        {{records::SampleQuantity::acceleration, "at2"},
         {records::SampleQuantity::velocity, "vt2"},
         {records::SampleQuantity::displacement, "dt2"}}};
    records::refuse_rotation(file, component, "PEER files");
    const std::string extension = find_extension(file);
    for (const auto& [quantity, own] : kExtensions) {
        if (quantity == component.series.quantity() || extension != own) continue;
        const auto right = std::find_if(kExtensions.begin(), kExtensions.end(),
                                        [&](const auto& each) { return each.first == component.series.quantity(); });
        throw records::WriteError(fmt::format("{}: .{} means {}, and component {} is {}; name a .{} file", file, own,
                                              records::to_string(quantity), component.name, records::to_string(right->first),
                                              right->second));
    }
}

/// miniSEED has no room for how a record is integrated.
void note_lost_corner(const std::string& file, const records::GroundMotion& motion) {
    const std::optional<scaling::Frequency>& corner = motion.integration_corner;
    if (corner && corner->value() == records::kUncorrectedCornerHz) return;
    note_at_end(
        fmt::format("musim: note: {}: miniSEED cannot say how the record is integrated ({}): PGV and PGD of the file are those after a "
                    "high-pass at {:g} Hz; write .csv, .v2 or .at2 to keep it",
                    file, describe_integration(corner), records::kUncorrectedCornerHz));
}

}  // namespace

void RecordOutputOptions::add_to(CLI::App& command) {
    command.add_option("-o,--out", out, "File to write: .csv, .v2 (COSMOS) or .mseed (all components), .at2, .vt2 or .dt2 (PEER, one)")
        ->required()
        ->type_name("OUT");
    command.add_option("--format", format, "csv, at2, cosmos or mseed, where the extension implies none")->type_name("FORMAT");
    command.add_option("--component", component, "The only component to write, e.g. 360; PEER files hold one")->type_name("NAME");
}

void RecordOutputOptions::check() const { find_format(*this); }

records::GroundMotion RecordOutputOptions::select(records::GroundMotion motion) const {
    if (!component.empty()) motion.components = {motion.find_component(component)};
    return motion;
}

void RecordOutputOptions::write(const records::GroundMotion& all) const {
    const std::string_view name = find_format(*this);
    const records::GroundMotion motion = select(all);
    if (name == "csv") return records::write_csv(out, motion);
    if (name == "cosmos") return records::write_cosmos(out, motion);
    if (name == "mseed") {
        records::write_miniseed(out, motion);
        return note_lost_corner(out, motion);
    }
    if (motion.components.size() > 1) {
        throw records::WriteError(out + ": a PEER file holds one component; choose one with --component (" + motion.component_names() +
                                  ")");
    }
    refuse_wrong_extension(out, motion.components.front());
    records::write_at2(out, motion, motion.components.front().name);
}

}  // namespace musim::cli
