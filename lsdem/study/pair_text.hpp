#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsdem/study/pair.hpp"

namespace musim::lsdem {

/// Results of a pair, in sentences for people who run shake tables, the verdict first: whether models agree with the prototype, up to when
/// in detail, by how much peaks, residual displacements and losses are apart beside those of the twins, and what was not checked.
std::vector<std::string> describe_verdict(const PairStudy& study);

/// A paired study in one JSON object: runs (prototype, models; summaries with label), pairs (one per model: length, materials, differences,
/// agreement and what it rests on, quantities beside those of the twins, distortions), consistent, agreement and verdict (sentences) of
/// all, twins, horizon_s, end_s, half_step. Layout in docs/user/file_formats.md.
nlohmann::json to_json(const PairStudy& study);

/// A part of one in percent, two digits: "3.4 %"; "less than 1e-07 %" for what is rounding.
std::string format_percent(double part);
/// "up to 3.4 %", or "less than 1e-07 %".
std::string format_up_to(double part);
/// "-1.9 % to +15 %", "0 %" for an end that is rounding; as format_percent when both are.
std::string format_range(const DifferenceRange& range);
/// "a, b and c".
std::string join_words(const std::vector<std::string>& words);

}  // namespace musim::lsdem
