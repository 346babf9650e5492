#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lsdem/plot/space_view.hpp"
#include "lsdem/results/read_results.hpp"

/// The velocity field of a structure as a camera far in front of it sees it [Andrade22; Harmon23, Figs. 5 to 7 of the experiments].
namespace musim::lsdem {

/// Where the camera stands: on the side of +x, -x, +y or -y of the structure, looking at it horizontally.
enum class CameraSide { plus_x, minus_x, plus_y, minus_y };

/// The side from which motion along an axis goes from left to right: minus_y for x, plus_x for y.
CameraSide find_side_facing(int axis);

/// Which part of the velocity is shown: to the right, upward, or its magnitude in the image plane.
enum class FieldComponent { right, up, speed };

/// An image: what is seen in every pixel, row by row from the lower left. Orthographic.
struct CameraImage {
    double time = 0.0;                ///< of the frame [s]
    double left = 0.0, bottom = 0.0;  ///< of the lower left corner, in the image plane: along the camera's right, and z [m]
    double pixel = 0.0;               ///< edge length of a pixel [m]
    std::size_t columns = 0, rows = 0;
    std::vector<int> block = {};  ///< seen there; -1: none
};

struct CameraSettings {
    CameraSide side = CameraSide::minus_y;
    std::size_t columns = 240;  ///< pixels across the image, which holds the structure at its start with a margin of 5 %
};

/// Directions of an image.
SpaceView look_from(CameraSide side);

/// Blocks of a run as they lie in a frame.
class FrameBlocks {
  public:
    explicit FrameBlocks(const StoredRun& run);

    /// Solids of all blocks, in their order.
    std::vector<PlacedSolid> place(std::size_t frame) const;

  private:
    const StoredRun& run_;
    std::vector<std::shared_ptr<const BlockShape>> shapes_;
};

/// Throws ResultError when the run has kept no frames.
void require_frames(const StoredRun& run);

/// Number of the frame nearest to a time. Throws as require_frames() does, and ResultError for a time without a frame near: half an
/// interval before the first one or behind the last.
std::size_t find_frame(const StoredRun& run, double time);

/// Looks at a frame: every pixel takes the nearest block that a ray through its middle meets.
CameraImage take_picture(const StoredRun& run, std::size_t frame, const CameraSettings& settings);

/// Velocity of a block in a frame, in the image plane [m/s].
double find_velocity(const StoredRun& run, std::size_t frame, std::size_t block, CameraSide side, FieldComponent component);

/// column,row,right_m,z_m,block,level,v_right_m_s,v_up_m_s: one line per pixel in which a block is seen.
std::string make_field_csv(const StoredRun& run, std::size_t frame, const CameraImage& image, CameraSide side);

}  // namespace musim::lsdem
