#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/run/motion_summary.hpp"
#include "lsdem/run/prepare.hpp"
#include "lsdem/run/scene_estimates.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/run/standing.hpp"
#include "lsdem/scene/scene.hpp"

/// Summary of a scene as musim understands it, before it is run.
namespace musim::lsdem {

/// Blocks of one shape and material.
struct BlockKind {
    std::size_t count = 0;
    Vector3 size =
        Vector3::Zero();        ///< edges of the shape, without differences in height; of a solid those of the box around it as drawn [m]
    std::string shape = {};     ///< key of the scene's shapes; empty: a box of this size, or as the scene has it for all
    double mass = 0.0;          ///< of all [kg]
    std::string material = {};  ///< key of the scene's materials; empty: the scene's own
    std::size_t fixed = 0;      ///< of them held in place
};

/// A file that a run leaves, and about how large it will be.
struct OutputSize {
    std::string file;
    double bytes = 0.0;
};

struct SceneSummary {
    std::string name;
    Specimen specimen;  ///< as drawn
    std::vector<BlockKind> kinds;
    int levels = 0;
    double mass = 0.0;                                             ///< of all blocks [kg]
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();         ///< corners of the box around all blocks [m]
    std::vector<std::pair<std::string, BlockMaterial>> materials;  ///< the scene's own first, without a name
    std::optional<Scatter> scatter;
    std::vector<PairEntry> pairs;              ///< of materials that meet in a way of their own
    scaling::Area stiffness_base{};            ///< area of the face that has the stiffnesses
    std::string contact;                       ///< how blocks meet
    std::vector<MotionSummary> motions;        ///< one, or the stages of a sequence
    double time_step = 0.0;                    ///< [s]
    std::optional<double> critical_time_step;  ///< [s]
    PreparationWork preparation;               ///< before the motion, without that between several motions
    std::string preparation_text;
    SceneStanding standing;  ///< where it rests before the motion
    std::vector<SceneEstimate> estimates;
    std::vector<OutputSize> outputs;    ///< of all motions together
    std::vector<std::string> warnings;  ///< where, what, why, what to do

    std::uint64_t steps() const;    ///< of all motions
    std::uint64_t samples() const;  ///< of the spine, with the first of each motion
    std::uint64_t frames() const;   ///< likewise
};

/// Output that earns a warning [bytes]: more than one opens or copies without thinking. Changes what is said only.
inline constexpr double kLargeOutput = 1e9;

/// Builds the model of a scene, plans its run without a step of it, and looks whether it rests where it is drawn (find_standing): 4 s for a
/// tower of 7144 blocks, up to some ten where rigid statics is asked of hundreds. Throws as make_upright_specimen, make_time_plan and
/// plan_sequence.
SceneSummary summarize_scene(const Scene& scene);

/// Time that a run takes on this machine, from steps of the very model.
struct RunTimeEstimate {
    std::uint64_t steps = 0;  ///< measured, from the blocks as drawn, as the motion begins
    double seconds = 0.0;     ///< that they took
    int threads = 1;
    double run = 0.0;                                        ///< all motions at that rate [s]
    double least_preparation = 0.0, most_preparation = 0.0;  ///< likewise, block by block [s]
};

/// Takes steps of a scene's model for about `budget` [s of wall time], the first ones not counted, and reckons with their rate. Blocks that
/// slide and meet others later make a run slower, blocks that have fallen apart faster. It uses `threads` at most.
RunTimeEstimate measure_run_time(const SceneSummary& summary, int threads, double budget = 1.0);

/// Lines for people, a word that says what a line is about first; the run time where it was measured.
std::vector<std::string> describe(const SceneSummary& summary, const std::optional<RunTimeEstimate>& run_time = {});

/// The same in few lines, each group under what it is about.
std::vector<std::pair<std::string, std::vector<std::string>>> describe_briefly(const SceneSummary& summary);

/// One JSON object, in SI units.
nlohmann::json to_json(const SceneSummary& summary, const std::optional<RunTimeEstimate>& run_time = {});

}  // namespace musim::lsdem
