#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "records/sample_unit.hpp"
#include "scaling/units.hpp"

namespace musim::records {

/// What a file may leave unsaid. A file that says it itself is believed: an option that contradicts it is refused with a ReadError.
struct ReadOptions {
    std::optional<scaling::Time> dt = {};  ///< time step of files without one
    std::optional<std::string> unit = {};  ///< unit of samples of files without one, e.g. "g", "cm/s^2"; default m/s^2, m/s or m
    std::optional<SampleQuantity> quantity =
        {};                                  ///< quantity of files without one (default acceleration); of CSMIP V2: which block to take
    std::optional<double> sensitivity = {};  ///< of miniSEED [counts per m/s^2, m/s or m]; 1: samples are SI
    std::optional<std::filesystem::path> station_xml = {};  ///< StationXML file that gives the sensitivity of miniSEED
};

}  // namespace musim::records
