#pragma once

namespace musim::cli {

/// Checks a --damping: throws records::ProcessingError as records::require_damping() does, and above 2, where percent were meant.
void require_damping_ratio(double damping);

}  // namespace musim::cli
