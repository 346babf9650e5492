#pragma once

#include <optional>

#include "records/headers/fixed_columns.hpp"
#include "records/sample_unit.hpp"
#include "scaling/units.hpp"

/// Blocks of even samples below a line that announces them, as CSMIP and USC write them.
namespace musim::records::detail {

/// One block of samples, or rather the line that announces it.
struct BlockHeader {
    std::size_t line = 0;
    std::size_t count = 0;
    scaling::Time dt = {};
    SampleUnit unit = {};
    FixedColumns columns = {};
};

/// True for the line above a block.
bool announces_samples(std::string_view line);

/// Reads the line that announces a block: "32080 Accelerogram points at 100 pts/sec in units of g. Format: (8f9.6)" or
/// " 7500 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)". Throws ReadError when count, step, unit or columns are
/// missing or unusable; the unit may be missing where `usual` is given, which is then taken.
BlockHeader read_block_header(const TextFile& file, std::size_t index, const std::optional<SampleUnit>& usual = std::nullopt);

}  // namespace musim::records::detail
