#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/prepare.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Everything that a prepared specimen follows from, as JSON text: structure, shapes, materials, ground, gravity, contact and step of the
/// scene, and how it is prepared; not its name, motion, duration or output. Equal texts make equal specimens, bit for bit.
std::string describe_inputs(const Scene& scene, const PreparationSettings& preparation);

/// Name of the file of a specimen made from `inputs`: "specimen-", the name of the text (detail::name_content), ".h5".
std::string specimen_file_name(const std::string& inputs);

/// Writes a specimen as HDF5, all or nothing; layout in docs/user/file_formats.md. Throws records::WriteError.
void write_specimen(const std::filesystem::path& file, const PreparedSpecimen& prepared, const std::string& inputs,
                    const std::string& version);

/// State of the blocks and contacts in a specimen file.
struct StoredSpecimen {
    std::string inputs;           ///< see describe_inputs
    std::string program_version;  ///< that made it
    std::vector<Vector3> size;    ///< edge lengths in the body frame [m]
    std::vector<int> layer;       ///< from 1 at the base; 0: in no layer
    BlockShapes shapes;           ///< of blocks that are no boxes
    Kinematics places;            ///< poses only
    std::vector<double> tilt;     ///< of each block's own z axis from the vertical [rad]
    /// Blocks that fell while it was prepared (find_fallen); nothing in files of versions before it was kept.
    std::optional<std::size_t> fallen;
    std::vector<double> force;  ///< vertical, of each contact of a layer with the one below or the ground, over a block's weight [-]
};

/// Throws ResultError for a file that is no specimen, or a damaged one.
StoredSpecimen read_specimen(const std::filesystem::path& file);

/// The inputs that a specimen file was made from. Throws ResultError when it is none.
std::string read_specimen_inputs(const std::filesystem::path& file);

/// Puts the blocks of `specimen` where they stand in the file, which may be of another scale: places are multiplied by the ratio of the
/// first blocks' heights. Throws ResultError for a file that is no specimen, or one of other blocks: their number, layers, or edge
/// lengths to within 1e-9 of themselves.
void take_places(const std::filesystem::path& file, Specimen& specimen);

}  // namespace musim::lsdem
