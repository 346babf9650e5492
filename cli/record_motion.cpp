#include "cli/record_motion.hpp"

#include <CLI/CLI.hpp>

#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "lsdem/run/use_record.hpp"

namespace musim::cli {
namespace {

/// "x=360 y=90" as names along the axes.
lsdem::AxisComponents parse_components(const std::vector<std::string>& texts) {
    lsdem::AxisComponents components;
    for (const std::string& text : texts) {
        const std::size_t axis = text.size() > 2 && text[1] == '=' ? std::string("xyz").find(text[0]) : std::string::npos;
        if (axis == std::string::npos) throw CLI::ValidationError("--component", "'" + text + "' is not AXIS=NAME, e.g. x=360");
        components[axis] = text.substr(2);
    }
    return components;
}

}  // namespace

void RecordMotionOptions::add_to(CLI::App& command, const std::string& help) {
    CLI::Option* option = command.add_option("--record", record, help)->type_name("FILE");
    command.add_option("--component", components, "Component along an axis, e.g. x=360 (default: the strongest horizontal along x)")
        ->type_name("AXIS=NAME")
        ->needs(option);
    add_text_record_options(command, unit, dt);
    command.get_option("--unit")->needs(option);
    command.get_option("--dt")->needs(option);
}

void RecordMotionOptions::apply(lsdem::Scene& scene) const {
    const std::optional<scaling::Time> step = dt ? std::optional(dt->value * scaling::si::seconds) : std::nullopt;
    const std::vector<std::string> steps = lsdem::use_record(scene, record, parse_components(components), unit, step);
    for (const std::string& line : steps) note("{}: {}\n", record, line);
}

}  // namespace musim::cli
