#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/block_shapes.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/types.hpp"

/// Blocks and their motion for other programs: glTF, OBJ, STL.
namespace musim::lsdem {

/// A block where it is shown when nothing moves.
struct ExportedBlock {
    std::string name;
    std::string material;  ///< key of the scene's materials; empty: the scene's own
    std::shared_ptr<const BlockShape> shape;
    double mass = 0.0;  ///< [kg]
    int layer = 0;      ///< from 1 at the base; 0: in no layer
    Vector3 position = Vector3::Zero();
    Quaternion orientation = Quaternion::Identity();
};

/// Blocks of a scene as drawn, or of a run; world frame, z up, in m, kg and s.
struct ExportedBlocks {
    std::string name;  ///< of the scene
    std::vector<ExportedBlock> blocks;
    Frames frames;                   ///< of a run; empty: nothing moves
    scaling::Similitude similitude;  ///< of the run to its prototype
};

/// The blocks of a scene as drawn.
ExportedBlocks list_blocks(const Specimen& specimen, const std::string& name);

/// The blocks of a run, with its frames where it has kept any; shown as they are at the start, or in the frame nearest to `time` [s].
/// Throws ResultError as find_frame does for a time.
ExportedBlocks list_blocks(const StoredRun& run, std::optional<double> time = {});

}  // namespace musim::lsdem
