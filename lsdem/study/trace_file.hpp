#pragma once

#include <filesystem>
#include <optional>

#include "lsdem/study/verdict.hpp"

namespace musim::lsdem {

/// Keeps what is compared of a run as JSON: format, diverged, image, running, quantities. The file appears whole or not at all. Throws
/// records::WriteError.
void write_trace(const std::filesystem::path& file, const RunTrace& trace);

/// Reads it back, to the same bits; nothing when there is none, or none that is whole.
std::optional<RunTrace> read_trace(const std::filesystem::path& file);

}  // namespace musim::lsdem
