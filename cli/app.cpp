#include "cli/app.hpp"

#include <CLI/CLI.hpp>

#include "cli/usage.hpp"
#include "cli/version.hpp"

namespace musim::cli {

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

void add_commands(CLI::App& app, Action& action) {
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
        "Numbers may be fractions: --length 1/107 --friction 0.63/0.59. `musim COMMAND --help` has examples.");
    add_scale_command(app, action);
    add_rescale_command(app, action);
    add_design_command(app, action);
    add_pi_command(app, action);
    group_commands(app, "Scale a model test", {"scale", "rescale", "design", "pi"});
    add_record_command(app, action);
    add_table_command(app, action);
    group_commands(app, "Prepare a ground motion, check a shake table", {"record", "table"});
    add_new_command(app, action);
    add_check_command(app, action);
    add_calibrate_command(app, action);
    add_specimen_command(app, action);
    group_commands(app, "Describe a structure", {"new", "check", "calibrate", "specimen"});
    add_run_command(app, action);
    add_sequence_command(app, action);
    add_ensemble_command(app, action);
    add_watch_command(app, action);
    group_commands(app, "Shake it", {"run", "sequence", "ensemble", "watch"});
    add_pair_command(app, action);
    group_commands(app, "Compare prototype and models", {"pair"});
    add_report_command(app, action);
    add_response_command(app, action);
    add_field_command(app, action);
    group_commands(app, "See results", {"report", "response", "field"});
    add_bench_command(app, action);
    group_commands(app, "Measure how exact musim is", {"bench"});

    refuse_empty_values(app);
}

}  // namespace musim::cli
