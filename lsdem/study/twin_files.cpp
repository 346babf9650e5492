#include "lsdem/study/twin_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lsdem/archive.hpp"
#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/result_error.hpp"
#include "records/atomic_file.hpp"
#include "records/formats/csv_cell.hpp"
#include "scaling/json_optional.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

constexpr ArchiveKind kTapeKind{{'m', 'u', 's', 'i', 'm', 'T', 'W', 'N'}, 1, "prototype of twins"};

constexpr const char* kPrototypeName = "prototype.velocities";

constexpr const char* kTwinFormat = "musim-twin/1";

void exchange_prototype(Archive& archive, TwinPrototype& p) {
    archive(p.moving_blocks, p.height, p.gravity, p.interval, p.samples, p.peak, p.rounding, p.diverged);
}

nlohmann::json to_json(const TwinChoice& choice) {
    return {{"length", choice.length}, {"shift", choice.shift}, {"directions", choice.directions}};
}

nlohmann::json to_json(const Growth& growth) { return {{"factor", growth.factor}, {"time_s", growth.time}, {"from", growth.from}}; }

nlohmann::json to_json(const Proportionality& set) {
    return {{"directions", set.directions},
            {"shifts", set.shift},
            {"departure", scaling::or_null(set.departure)},
            {"time_s", set.time},
            {"level", set.level}};
}

void add_cell(std::string& csv, double value) { csv += std::isfinite(value) ? fmt::format(",{}", value) : ","; }

}  // namespace

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw records::WriteError(fmt::format("{}: cannot be made ({}); choose another folder", folder.string(), error.message()));
}

void write_prototype(const fs::path& folder, TwinPrototype prototype, std::vector<std::vector<Vector3>> velocities) {
    Archive archive;
    exchange_prototype(archive, prototype);
    archive(velocities);
    std::ostringstream out;
    write_sealed(out, kTapeKind, archive.bytes());
    records::write_file_atomically(folder / kPrototypeName, out.view());
}

std::optional<std::vector<std::vector<Vector3>>> read_prototype(const fs::path& folder, TwinPrototype& prototype) {
    std::ifstream in = scaling::open_regular_file(folder / kPrototypeName);
    if (!in) return std::nullopt;
    try {
        const std::string bytes = read_sealed(in, kTapeKind);
        Archive archive{std::string_view(bytes)};
        TwinPrototype found;
        std::vector<std::vector<Vector3>> velocities;
        exchange_prototype(archive, found);
        archive(velocities);
        archive.finish();
        prototype = found;
        return velocities;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

std::string twin_file_name(const TwinChoice& choice) {
    return choice.shift > 0.0 ? fmt::format("moved_{}_{}.json", choice.shift, choice.directions)
                              : fmt::format("model_{}.json", choice.length);
}

void write_twin(const fs::path& folder, const TwinRun& twin) {
    nlohmann::json object = to_json(twin.choice);
    object.update({{"format", kTwinFormat}, {"diverged", twin.diverged}, {"difference_m_s", twin.difference}});
    records::write_file_atomically(folder / twin_file_name(twin.choice), make_checked_json(object));
}

bool read_twin(const fs::path& folder, TwinRun& twin) {
    try {
        const nlohmann::json object = read_checked_json(folder / twin_file_name(twin.choice));
        const TwinChoice choice{object.at("length"), object.at("shift"), object.at("directions")};
        if (object.at("format") != kTwinFormat || choice != twin.choice) return false;
        const bool diverged = object.at("diverged");
        twin.difference = object.at("difference_m_s").get<std::vector<double>>();
        twin.diverged = diverged;
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    } catch (const ResultError&) {
        return false;
    }
}

nlohmann::json to_json(const TwinStudy& study, const TwinSummary& summary) {
    nlohmann::json twins = nlohmann::json::array(), sets = nlohmann::json::array();
    for (std::size_t i = 0; i < study.twins.size(); ++i) {
        const TwinGrowth& growth = summary.twins[i];
        nlohmann::json& twin = twins.emplace_back(to_json(study.twins[i].choice));
        twin["diverged"] = study.twins[i].diverged;
        twin["parting_time_s"] = scaling::or_null(growth.parting_time);
        twin["largest_growth"] = to_json(growth.growth);
        twin["largest_difference"] = growth.running.empty() ? nlohmann::json() : nlohmann::json(growth.running.back());
    }
    for (const Proportionality& set : find_proportionality(study, summary.twins)) sets.push_back(to_json(set));
    nlohmann::json fastest = to_json(summary.twins[summary.fastest].growth);
    fastest["twin"] = summary.fastest;
    const TwinPrototype& prototype = study.prototype;
    return {{"scene", study.name},
            {"moving_blocks", prototype.moving_blocks},
            {"block_height_m", prototype.height},
            {"gravity_m_s2", prototype.gravity},
            {"sample_interval_s", prototype.interval},
            {"samples", prototype.samples},
            {"growth_window_s", static_cast<double>(prototype.window()) * prototype.interval},
            {"peak_velocity_m_s", prototype.peak},
            {"rounding_over_peak", prototype.rounding / prototype.peak},
            {"prototype_diverged", prototype.diverged},
            {"horizon_s", summary.horizon},
            {"log10_difference",
             {{"time_s", summary.at_horizon.time},
              {"count", summary.at_horizon.count},
              {"mean", summary.at_horizon.mean},
              {"sd", summary.at_horizon.sd}}},
            {"largest_growth", fastest},
            {"twins", twins},
            {"proportionality", sets}};
}

std::string make_twins_csv(const std::vector<TwinStudy>& studies) {
    std::string csv = "scene,length,shift,directions,time_s,difference,running_maximum\n";
    for (const TwinStudy& study : studies) {
        const std::string scene = records::csv_cell(study.name);
        for (const TwinRun& twin : study.twins) {
            const TwinGrowth growth = find_growth(study.prototype, twin);
            for (std::size_t k = 0; k < twin.difference.size(); ++k) {
                fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{}\n", scene, twin.choice.length, twin.choice.shift,
                               twin.choice.directions, study.prototype.time(k), twin.difference[k] / study.prototype.peak,
                               growth.running[k]);
            }
        }
    }
    return csv;
}

std::string make_spread_csv(const std::vector<TwinStudy>& studies) {
    std::string csv = "scene,time_s,count,mean_log10,sd_log10\n";
    for (const TwinStudy& study : studies) {
        std::vector<TwinGrowth> twins;
        for (const TwinRun& twin : study.twins) twins.push_back(find_growth(study.prototype, twin));
        for (std::size_t k = 0; k < study.prototype.samples; ++k) {
            const LogSpread spread = find_spread(study, twins, k);
            fmt::format_to(std::back_inserter(csv), "{},{},{}", records::csv_cell(study.name), spread.time, spread.count);
            add_cell(csv, spread.mean);
            add_cell(csv, spread.sd);
            csv += '\n';
        }
    }
    return csv;
}

}  // namespace musim::lsdem
