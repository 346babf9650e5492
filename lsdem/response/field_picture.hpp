#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/response/camera_view.hpp"

/// Pictures of the velocity field, as the papers' Figs. 5 and 7.
namespace musim::lsdem {

/// One frame as the camera saw it.
struct FieldView {
    std::size_t frame = 0;
    CameraImage image;
};

/// Choice of what a picture of the field shows.
struct FieldPicture {
    CameraSide side = CameraSide::minus_y;
    FieldComponent component = FieldComponent::right;
    double limit = 0.0;  ///< where the colours end [m/s]; equal limits make pictures comparable
    std::string name;    ///< of the run, under the title
};

/// Looks at the frames nearest to the times, at each once. Throws ResultError when the run has kept none, scaling::Interrupted when the
/// program is asked to stop.
std::vector<FieldView> take_views(const StoredRun& run, const std::vector<double>& times, const CameraSettings& settings);

/// Largest magnitude of a component that some view shows [m/s].
double find_field_limit(const StoredRun& run, const std::vector<FieldView>& views, CameraSide side, FieldComponent component);

/// The blocks that are seen, in the colour of their velocity, one panel for each view, in rows where there are many, with one colour bar.
/// Title, axes and a line below the title name the component by the world's axis, the side of the camera, and what velocities are relative
/// to: the fixed axes of the scene (the ground at rest), as stored. Signed components get a diverging map, white at rest, the speed a
/// sequential one. There is one view at least.
std::string make_field_svg(const StoredRun& run, const std::vector<FieldView>& views, const FieldPicture& picture);

}  // namespace musim::lsdem
