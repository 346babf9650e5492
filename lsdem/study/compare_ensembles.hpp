#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsdem/plot/plot.hpp"
#include "lsdem/study/ensemble.hpp"

namespace musim::lsdem {

/// Bands of an ensemble as ensemble.h5 holds them, dimensionless: velocity over √(μ g l), time times √(μ g/l). `base` stays empty.
struct DimensionlessBands {
    std::string name;  ///< of the directory
    int axis = 0;      ///< of the main motion
    Bands bands;
};

/// Reads DIR/ensemble.h5. Throws ResultError when it is missing, damaged, or without friction or gravity to be dimensionless by.
DimensionlessBands read_bands(const std::filesystem::path& directory);

/// Agreement of two ensembles, over all levels and those times of the first at which both have two members.
struct BandOverlap {
    std::size_t points = 0;     ///< levels times times
    double within_sd = 0.0;     ///< fraction of them at which the second's mean lies within mean ± sd of the first
    double within_error = 0.0;  ///< at which the means differ by no more than 2 √(sd₁²/n₁ + sd₂²/n₂): twice the standard error
};

/// Compares along the first's main motion, the second linear between its samples. For two samples of one population and velocities that are
/// normally distributed, within_error is 95 % on average, and less with few members. Throws ResultError when their levels differ or they
/// have no time in common.
BandOverlap compare_bands(const DimensionlessBands& first, const DimensionlessBands& second);

/// Means and bands mean ± sd of ensembles on each other, one row per level of the first, at most ten, along the first's main motion, as
/// Fig. 8 of [Harmon23]; those with other levels are left out.
StackedPlot make_bands_plot(const std::vector<DimensionlessBands>& ensembles);

/// points, within_sd, within_error.
nlohmann::json to_json(const BandOverlap& overlap);

}  // namespace musim::lsdem
