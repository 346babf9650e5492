#include "lsdem/response/camera_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace musim::lsdem {
namespace {

constexpr double kViewMargin = 0.05;  ///< around the structure, of its larger side

}  // namespace

SpaceView look_from(CameraSide side) {
    Vector3 toward = Vector3::Zero();
    toward[side == CameraSide::plus_x || side == CameraSide::minus_x ? 0 : 1] =
        side == CameraSide::plus_x || side == CameraSide::plus_y ? 1.0 : -1.0;
    return {.right = Vector3::UnitZ().cross(toward), .up = Vector3::UnitZ(), .toward = toward};
}

FrameBlocks::FrameBlocks(const StoredRun& run) : run_(run), shapes_(list_drawn_shapes(run.blocks.shapes, run.blocks.size)) {}

std::vector<PlacedSolid> FrameBlocks::place(std::size_t frame) const {
    std::vector<PlacedSolid> solids;
    for (std::size_t b = 0; b < shapes_.size(); ++b) {
        const std::size_t at = frame * shapes_.size() + b;
        const Eigen::Vector4d q = run_.frames.quaternion[at].cast<double>();
        solids.push_back({&shapes_[b]->solid,
                          {Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(), run_.frames.position[at].cast<double>()}});
    }
    return solids;
}

CameraSide find_side_facing(int axis) { return axis == 1 ? CameraSide::plus_x : CameraSide::minus_y; }

void require_frames(const StoredRun& run) {
    if (!run.frames.time.empty()) return;
    throw ResultError(
        fmt::format("{}: the run has kept no frames (its scene has no output.frame_rate); give one, e.g. \"frame_rate\": "
                    "\"100 Hz\", and run it again",
                    (run.directory / "result.h5").string()));
}

std::size_t find_frame(const StoredRun& run, double time) {
    require_frames(run);
    const double first = run.frames.time.front(), last = run.frames.time.back();
    // half an interval beyond the ends is still nearest to a frame
    const double reach = run.frames.time.size() > 1 ? 0.5 * (run.frames.time[1] - first) : 0.0;
    if (!(first - reach <= time && time <= last + reach)) {
        throw ResultError(fmt::format("{}: there is no frame at {:.6g} s (frames are from {:.6g} to {:.6g} s); name a time between them",
                                      run.directory.string(), time, first, last));
    }
    const auto nearest = std::min_element(run.frames.time.begin(), run.frames.time.end(),
                                          [&](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
    return static_cast<std::size_t>(nearest - run.frames.time.begin());
}

CameraImage take_picture(const StoredRun& run, std::size_t frame, const CameraSettings& settings) {
    const SpaceView view = look_from(settings.side);
    const FrameBlocks blocks(run);

    // the image holds the structure as it was in the first frame
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ViewBounds bounds{kFar, -kFar, kFar, -kFar};
    for (const PlacedSolid& block : blocks.place(0)) bounds = unite(bounds, find_bounds(*block.solid, block.place, view));
    const double margin = kViewMargin * std::max(bounds.width(), bounds.height());
    CameraImage image{.time = run.frames.time[frame],
                      .left = bounds.left - margin,
                      .bottom = bounds.bottom - margin,
                      .pixel = (bounds.width() + 2.0 * margin) / static_cast<double>(settings.columns),
                      .columns = settings.columns,
                      .rows = 0};
    image.rows = static_cast<std::size_t>(std::ceil((bounds.height() + 2.0 * margin) / image.pixel));

    const std::vector<SeenFace> faces = list_faces(blocks.place(frame), view);
    const PointGrid middles{.left = image.left + 0.5 * image.pixel,
                            .bottom = image.bottom + 0.5 * image.pixel,
                            .spacing = image.pixel,
                            .columns = image.columns,
                            .rows = image.rows};
    for (const std::size_t face : find_nearest_faces(faces, middles)) {
        image.block.push_back(face == kNoFace ? -1 : static_cast<int>(faces[face].body));
    }
    return image;
}

double find_velocity(const StoredRun& run, std::size_t frame, std::size_t block, CameraSide side, FieldComponent component) {
    const Vector3 v = run.frames.velocity[frame * run.blocks.size.size() + block].cast<double>();
    const double right = v.dot(look_from(side).right);
    switch (component) {
        case FieldComponent::right:
            return right;
        case FieldComponent::up:
            return v.z();
        case FieldComponent::speed:
            break;
    }
    return std::hypot(right, v.z());
}

std::string make_field_csv(const StoredRun& run, std::size_t frame, const CameraImage& image, CameraSide side) {
    std::string csv = "column,row,right_m,z_m,block,level,v_right_m_s,v_up_m_s\n";
    for (std::size_t at = 0; at < image.block.size(); ++at) {
        if (image.block[at] < 0) continue;
        const auto block = static_cast<std::size_t>(image.block[at]);
        const std::size_t column = at % image.columns, row = at / image.columns;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{}\n", column, row,
                       image.left + (static_cast<double>(column) + 0.5) * image.pixel,
                       image.bottom + (static_cast<double>(row) + 0.5) * image.pixel, block, run.blocks.layer[block],
                       find_velocity(run, frame, block, side, FieldComponent::right),
                       find_velocity(run, frame, block, side, FieldComponent::up));
    }
    return csv;
}

}  // namespace musim::lsdem
