#include "cli/overwriting.hpp"

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <string_view>

#include "cli/version.hpp"

namespace musim::cli {
namespace {

/// Options that change no result.
constexpr std::array<std::string_view, 7> kIdleOptions{"help", "out", "threads", "json", "force", "checkpoint-interval", "format"};

std::string name_command(const CLI::App& command) {
    const CLI::App* above = command.get_parent();
    return above == nullptr || above->get_parent() == nullptr ? command.get_name() : name_command(*above) + " " + command.get_name();
}

}  // namespace

void OverwritingOption::add_to(CLI::App& app) {
    command = &app;
    app.add_flag("--force", force, "Replace results in the directory that are of another scene, version or options");
}

lsdem::study::ResultOrigin OverwritingOption::origin() const {
    return {.command = name_command(*command), .program_version = kVersion, .parts = {}};
}

lsdem::study::ResultOrigin OverwritingOption::origin_with_options() const {
    lsdem::study::ResultOrigin origin = this->origin();
    for (const CLI::Option* option : command->get_options()) {
        const std::string name = option->get_single_name();
        const bool idle = std::find(kIdleOptions.begin(), kIdleOptions.end(), name) != kIdleOptions.end();
        if (idle || option->count() == 0 || option->get_positional()) continue;
        std::string& text = origin.parts["--" + name];
        for (const std::string& value : option->results()) text += (text.empty() ? "" : " ") + value;
    }
    return origin;
}

}  // namespace musim::cli
