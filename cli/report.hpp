#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsdem/study/summary.hpp"
#include "scaling/distortion.hpp"
#include "scaling/similitude.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

namespace study = lsdem::study;

/// Named factors as one JSON object.
nlohmann::json to_json(const std::vector<scaling::NamedFactor>& factors);

/// A table of factors under a title.
scaling::TextTable make_factors_table(const std::string& title, const std::vector<scaling::NamedFactor>& factors);

/// One line per distortion, or that there is none; and the same on stdout.
std::vector<std::string> describe_distortions(const std::vector<scaling::Distortion>& distortions);
void print_distortions(const std::vector<scaling::Distortion>& distortions);

/// If the run diverged, says so on stderr in one line with block, time and the step that would work, and returns true.
bool report_divergence(const std::string& where, const lsdem::study::RunResult& run);

/// One line on stderr, `musim: warning: ...`, for everything doubtful about a run that reached its end.
void report_doubts(const std::string& where, const lsdem::study::RunResult& run);

}  // namespace musim::cli
