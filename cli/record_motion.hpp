#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::cli {

/// A record that shakes a scene, as options --record, --component, --unit and --dt.
struct RecordMotionOptions {
    std::string record;                   ///< file; empty: the scene's own motion stays
    std::vector<std::string> components;  ///< "x=360"
    std::optional<std::string> unit;      ///< of a plain text file
    std::optional<Number> dt;             ///< likewise [s]

    /// Adds the options; `help` says what becomes of the record.
    void add_to(CLI::App& command, const std::string& help);

    /// Lets the record's strong motion shake the scene (lsdem::use_record), and says on stderr what was done. Throws CLI::ValidationError
    /// for a component that is not AXIS=NAME, and as lsdem::use_record.
    void apply(lsdem::Scene& scene) const;
};

}  // namespace musim::cli
