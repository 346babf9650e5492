#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "cli/options.hpp"
#include "lsdem/results/write_results.hpp"

namespace musim::cli {

/// Options that the commands which write a folder of results share: --out, --checkpoint-interval, --force, --threads, --json; and what
/// their results are made from.
struct ResultOptions {
    std::string out;
    Number checkpoint_interval{60.0};  ///< of wall time [s]
    bool force = false;
    int threads = 0;  ///< 0: all cores
    bool json = false;
    const CLI::App* command = nullptr;  ///< that has the options

    /// Adds --out DIR.
    CLI::Option* add_out(CLI::App& app, const std::string& help);

    /// Adds --force, --threads and --json; to commands that leave checkpoints --checkpoint-interval before them.
    void add_to(CLI::App& app);
    void add_with_checkpoints_to(CLI::App& app);

    lsdem::Overwriting choice() const { return force ? lsdem::Overwriting::force : lsdem::Overwriting::refuse; }

    /// The command by its name ("bench twins") and this program's version, without scenes and options.
    lsdem::ResultOrigin origin() const;

    /// That and the options given, by their values, but for those that change no result (--out, --threads, --json, ...). `counts`: options
    /// that may have a larger value than that of the results in the directory, which are then a beginning.
    lsdem::ResultOrigin origin_with_options(const std::map<std::string, std::size_t>& counts = {}) const;

    /// The folder of --out, locked; nothing without --out. Throws lsdem::ResultError as ResultFolder does.
    std::optional<lsdem::ResultFolder> make_folder(lsdem::ResultOrigin origin) const;
};

/// A warning that a checkpoint could not be written.
void note_no_checkpoint(const std::string& why);

}  // namespace musim::cli
