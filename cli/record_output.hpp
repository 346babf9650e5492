#pragma once

#include <CLI/App.hpp>
#include <string>

#include "records/ground_motion.hpp"

namespace musim::cli {

/// Where a record is written and as what, as options --out, --format, --component.
struct RecordOutputOptions {
    std::string out;
    std::string format;     ///< empty: by the extension of `out`
    std::string component;  ///< for formats that hold one

    /// Adds the options to a command; --out is required.
    void add_to(CLI::App& command);

    /// Throws records::WriteError when neither extension nor --format tell the format: asked before anything is computed.
    void check() const;

    /// Writes the file; it is complete or absent. Throws records::WriteError.
    void write(const records::GroundMotion& motion) const;
};

}  // namespace musim::cli
