#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/usage.hpp"
#include "cli/version.hpp"
#include "scaling/shorten.hpp"

namespace musim::cli {
namespace {

/// Every error is one line on stderr.
int report(const std::string& message, int exit_code) {
    constexpr std::size_t kLongest = 1000;  // letters: whatever a message echoes, a line of it can be read
    std::fprintf(stderr, "musim: error: %s\n", scaling::make_line(scaling::shorten(message, kLongest)).c_str());
    return exit_code;
}

int run(int argc, char** argv) {
    CLI::App app("Similitude toolkit and LS-DEM simulator for towers of dry-stacked blocks", "musim");
    app.set_version_flag("--version", std::string("musim ") + kVersion);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 2 usage, 3 bad input, 4 diverged, 5 a requested check did not hold.\n"
        "Numbers may be fractions: --length 1/107 --friction 0.63/0.59. `musim COMMAND --help` has examples.");
    Action action;
    add_scale_command(app, action);
    add_rescale_command(app, action);
    add_table_command(app, action);
    add_design_command(app, action);
    add_record_command(app, action);
    add_new_command(app, action);
    add_run_command(app, action);
    add_pair_command(app, action);
    add_specimen_command(app, action);
    add_ensemble_command(app, action);
    add_sequence_command(app, action);
    add_bench_command(app, action);
    add_calibrate_command(app, action);
    add_response_command(app, action);
    add_report_command(app, action);
    add_field_command(app, action);
    add_watch_command(app, action);
    add_pi_command(app, action);

    refuse_empty_values(app);

    try {
        app.parse(argc, argv);
        const int exit_code = action();
        if (exit_code == kDone) print_notes();
        flush_output();
        return exit_code;
    } catch (const CLI::Success& help_or_version) {
        return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        return report(describe_usage_error(app, error), kUsageError);
    }
}

}  // namespace
}  // namespace musim::cli

int main(int argc, char** argv) {
    using namespace musim::cli;
    // a file above the limit of its size is an error of writing it
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        return report("not enough memory; try a shorter duration or lower output rates", kInputError);
    } catch (const std::runtime_error& error) {
        return report(error.what(), kInputError);
    } catch (const std::invalid_argument& error) {
        return report(error.what(), kInputError);
    } catch (const std::exception& error) {
        return report(std::string("internal: ") + error.what(), kInternalError);
    }
}
