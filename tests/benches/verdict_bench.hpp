#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/model_errors.hpp"
#include "lsdem/study/pair.hpp"
#include "lsdem/study/twin_runs.hpp"
#include "lsdem/study/verdict.hpp"

/// Number of models that are judged wrongly (run_pair): exact ones that are called different, and wrong ones that are not.
namespace musim::lsdem {

/// Runs of every scene.
struct VerdictBenchPlan {
    std::uint64_t seed = 1;          ///< of the first set of twins; lengths of models and wrong models follow from it
    std::size_t sets = 4;            ///< of twins, independent of each other
    std::size_t twins = kMostTwins;  ///< of a set
    std::size_t models = 10;         ///< exact models, judged by each set
    std::vector<ModelError> errors = {};
    std::vector<double> sizes = {1e-8, 1e-7, 1e-6};  ///< of the errors [-]
    std::size_t images = 20;                         ///< wrong models of each error and size
};

/// One model as it was judged.
struct JudgedModel {
    double length = 1.0;  ///< λ_l
    Agreement agreement = Agreement::not_judged;
    double lead = 0.0, lead_time = 0.0, probability = 1.0;  ///< see Judgement
};

/// Exact models of one set of twins.
struct JudgedSet {
    std::uint64_t seed = 0;
    double horizon = 0.0;                           ///< [s]
    std::optional<Yardstick::ImageLead> of_images;  ///< of its twins
    std::vector<JudgedModel> models;
};

/// Wrong models of one error and size.
struct JudgedError {
    ModelError error = ModelError::normal_stiffness;
    double size = 0.0;
    /// The error in one model, and judged by right twins.
    std::vector<JudgedModel> alone;
    /// The error in models and in images among the twins, not in copies: `agreement` is that of the whole (PairStudy::agreement, without
    /// the image at a quarter of the length), `lead` that of the images over the copies.
    std::vector<JudgedModel> shared;
};

/// Results of a scene.
struct VerdictBench {
    std::string scene;
    std::vector<JudgedSet> sets;
    std::vector<JudgedError> errors;
};

/// Lays the specimen of a scene once, and runs and judges. Runs that are kept in the folder are not run again. Throws as lay_specimen and
/// Simulation do, SceneError for a scene with a list of motions, records::WriteError.
VerdictBench run_verdict_bench(const Scene& scene, const VerdictBenchPlan& plan, const TwinSettings& settings = {});

/// Number of models, and of those among them that are called so.
struct Tally {
    std::size_t count = 0, of = 0;
    double low = 0.0, high = 1.0;  ///< Clopper and Pearson's limits of their share, 95 % [ClopperPearson34]
};
Tally tally(const std::vector<JudgedModel>& models, Agreement agreement);
/// Tally of exact models over scenes.
Tally tally_exact(const std::vector<VerdictBench>& benches, Agreement agreement);

/// The size of an error that is found in 95 of 100 models: from the line of leads over log10 of the size, and the scatter about it [-].
struct FoundSize {
    double size = 0.0;
    double low = 0.0, high = 0.0;  ///< 95 %
};
/// Size that is found of one error, over its sizes; nothing where leads do not grow with the size. `models`: JudgedError::alone or shared.
std::optional<FoundSize> find_size(const VerdictBench& bench, ModelError error, std::vector<JudgedModel> JudgedError::*models);

}  // namespace musim::lsdem
