#include "lsdem/study/second_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/results/scene_files.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/factor_rounding.hpp"

namespace musim::lsdem {
namespace {

using nlohmann::ordered_json;

/// Number of differences that a sentence names.
constexpr std::size_t kNamedDifferences = 4;

double height_of(const Specimen& specimen, std::size_t block) {
    return 2.0 * half_extents(specimen.model, specimen.model.blocks[block]).z();
}

double find_median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Distances from the median.
std::vector<double> find_deviations(const std::vector<double>& values) {
    const double median = find_median(values);
    std::vector<double> deviations;
    for (const double value : values) deviations.push_back(std::abs(value - median));
    return deviations;
}

/// Median distance of the heights from their median, over it: the scatter of most blocks, whatever a few others are [-].
double find_scatter(const std::vector<double>& heights) { return find_median(find_deviations(heights)) / find_median(heights); }

bool are_heights_drawn_anew(const Specimen& first, const Specimen& second) {
    std::vector<double> of_first, of_second, ratios;
    for (std::size_t i = 0; i < first.model.blocks.size(); ++i) {
        of_first.push_back(height_of(first, i));
        of_second.push_back(height_of(second, i));
        ratios.push_back(of_second.back() / of_first.back());
    }
    const double least = std::max(kDrawnHeight, kDrawnScatter * std::max(find_scatter(of_first), find_scatter(of_second)));
    const std::vector<double> changes = find_deviations(ratios);
    const auto changed = std::count_if(changes.begin(), changes.end(), [&](double change) { return change > least; });
    return 2 * static_cast<std::size_t>(changed) > ratios.size();
}

/// Are two values without parts the same, numbers to rounding?
bool are_same(const ordered_json& a, const ordered_json& b) {
    if (!a.is_number() || !b.is_number()) return a == b;
    const auto x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= scaling::kFactorRounding * std::max(std::abs(x), std::abs(y));
}

/// Does it say what a pair takes from its first scene, or nothing that is computed with?
bool is_left_out(const std::string& key) {
    return key.ends_with("/name") || key.starts_with("/output") || key.starts_with("/sensors") || key == "/time/duration";
}

/// Goes through two values side by side. A part that one of them does not have is one difference.
void add_differences(const std::string& key, const ordered_json& first, const ordered_json& second, std::vector<SceneDifference>& all) {
    const bool parts = first.is_structured() && first.type() == second.type();
    if (is_left_out(key) || (!parts && are_same(first, second))) return;
    if (!parts) {
        const auto text_of = [](const ordered_json& value) { return value.is_null() ? "" : value.dump(); };
        all.push_back({key, text_of(first), text_of(second)});
        return;
    }
    if (first.is_array()) {
        for (std::size_t i = 0; i < std::max(first.size(), second.size()); ++i) {
            add_differences(fmt::format("{}/{}", key, i), i < first.size() ? first[i] : ordered_json(),
                            i < second.size() ? second[i] : ordered_json(), all);
        }
        return;
    }
    for (const auto& [name, value] : first.items()) {
        add_differences(key + "/" + name, value, second.contains(name) ? second[name] : ordered_json(), all);
    }
    for (const auto& [name, value] : second.items()) {
        if (!first.contains(name)) add_differences(key + "/" + name, ordered_json(), value, all);
    }
}

ordered_json read_back(const Scene& scene) { return ordered_json::parse(write_scene(scene)); }

}  // namespace

std::optional<std::string> find_other_blocks(const Specimen& first, const Specimen& second) {
    const std::size_t blocks = first.model.blocks.size();
    if (second.model.blocks.size() != blocks) return fmt::format("it has {} blocks, not {}", second.model.blocks.size(), blocks);
    for (std::size_t i = 0; i < blocks; ++i) {
        const Block &a = first.model.blocks[i], &b = second.model.blocks[i];
        const Vector3 half = half_extents(first.model, a), of_second = half_extents(second.model, b);
        const double near = kSameBlock * 2.0 * std::cbrt(half.prod());
        if (2.0 * (of_second - half).cwiseAbs().maxCoeff() > near) return fmt::format("block {} has another size", i);
        if ((b.position - a.position).cwiseAbs().maxCoeff() > near) return fmt::format("block {} is at another place", i);
    }
    if (first.model.scatter != second.model.scatter) return "the friction of its joints is drawn anew";
    if (blocks > 0 && are_heights_drawn_anew(first, second)) return "its block heights are drawn anew";
    return std::nullopt;
}

std::optional<std::string> find_other_structure(const Scene& first, const Scene& second) {
    const std::optional<HeightVariation> of_first = find_height_variation(first), of_second = find_height_variation(second);
    if (of_first && of_second && of_first->seed != of_second->seed) return "its block heights are drawn anew, from another seed";
    if (first.scatter && second.scatter && first.scatter->seed != second.scatter->seed)
        return "its scatter is drawn anew, from another seed";
    return find_other_blocks(make_upright_specimen(first), make_upright_specimen(second));
}

std::vector<SceneDifference> find_scene_differences(const Scene& first, const Scene& second) {
    std::vector<SceneDifference> paths, contents, differences;
    add_differences("", read_back(first), read_back(second), paths);
    add_differences("", read_back(with_file_contents(first)), read_back(with_file_contents(second)), contents);
    // files differ by their contents, and are named by their paths; both lists are in the order of the scenes
    for (SceneDifference& difference : paths) {
        const bool found = differences.size() < contents.size() && contents[differences.size()].key == difference.key;
        if (found) differences.push_back(std::move(difference));
    }
    return differences;
}

std::string SecondScene::describe_differences() const {
    if (differences.empty()) return fmt::format("{} says what the prototype's scene says, to rounding.", file);
    std::string text = file + " differs from the prototype's scene in ";
    if (differences.size() > 1) text += fmt::format("{} keys: ", differences.size());
    for (std::size_t i = 0; i < std::min(kNamedDifferences, differences.size()); ++i) {
        const SceneDifference& difference = differences[i];
        const auto or_none = [](const std::string& value) { return value.empty() ? "none" : value; };
        text += fmt::format("{}{}: {}, not {}", i == 0 ? "" : "; ", difference.key, or_none(difference.second), or_none(difference.first));
    }
    return text + (differences.size() > kNamedDifferences ? "; ..." : ".");
}

}  // namespace musim::lsdem
