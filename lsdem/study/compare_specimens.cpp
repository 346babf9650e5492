#include "lsdem/study/compare_specimens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "lsdem/results/result_error.hpp"
#include "lsdem/study/sample_moments.hpp"
#include "scaling/angle.hpp"
#include "scaling/regular_file.hpp"
#include "scaling/setting.hpp"

namespace musim::lsdem {
namespace {

/// Probability, on both sides, of Welch's t = (mean₁ − mean₂)/√(s₁²/n₁ + s₂²/n₂), with as many degrees of freedom as Welch and
/// Satterthwaite give it.
double find_probability(const SampleMoments& first, const SampleMoments& second) {
    if (first.count() < 2 || second.count() < 2) return std::numeric_limits<double>::quiet_NaN();
    const auto squared_error = [](const SampleMoments& moments) { return moments.sd()[0] * moments.sd()[0] / moments.count(); };
    const double one = squared_error(first), two = squared_error(second), both = one + two;
    const double difference = std::abs(first.mean()[0] - second.mean()[0]);
    if (!(both > 0.0)) return difference > 0.0 ? 0.0 : 1.0;
    const double freedom = both * both / (one * one / (first.count() - 1) + two * two / (second.count() - 1));
    const boost::math::students_t_distribution<double> distribution(freedom);
    return 2.0 * boost::math::cdf(boost::math::complement(distribution, difference / std::sqrt(both)));
}

std::vector<double> distances_from_median(std::vector<double> sample) {
    if (sample.empty()) return sample;
    std::sort(sample.begin(), sample.end());
    const std::size_t middle = sample.size() / 2;
    const double median = sample.size() % 2 == 1 ? sample[middle] : 0.5 * (sample[middle - 1] + sample[middle]);
    for (double& value : sample) value = std::abs(value - median);
    return sample;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    throw ResultError(fmt::format("{}: {}", file.string(), what));
}

[[noreturn]] void refuse_other(const std::filesystem::path& file, const std::string& what) {
    throw ResultError(fmt::format("{}: {}", file.string(), what), Remedy{"name ", Setting::specimen_list});
}

ListedSpecimen read_specimen_entry(const nlohmann::json& entry, const std::filesystem::path& file) {
    ListedSpecimen specimen;
    specimen.seed = entry.at("seed").get<std::uint64_t>();
    if (entry.at("reused").get<bool>()) {
        refuse(file, fmt::format(
                         "the specimen of seed {} was there before, so nothing was reported of its layers; prepare it into an empty folder",
                         specimen.seed));
    }
    specimen.fallen = entry.at("fallen").get<std::size_t>();
    specimen.block_steps = entry.at("block_steps").get<double>();
    for (const nlohmann::json& layer : entry.at("layers")) {
        specimen.layers.push_back({.mean_tilt = layer.at("mean_tilt_deg").get<double>() / scaling::kDegrees,
                                   .max_tilt = layer.at("max_tilt_deg").get<double>() / scaling::kDegrees,
                                   .mean_force = layer.at("mean_force_N").get<double>(),
                                   .sd_force = layer.at("sd_force_N").get<double>()});
    }
    return specimen;
}

/// Mean of one quantity of a layer over a group of layers, for every specimen.
class GroupMeans {
  public:
    GroupMeans(int first, int last, double LayerState::*quantity) : first_(first), last_(last), quantity_(quantity) {}

    double of(const ListedSpecimen& specimen) const {
        double sum = 0.0;
        for (int layer = first_; layer <= last_; ++layer) sum += specimen.layers[static_cast<std::size_t>(layer - 1)].*quantity_;
        return sum / (last_ - first_ + 1);
    }
    std::vector<double> of(const SpecimenSet& set) const {
        std::vector<double> means;
        for (const ListedSpecimen& specimen : set.specimens) means.push_back(of(specimen));
        return means;
    }

