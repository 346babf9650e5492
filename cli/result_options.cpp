#include "cli/result_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <string_view>
#include <utility>

#include "cli/output.hpp"
#include "cli/version.hpp"
#include "cli/whole_option.hpp"
#include "scaling/error.hpp"
#include "scaling/number.hpp"

namespace musim::cli {
namespace {

/// Options that change no result.
constexpr std::array<std::string_view, 7> kIdleOptions{"help", "out", "threads", "json", "force", "checkpoint-interval", "format"};

std::string name_command(const CLI::App& command) {
    const CLI::App* above = command.get_parent();
    return above == nullptr || above->get_parent() == nullptr ? command.get_name() : name_command(*above) + " " + command.get_name();
}

/// The value of an option as text, the same for 1/25 and 0.04, for mu=1/2 and mu=0.5, for 10 and 010.
std::string name_value(const CLI::Option& option, const std::string& text) {
    const std::string type = option.get_type_name();
    if (type == "N") return std::to_string(parse_whole(text, {}));
    if (type.find("NUMBER") == std::string::npos && type != "LIST") return text;
    const std::size_t begin = text.find('=') + 1;  // 0 without one
    try {
        return text.substr(0, begin) + fmt::format("{}", scaling::parse_number(text.substr(begin)));
    } catch (const scaling::ParseError&) {
        return text;  // a name, or with an uncertainty
    }
}

}  // namespace

CLI::Option* ResultOptions::add_out(CLI::App& app, const std::string& help) {
    return app.add_option("-o,--out", out, help)->type_name("DIR");
}

void ResultOptions::add_to(CLI::App& app) {
    command = &app;
    app.add_flag("--force", force, "Replace results in the directory that are of another scene, version or options");
    add_threads_option(app, threads);
    add_json_option(app, json);
}

void ResultOptions::add_with_checkpoints_to(CLI::App& app) {
    add_checkpoint_interval_option(app, checkpoint_interval);
    add_to(app);
}

std::optional<lsdem::ResultFolder> ResultOptions::make_folder(lsdem::ResultOrigin origin) const {
    if (out.empty()) return std::nullopt;
    return std::optional<lsdem::ResultFolder>(std::in_place, out, std::move(origin), choice());
}

lsdem::ResultOrigin ResultOptions::origin() const { return {.command = name_command(*command), .program_version = kVersion, .parts = {}}; }

lsdem::ResultOrigin ResultOptions::origin_with_options(const std::map<std::string, std::size_t>& counts) const {
    lsdem::ResultOrigin origin = this->origin();
    origin.counts = counts;
    for (const CLI::Option* option : command->get_options()) {
        const std::string name = option->get_single_name();
        const bool idle = std::find(kIdleOptions.begin(), kIdleOptions.end(), name) != kIdleOptions.end();
        if (idle || option->count() == 0 || option->get_positional() || counts.contains("--" + name)) continue;
        std::string& text = origin.parts["--" + name];
        for (const std::string& value : option->results()) text += (text.empty() ? "" : " ") + name_value(*option, value);
    }
    return origin;
}

void note_no_checkpoint(const std::string& why) { note("musim: warning: no checkpoint: {}\n", why); }

}  // namespace musim::cli
