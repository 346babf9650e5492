#pragma once

#include <string>
#include <vector>

#include "lsdem/study/pair.hpp"

namespace musim::lsdem::study {

/// What a pair shows, in sentences for people who run shake tables, the verdict first: whether models agree with the prototype, up to when
/// in detail, by how much peaks, residual displacements and losses are apart beside those of the twins, and what was not checked.
std::vector<std::string> describe_verdict(const PairStudy& study);

}  // namespace musim::lsdem::study
