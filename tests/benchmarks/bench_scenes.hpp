#pragma once

#include <string>
#include <vector>

#include "lsdem/model.hpp"

namespace musim::benchmarks {

/// A model to time, ready to run at 0.8 of its critical step.
struct BenchScene {
    std::string name;
    lsdem::Model model;
};

/// All named scenes, wood at 1:107 [Harmon23]:
///   single_block        one block at rest
///   column              38 blocks on each other
///   full_tower          38 x 188 blocks, all layers in contact, sticking
///   full_tower_sliding  the same, every second layer sliding over its neighbors
std::vector<BenchScene> make_bench_scenes();

}  // namespace musim::benchmarks
