#pragma once

#include <CLI/App.hpp>
#include <string>

#include "records/ground_motion.hpp"

namespace musim::cli {

/// Where a record is written and as what, as options --out, --format, --component.
struct RecordOutputOptions {
    std::string out;
    std::string format;     ///< empty: by the extension of `out`
    std::string component;  ///< the only one that is written; empty: all, of which PEER files hold one

    /// Adds the options to a command; --out is required.
    void add_to(CLI::App& command);

    /// Throws records::WriteError when neither extension nor --format implies the format: checked before anything is computed.
    void check() const;

    /// The motion with nothing but the component that was asked for. Throws records::ReadError when there is none of that name.
    records::GroundMotion select(records::GroundMotion motion) const;

    /// Writes what select() leaves; the file is complete or absent. Throws records::WriteError.
    void write(const records::GroundMotion& motion) const;
};

}  // namespace musim::cli
