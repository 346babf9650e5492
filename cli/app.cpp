#include "cli/app.hpp"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <vector>

#include "cli/usage.hpp"
#include "cli/version.hpp"

namespace musim::cli {
namespace {

struct Command {
    std::string name;
    void (*add)(CLI::App& app, Action& action);
};

struct Group {
    std::string title;
    std::vector<Command> commands;
};

std::vector<Group> list_groups() {
    return {{"Scale a model test",
             {{"scale", add_scale_command}, {"rescale", add_rescale_command}, {"design", add_design_command}, {"pi", add_pi_command}}},
            {"Prepare a ground motion, check a shake table", {{"record", add_record_command}, {"table", add_table_command}}},
            {"Describe a structure",
             {{"new", add_new_command},
              {"check", add_check_command},
              {"calibrate", add_calibrate_command},
              {"specimen", add_specimen_command}}},
            {"Shake it, tilt it",
             {{"run", add_run_command},
              {"sequence", add_sequence_command},
              {"ensemble", add_ensemble_command},
              {"tilt", add_tilt_command},
              {"watch", add_watch_command}}},
            {"Compare prototype and models", {{"pair", add_pair_command}}},
            {"See results",
             {{"report", add_report_command},
              {"response", add_response_command},
              {"field", add_field_command},
              {"export", add_export_command}}},
            {"Measure how exact musim is", {{"bench", add_bench_command}}}};
}

}  // namespace

std::string describe_program() {
    return R"(musim: similitude, records, shake tables and simulation of dry-stacked blocks

  scale a model test             musim scale --length 1/107 --friction 0.63/0.59
  measure and process a record   musim record info STATION.v1
  see what a shake table can do  musim table STATION.v1 --limits TABLE.json --length 1/25
  begin a scene, and check it    musim new tower -o tower.json && musim check tower.json -o preview.svg
  run it, and see the results    musim run tower.json -o out/tower && musim report out/tower -o tower.html
  compare prototype and models   musim pair SCENE.json --length 1/107 -o out/pair

A structure of your own under a record of your own: musim new tower --record STATION.v1 -o tower.json
All commands: musim --help. One of them, with examples: musim COMMAND --help.
)";
}

void add_commands(CLI::App& app, Action& action, std::string_view only) {
    app.name("musim");
    app.description("Similitude toolkit and LS-DEM simulator for towers of dry-stacked blocks");
    app.set_version_flag("--version", std::string("musim ") + kVersion);
    app.require_subcommand(1);
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    app.footer(
        "Exit codes:\n"
        "  0         done\n"
        "  1         a mistake of musim's own\n"
        "  2         usage: the command line alone shows that it is wrong\n"
        "  3         bad input: files, names or values that cannot be used; results that cannot be written\n"
        "  4         numerical failure: a run diverged\n"
        "  5         a requested check did not hold\n"
        "  6         a model of its own material differs by more than --accept\n"
        "  130, 143  stopped by SIGINT (Ctrl-C) or SIGTERM\n"
        "Numbers may be fractions: --length 1/107 --friction 0.63/0.59. Whole numbers are decimal: 010 is ten.\n"
        "`musim COMMAND --help` has examples.");
    const std::vector<Group> groups = list_groups();
    const auto is_wanted = [only](const Command& command) { return command.name == only; };
    const bool all = std::none_of(groups.begin(), groups.end(),
                                  [&](const Group& group) { return std::any_of(group.commands.begin(), group.commands.end(), is_wanted); });
    for (const Group& group : groups) {
        for (const Command& command : group.commands) {
            if (!all && !is_wanted(command)) continue;
            command.add(app, action);
            app.get_subcommand(command.name)->group(group.title);
        }
    }
    refuse_empty_values(app);
}

}  // namespace musim::cli
