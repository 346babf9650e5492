#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lsdem/results/history.hpp"
#include "lsdem/results/result_error.hpp"

namespace musim::lsdem {

/// A run as a result directory holds it. Without a summary the base's peak acceleration is that at the samples.
struct StoredRun : RunData {
    std::filesystem::path directory;
    std::string divergence;             ///< why it diverged, in one sentence; empty when it did not
    bool at_rest = true;                ///< false: it was to settle before t = 0 and did not
    std::vector<std::string> warnings;  ///< see find_warnings
    std::string scene;                  ///< as JSON text
    std::vector<std::string> gaps;      ///< what could not be read of it, one sentence each; only with Reading::what_there_is
    bool is_status_known = true;        ///< false: summary.json could not be read; `status` is then what the falls say
};

/// Extent to which a run must be there.
enum class Reading {
    whole,         ///< everything that is there must be readable
    what_there_is  ///< blocks and histories; of the rest what can be read, the gaps are listed
};

/// Reads DIR/result.h5 and DIR/summary.json as ResultFolder::add_run writes them. Throws ResultError when one is missing, unreadable, of
/// another layout, or holds no sample; for Reading::what_there_is only when that keeps blocks or histories from being read.
StoredRun read_run(const std::filesystem::path& directory, Reading reading = Reading::whole);

}  // namespace musim::lsdem
