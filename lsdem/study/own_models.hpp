#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/pair.hpp"

/// Models of their own material: what is distortion, and what is chance. See docs/theory/comparison.md, "Own models".
namespace musim::lsdem {

/// The prototype's scene with other seeds of its blocks' heights (the next ones), laid, shaken and held against the prototype: no workshop
/// makes the same heights twice. As many side by side as the threads allow; results do not depend on them. With settings.checkpoint its
/// file is a folder, in which specimens and runs are kept. Throws as lay_specimen does, and SceneError for a scene without heights to draw.
std::vector<RunTrace> run_other_specimens(const Scene& scene, const RunResult& prototype, std::size_t count, const RunSettings& settings);

/// Probability below which a difference of an own model counts as more than chance: that twins, and other specimens, are so far from each
/// other, for one of the quantities that are judged [-]. The usual level: of five specimens a smaller one would ask for six standard
/// deviations.
inline constexpr double kBeyondChance = 0.05;

/// By what own models are judged, and what is said of exact ones: keys of quantities (QuantityCheck), and their names in sentences.
inline constexpr std::pair<const char*, const char*> kReportedQuantities[] = {
    {"peak_velocity", "peak velocity of the top"}, {"residual_displacement", "its residual displacement"}, {"total_loss", "losses"}};

/// One of the quantities an own model is judged by.
struct OwnQuantity {
    std::string name;  ///< "peak velocity of the top"
    QuantityCheck check;
    std::optional<DifferenceRange> of_specimens;  ///< as QuantityCheck::twins; nothing without any
    bool beyond_chance = false;
};

/// An own model.
struct OwnJudgement {
    std::vector<OwnQuantity> quantities;
    /// With a tolerance: all differences are within it, and so are those of twins and other specimens, unless the model is the prototype
    /// to rounding. Nothing without one.
    std::optional<bool> accepted;
};
OwnJudgement judge_own(const PairStudy& study, const PairedRun& model);

/// In words: what is off by how much, and whether that is distortion or chance; and whether it is within the tolerance.
std::string describe_own(const PairStudy& study, const PairedRun& model);

}  // namespace musim::lsdem
