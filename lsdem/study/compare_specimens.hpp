#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsdem/run/prepare.hpp"

namespace musim::lsdem {

/// Two samples of one quantity beside each other, in its unit. Standard deviations are those of the populations, √(Σ (x − mean)²/(n − 1)).
struct TwoSamples {
    double first_mean = 0.0, first_sd = 0.0;
    double second_mean = 0.0, second_sd = 0.0;
    /// With what probability two samples of one population differ in their means by as much or more [-]: Welch's t, which does not ask for
    /// equal scatter [Welch47].
    double mean_probability = 0.0;
    /// The same of their scatter: Welch's t of the distances from the own median, which is robust where the quantity is not normally
    /// distributed [BrownForsythe74].
    double scatter_probability = 0.0;
};

/// Compares two samples. Means and deviations of too few members, and probabilities then, are NaN; of two samples without any scatter the
/// probability is 1 when they are the same, else 0.
TwoSamples compare_samples(const std::vector<double>& first, const std::vector<double>& second);

/// A specimen as `musim specimen --json` reported it.
struct ListedSpecimen {
    std::uint64_t seed = 0;
    std::size_t fallen = 0;          ///< blocks that fell while it was prepared
    double block_steps = 0.0;        ///< what it cost, see PreparedSpecimen
    std::vector<LayerState> layers;  ///< from 1 at the base
};

/// Specimens that were prepared in one way.
struct SpecimenSet {
    std::string name;  ///< of the file
    std::vector<ListedSpecimen> specimens = {};

    std::size_t fallen() const;  ///< blocks, of all specimens
    double block_steps() const;  ///< mean over the specimens; NaN without any
};

/// Reads what `musim specimen --json` printed. Throws ResultError when the file is missing, is something else, has no specimen,
/// specimens with different numbers of layers or one seed twice, or of one that was there before and so reported nothing of its layers.
SpecimenSet read_specimen_set(const std::filesystem::path& file);

/// One quantity of both sets, over a group of layers.
struct QuantityComparison {
    TwoSamples samples;
    /// Second less first for the same seeds: the same blocks in the same places, when both sets are of one scene.
    std::size_t pairs = 0;
    double pair_difference = 0.0;  ///< mean over the pairs; NaN without
    double pair_error = 0.0;       ///< its standard error; NaN with fewer than two
};

/// Means over layers `first` to `last` of what describes a layer, see LayerState.
struct LayerComparison {
    int first = 1, last = 1;
    QuantityComparison tilt;           ///< of the layers' blocks, mean [rad]
    QuantityComparison largest_tilt;   ///< of a layer [rad]
    QuantityComparison force_scatter;  ///< standard deviation of the normal forces below a layer [N]
};

/// Compares two sets layer by layer: groups of layers 2-4, 5-9, 10-14 and so on; layer 1 stands on flat ground. Are specimens prepared in
/// two ways samples of one population? Throws ResultError when their numbers of layers differ.
std::vector<LayerComparison> compare_specimens(const SpecimenSet& first, const SpecimenSet& second);

/// Tilts in degrees, forces in newtons, probabilities; null where there were too few.
nlohmann::json to_json(const LayerComparison& comparison);

}  // namespace musim::lsdem