  private:
    int first_, last_;
    double LayerState::*quantity_;
};

QuantityComparison compare(const GroupMeans& means, const SpecimenSet& first, const SpecimenSet& second) {
    std::vector<double> apart;
    for (const ListedSpecimen& one : first.specimens) {
        for (const ListedSpecimen& other : second.specimens) {
            if (one.seed == other.seed) apart.push_back(means.of(other) - means.of(one));
        }
    }
    const SampleMoments differences = moments_of(apart);
    return {.samples = compare_samples(means.of(first), means.of(second)),
            .pairs = static_cast<std::size_t>(differences.count()),
            .pair_difference = differences.mean()[0],
            .pair_error = differences.sd()[0] / std::sqrt(static_cast<double>(differences.count()))};
}

nlohmann::json describe_quantity(const QuantityComparison& quantity, double unit) {
    const TwoSamples& samples = quantity.samples;
    return {{"first_mean", samples.first_mean * unit},
            {"first_sd", samples.first_sd * unit},
            {"second_mean", samples.second_mean * unit},
            {"second_sd", samples.second_sd * unit},
            {"mean_probability", samples.mean_probability},
            {"scatter_probability", samples.scatter_probability},
            {"pairs", quantity.pairs},
            {"pair_difference", quantity.pair_difference * unit},
            {"pair_error", quantity.pair_error * unit}};
}

}  // namespace

TwoSamples compare_samples(const std::vector<double>& first, const std::vector<double>& second) {
    const SampleMoments one = moments_of(first), two = moments_of(second);
    return {.first_mean = one.mean()[0],
            .first_sd = one.sd()[0],
            .second_mean = two.mean()[0],
            .second_sd = two.sd()[0],
            .mean_probability = find_probability(one, two),
            .scatter_probability = find_probability(moments_of(distances_from_median(first)), moments_of(distances_from_median(second)))};
}

std::size_t SpecimenSet::fallen() const {
    std::size_t sum = 0;
    for (const ListedSpecimen& specimen : specimens) sum += specimen.fallen;
    return sum;
}

double SpecimenSet::block_steps() const {
    std::vector<double> steps;
    for (const ListedSpecimen& specimen : specimens) steps.push_back(specimen.block_steps);
    return moments_of(steps).mean()[0];
}

SpecimenSet read_specimen_set(const std::filesystem::path& file) {
    SpecimenSet set{.name = file.string()};
    std::ifstream in = scaling::open_regular_file(file);
    if (!in) refuse_other(file, "cannot be opened");
    try {
        const nlohmann::json given = nlohmann::json::parse(in);
        for (const nlohmann::json& entry : given.at("specimens")) set.specimens.push_back(read_specimen_entry(entry, file));
    } catch (const nlohmann::json::exception&) {
        refuse_other(file, "is no list of specimens (another file, or one cut off)");
    }
    if (set.specimens.empty()) refuse(file, "has no specimen; prepare some");
    std::set<std::uint64_t> seeds;
    for (const ListedSpecimen& specimen : set.specimens) {
        if (specimen.layers.size() != set.specimens.front().layers.size() || specimen.layers.empty()) {
            refuse(file,
                   fmt::format("the specimen of seed {} has {} layers, that of seed {} {} (of different structures, or without layers); "
                               "compare specimens of one scene",
                               specimen.seed, specimen.layers.size(), set.specimens.front().seed, set.specimens.front().layers.size()));
        }
        if (!seeds.insert(specimen.seed).second) refuse(file, fmt::format("has seed {} twice; name every seed once", specimen.seed));
    }
    return set;
}

std::vector<LayerComparison> compare_specimens(const SpecimenSet& first, const SpecimenSet& second) {
    const auto layers = static_cast<int>(first.specimens.front().layers.size());
    const auto others = static_cast<int>(second.specimens.front().layers.size());
    if (layers != others) {
        refuse(second.name,
               fmt::format("{} layers where {} has {} (another structure); compare specimens of one scene", others, first.name, layers));
    }
    std::vector<LayerComparison> comparisons;
    for (int from = std::min(2, layers); from <= layers; from = from / 5 * 5 + 5) {
        const int to = std::min(from / 5 * 5 + 4, layers);
        const auto of = [&](double LayerState::*quantity) { return compare(GroupMeans(from, to, quantity), first, second); };
        comparisons.push_back({.first = from,
                               .last = to,
                               .tilt = of(&LayerState::mean_tilt),
                               .largest_tilt = of(&LayerState::max_tilt),
                               .force_scatter = of(&LayerState::sd_force)});
    }
    return comparisons;
}

nlohmann::json to_json(const LayerComparison& comparison) {
    return {{"layers", {comparison.first, comparison.last}},
            {"mean_tilt_deg", describe_quantity(comparison.tilt, scaling::kDegrees)},
            {"max_tilt_deg", describe_quantity(comparison.largest_tilt, scaling::kDegrees)},
            {"sd_force_N", describe_quantity(comparison.force_scatter, 1.0)}};
}

}  // namespace musim::lsdem
