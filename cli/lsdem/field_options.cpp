#include "cli/lsdem/field_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/options.hpp"
#include "cli/whole_option.hpp"

namespace musim::cli {

CLI::Option* FieldOptions::add_to(CLI::App& command) {
    command.add_option("--view", side, "Side on which the camera stands (default: the motion goes from left to right)")
        ->check(one_of({"+x", "-x", "+y", "-y"}));
    command.add_option("--component", component, "Velocity that gives the colour")
        ->capture_default_str()
        ->check(one_of({"right", "up", "speed"}));
    add_whole_option(command, "--pixels", pixels, "Columns of the image grid", {8, 4000})->capture_default_str();
    return command.add_flag("--csv", csv,
                            "Also the velocities that each picture shows, a line per point of the image grid: some 14 MB for a picture of "
                            "240 columns");
}

lsdem::CameraSettings FieldOptions::camera(int axis) const {
    lsdem::CameraSettings camera{.side = lsdem::find_side_facing(axis), .columns = static_cast<std::size_t>(pixels)};
    if (side == "+x") camera.side = lsdem::CameraSide::plus_x;
    if (side == "-x") camera.side = lsdem::CameraSide::minus_x;
    if (side == "+y") camera.side = lsdem::CameraSide::plus_y;
    if (side == "-y") camera.side = lsdem::CameraSide::minus_y;
    return camera;
}

lsdem::FieldComponent FieldOptions::shown() const {
    if (component == "up") return lsdem::FieldComponent::up;
    return component == "speed" ? lsdem::FieldComponent::speed : lsdem::FieldComponent::right;
}

}  // namespace musim::cli
