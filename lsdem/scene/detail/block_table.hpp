#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/detail/json_text.hpp"

/// Blocks in a table: text with a block a line, as spreadsheets write it.
namespace musim::lsdem::detail {

/// A row of a table as an entry of "blocks" would be.
struct BlockRow {
    std::size_t line = 0;  ///< of the file, from 1
    Json entry;
};

/// Reads a table of blocks. Its first line names the columns: x, y, z; size_x, size_y, size_z; qw, qx, qy, qz or turn (about z); shape,
/// material, density, name, fixed, with_base, rotation_locked. Cells are separated by commas, semicolons or tabs, whichever the first line
/// has; they may be in double quotes; an empty one is left out. Lines that are empty or begin with # are passed over. Units stand in the
/// first line, `x [mm]`, or are `unit`, for lengths. Throws SceneError, `file:line: column "x": what (why); what to do`.
std::vector<BlockRow> read_block_table(const std::filesystem::path& file, const std::optional<std::string>& unit);

}  // namespace musim::lsdem::detail
