#pragma once

#include <CLI/App.hpp>
#include <string>

#include "lsdem/study/write_results.hpp"

namespace musim::cli {

/// --force of a command that writes a folder of results, and what its results are made from.
struct OverwritingOption {
    bool force = false;
    const CLI::App* command = nullptr;  ///< that has the option

    /// Adds --force.
    void add_to(CLI::App& app);

    lsdem::study::Overwriting choice() const { return force ? lsdem::study::Overwriting::force : lsdem::study::Overwriting::refuse; }

    /// The command by its name ("bench twins") and this program's version, without scenes and options.
    lsdem::study::ResultOrigin origin() const;

    /// That and the options given, but for those that change no result (--out, --threads, --json, ...).
    lsdem::study::ResultOrigin origin_with_options() const;
};

}  // namespace musim::cli
