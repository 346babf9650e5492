#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lsdem/study/pair.hpp"

namespace musim::lsdem {

/// A paired study in one JSON object: runs (prototype, models; summaries with label), pairs (one per model: length, materials, differences,
/// agreement and what it rests on, quantities beside those of the twins, distortions), consistent, agreement and verdict (sentences) of
/// all, twins, horizon_s, end_s, half_step. shadow_rms and shadow_loss_difference are old names of the largest difference of a twin. Layout
/// in docs/user/file_formats.md.
nlohmann::json to_json(const PairStudy& study);

}  // namespace musim::lsdem
