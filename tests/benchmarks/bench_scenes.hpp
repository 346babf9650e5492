#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lsdem/model.hpp"

namespace musim::benchmarks {

/// A model to time, ready to run at 0.8 of its critical step.
struct BenchScene {
    std::string name;
    std::function<lsdem::Model()> make;
    double settle = 0.0;       ///< model time before the clock starts [s]
    double block_steps = 2e6;  ///< of one repetition: some tenths of a second of work
};

/// All named scenes, wood at 1:107 [Harmon23]; the tower has 38 layers of 188 blocks.
///   single_block, column     one block, 38 blocks on each other
///   tower                    every interface in contact and sticking
///   tower_sliding            every interface slides, layer against layer
///   towers_28k, towers_200k  4 and 28 such towers in a row
/// Scenes of a benchmark. What a scene does not need, against tower_shaken (three components, 10 Hz, up to 1 g: contacts stick, slide and
/// part):
///   shaken_one_component, shaken_no_friction, shaken_elastic (e = 1), shaken_no_rotation
///   tower_nodes              contact by the leader's 44 nodes a face in place of overlap; sticking
///   tower_grid               blocks as grid level sets, voxel 0.65 mm; sticking
///   drums, drums_shaken      ten drums of 24 flats on each other: the exact function
///   arch, arch_hit           a half circle of 27 voussoirs; sticking, and each with a velocity of its own
///   column_at_rest             38 blocks that stand, on a base that stands: passed over
///   column_waiting           the same, computed
///   debris                   7144 blocks that fall freely, apart
std::vector<BenchScene> make_bench_scenes();

}  // namespace musim::benchmarks
