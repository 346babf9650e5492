#pragma once

#include <CLI/App.hpp>
#include <string>

#include "lsdem/response/field_picture.hpp"

namespace musim::cli {

/// Options of looking at the velocity field: --view, --component, --pixels, --csv.
struct FieldOptions {
    std::string side;
    std::string component = "right";
    int pixels = 240;
    bool csv = false;  ///< velocities on the image grid, too

    /// Adds the options; returns --csv, for commands that make films, too.
    CLI::Option* add_to(CLI::App& command);

    /// `axis`: of the motion, which goes from left to right unless --view says otherwise.
    lsdem::CameraSettings camera(int axis) const;
    lsdem::FieldComponent shown() const;
};

}  // namespace musim::cli
