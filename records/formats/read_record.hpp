#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "records/formats/column_choice.hpp"
#include "records/ground_motion.hpp"

namespace musim::records {

/// Options for what a file may leave unsaid. A file that says it itself is believed: an option that contradicts it is refused with a
/// ReadError.
struct ReadOptions {
    std::optional<scaling::Time> dt = {};  ///< time step of files without one
    std::optional<std::string> unit = {};  ///< unit of samples of files without one, e.g. "g", "cm/s^2"; default m/s^2, m/s or m
    /// quantity of files without one (default acceleration), which channel codes of miniSEED only suggest; of CSMIP V2: which block to take
    std::optional<SampleQuantity> quantity = {};
    std::optional<double> sensitivity = {};                 ///< of miniSEED, SLIST, TSPAIR [counts per m/s^2, m/s or m]; 1: SI
    std::optional<std::filesystem::path> station_xml = {};  ///< StationXML file that gives the sensitivity of miniSEED
    std::optional<ColumnChoices> columns = {};              ///< of plain text files: which column is what
    std::optional<std::size_t> skipped_lines = {};          ///< lines at the beginning of a text file that are not read
};

/// Reads a record; its content, not its name, decides the format: PEER AT2/VT2/DT2, CSMIP/CGS V1 and V2, COSMOS, USGS SMC, K-NET and
/// KiK-net, JMA, ESM, GeoNet, AFAD, ASA 2.0, CWA, CSMNC, USC, RENADIC, BHRC, SCEC BBP, SAC, miniSEED 2 and 3, SLIST, TSPAIR, DEEPSOIL,
/// SHAKE's columns, musim CSV, plain text columns; or one of them packed in a .gz or .zip file.
///
/// Samples come back in SI, g = 9.80665 m/s². Nothing is filtered, shifted or padded. Of several quantities in a file options.quantity
/// chooses one (default acceleration). Uncorrected records get an integration corner. How a text was read stands in the history.
/// Throws ReadError `path:line: what (why); what to do` for a file that is missing, unreadable, empty, truncated, damaged, of a format that
/// is recognised but not supported (named in the message) or unknown, and for options that contradict the file.
GroundMotion read_record(const std::filesystem::path& path, const ReadOptions& options = {});

/// Stands in the history of a text record whose unit nobody gave.
inline constexpr const char* kUnitNotGiven = " (no unit given)";

/// Begins a line of the history that says what of a text record is left out, or read otherwise than its titles say.
inline constexpr const char* kReadingNote = "note: ";

}  // namespace musim::records
