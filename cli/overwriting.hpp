#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <map>
#include <string>

#include "lsdem/results/write_results.hpp"

namespace musim::cli {

/// --force of a command that writes a folder of results, and what its results are made from.
struct OverwritingOption {
    bool force = false;
    const CLI::App* command = nullptr;  ///< that has the option

    /// Adds --force.
    void add_to(CLI::App& app);

    lsdem::Overwriting choice() const { return force ? lsdem::Overwriting::force : lsdem::Overwriting::refuse; }

    /// The command by its name ("bench twins") and this program's version, without scenes and options.
    lsdem::ResultOrigin origin() const;

    /// That and the options given, by their values, but for those that change no result (--out, --threads, --json, ...). `counts`: options
    /// that may have a larger value than that of the results in the directory, which are then a beginning.
    lsdem::ResultOrigin origin_with_options(const std::map<std::string, std::size_t>& counts = {}) const;
};

}  // namespace musim::cli
