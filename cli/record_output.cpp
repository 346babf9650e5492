#include "cli/record_output.hpp"

#include <algorithm>
#include <cctype>
#include <CLI/CLI.hpp>
#include <filesystem>

#include "records/error.hpp"
#include "records/write_record.hpp"

namespace musim::cli {
namespace {

/// "at2" or "csv", from --format or else from the extension.
std::string find_format(const RecordOutputOptions& options) {
    std::string format = options.format.empty() ? std::filesystem::path(options.out).extension().string() : options.format;
    if (format.starts_with('.')) format.erase(0, 1);
    std::transform(format.begin(), format.end(), format.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (format == "vt2" || format == "dt2") format = "at2";
    if (format != "at2" && format != "csv") {
        throw records::WriteError(options.out + ": the format is not told by the extension; add --format at2 or --format csv");
    }
    return format;
}

}  // namespace

void RecordOutputOptions::add_to(CLI::App& command) {
    command.add_option("-o,--out", out, "File to write: .csv (all components) or .at2 (one)")->required()->type_name("OUT");
    command.add_option("--format", format, "at2 or csv, when the extension does not tell")->type_name("FORMAT");
    command.add_option("--component", component, "Component for a .at2 file, e.g. 360")->type_name("NAME");
}

void RecordOutputOptions::check() const { find_format(*this); }

void RecordOutputOptions::write(const records::GroundMotion& motion) const {
    if (find_format(*this) == "csv") {
        records::write_csv(out, motion);
        return;
    }
    if (component.empty() && motion.components.size() > 1) {
        throw records::WriteError(out + ": a PEER file holds one component; choose one with --component (" + motion.component_names() +
                                  ")");
    }
    records::write_at2(out, motion, component.empty() ? motion.components.front().name : component);
}

}  // namespace musim::cli
