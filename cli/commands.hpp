#pragma once

#include <CLI/App.hpp>
#include <functional>

/// The command line program: the only part of musim that prints.
namespace musim::cli {

/// Exit codes of the program.
enum ExitCode : int {
    kDone = 0,
    kInternalError = 1,     ///< a mistake of ours
    kUsageError = 2,        ///< the command line alone shows that it is wrong
    kInputError = 3,        ///< unusable file, values that do not go together, results that cannot be written
    kNumericalFailure = 4,  ///< a run diverged
    kCheckFailed = 5,       ///< a requested check did not hold
    kNotAccepted = 6,       ///< a model of its own material differs by more than was to be accepted
};

/// Work that the parsed command line asks for; returns an exit code, throws what the libraries throw.
using Action = std::function<int()>;

/// Each adds one subcommand to `app`; when it is parsed, `action` is set to carry it out.
void add_scale_command(CLI::App& app, Action& action);
void add_rescale_command(CLI::App& app, Action& action);
void add_table_command(CLI::App& app, Action& action);
void add_design_command(CLI::App& app, Action& action);
void add_record_command(CLI::App& app, Action& action);
void add_record_plot_command(CLI::App& record, Action& action);      ///< to the command `record`
void add_record_match_command(CLI::App& record, Action& action);     ///< to the command `record`
void add_record_make_command(CLI::App& record, Action& action);      ///< to the command `record`
void add_record_process_command(CLI::App& record, Action& action);   ///< to the command `record`
void add_record_spectrum_command(CLI::App& record, Action& action);  ///< to the command `record`
void add_new_command(CLI::App& app, Action& action);
void add_check_command(CLI::App& app, Action& action);
void add_run_command(CLI::App& app, Action& action);
void add_pair_command(CLI::App& app, Action& action);
void add_specimen_command(CLI::App& app, Action& action);
void add_ensemble_command(CLI::App& app, Action& action);
void add_sequence_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
void add_bench_similitude_command(CLI::App& bench, Action& action);  ///< to the command `bench`
void add_bench_twins_command(CLI::App& bench, Action& action);       ///< to the command `bench`
void add_bench_verdict_command(CLI::App& bench, Action& action);     ///< to the command `bench`
void add_calibrate_command(CLI::App& app, Action& action);
void add_response_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_field_command(CLI::App& app, Action& action);
void add_export_command(CLI::App& app, Action& action);
void add_tilt_command(CLI::App& app, Action& action);
void add_watch_command(CLI::App& app, Action& action);
void add_pi_command(CLI::App& app, Action& action);

}  // namespace musim::cli
