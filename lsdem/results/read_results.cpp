#include "lsdem/results/read_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/result_layout.hpp"
#include "lsdem/results/summary.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;
using detail::Hdf5Reader;

/// Energies, if there are any.
void read_energies(const Hdf5Reader& file, std::size_t samples, std::vector<Energy>& read) {
    if (!file.has("/energy/kinetic")) return;
    std::vector<Energy> energies(samples);
    detail::exchange_energies(file, energies);
    read = std::move(energies);
}

void read_history(const Hdf5Reader& file, StoredRun& run) {
    History& history = run.history;
    history.time = file.read<double>("/time", 1).values;
    const std::size_t nt = history.samples();
    if (nt == 0) file.fail("holds no sample");
    for (std::size_t k = 0; k < nt; ++k) {
        const bool follows = k == 0 || history.time[k] > history.time[k - 1];
        if (!follows || !std::isfinite(history.time[k])) file.fail(fmt::format("/time does not go on at sample {}", k));
    }
    history.base.resize(nt);
    detail::exchange_base(file, history.base);
    detail::exchange_spine(file, run);
    for (const std::size_t block : run.spine.block) {
        if (block >= run.blocks.mass.size()) file.fail("/spine/block names a block that is not there");
    }
    detail::exchange_spine_motion(file, run);
    for (std::size_t s = 0; s < run.spine.size(); ++s) {
        if (!history.spine_position[s].allFinite()) file.fail(fmt::format("/spine/position has no place for level {} at first", s));
    }
}

/// Names of listed blocks, if there are any.
void read_names(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/blocks/name")) return;
    std::vector<std::string> names = file.texts("/blocks/name");
    if (names.size() != run.blocks.mass.size()) file.fail("/blocks/name has another size than the rest");
    run.blocks.name = std::move(names);
}

/// Loads, if there are any.
void read_loads(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/loads/name")) return;
    StoredRun read;
    read.loads = file.texts("/loads/name");
    read.history.time = run.history.time;
    read.history.energy = run.history.energy;
    detail::exchange_loads(file, read);
    run.loads = std::move(read.loads);
    run.history.load = std::move(read.history.load);
    run.history.energy = std::move(read.history.energy);
}

void read_falls(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/blocks/fall_time")) return;
    Falls falls;
    detail::exchange_falls(file, run.blocks.mass.size(), falls, file.has("/blocks/collapse_displacement"));
    run.falls = std::move(falls);
}

void read_origin(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/origin/stage")) return;
    StageOrigin origin;
    detail::exchange_origin(file, run.blocks.mass.size(), origin);
    run.origin = std::move(origin);
}

void read_losses(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/losses/friction")) return;
    Losses losses{.block = std::vector<PairWork>(run.blocks.mass.size()), .ground = {}};
    detail::exchange_losses(file, losses);
    run.losses = std::move(losses);
}

void read_frames(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/frames/time")) return;
    Frames frames;
    frames.time = file.read<double>("/frames/time", 1).values;
    detail::exchange_frames(file, run.blocks.mass.size(), frames, file.has("/frames/contact_force"));
    run.frames = std::move(frames);
}

void read_similitude(const Hdf5Reader& file, StoredRun& run) {
    try {
        const nlohmann::json similitude = nlohmann::json::parse(file.attribute("similitude"));
        if (!similitude.is_null()) run.similitude = parse_similitude(similitude);
    } catch (const nlohmann::json::exception& error) {
        file.fail(fmt::format("its attribute similitude is none ({})", error.what()));
    } catch (const scaling::SimilitudeError& error) {
        file.fail(fmt::format("its attribute similitude is none ({})", error.what()));
    }
}

/// Status and collapse from the summary beside the file of that checksum.
void read_summary(const fs::path& path, const std::string& result, StoredRun& run) {
    const nlohmann::json summary = read_checked_json(path);
    if (summary.value("result_checksum", nlohmann::json()) != result) {
        throw ResultError(fmt::format("{}: is of another run than result.h5 beside it; run the scene again", path.string()));
    }
    const nlohmann::json status = summary.value("status", nlohmann::json());
    constexpr std::array kStatuses{RunStatus::completed, RunStatus::collapsed, RunStatus::diverged};
    const auto* found = std::find_if(kStatuses.begin(), kStatuses.end(), [&](RunStatus known) { return status == to_string(known); });
    if (found == kStatuses.end()) {
        throw ResultError(fmt::format("{}: has no status of a run (it is of another version); run the scene again", path.string()));
    }
    run.status = *found;
    if (summary.contains("collapse_time_s") && summary["collapse_time_s"].is_number()) run.collapse_time = summary["collapse_time_s"];
    try {
        const auto divergence = summary.value("divergence", nlohmann::json::object());
        if (run.status == RunStatus::diverged) run.divergence = divergence.value("what", "diverged");
        run.warnings = summary.value("warnings", std::vector<std::string>{});
        run.at_rest = summary.value("rest", nlohmann::json::object()).value("at_rest", true);
        const nlohmann::json outcome = summary.value("outcome", nlohmann::json::object());
        const auto pga = outcome.value("pga_g", std::vector<double>{});
        for (std::size_t axis = 0; axis < pga.size() && axis < 3; ++axis) {
            run.peak_base_acceleration[static_cast<int>(axis)] = pga[axis] * scaling::kStandardGravity.value();
        }
        if (outcome.contains("base_changes")) run.base_changes = parse_base_changes(outcome["base_changes"]);
    } catch (const nlohmann::json::exception& error) {
        throw ResultError(fmt::format("{}: {} (it is damaged, or of another version); run the scene again", path.string(), error.what()));
    }
}

}  // namespace

StoredRun read_run(const fs::path& directory, Reading reading) {
    if (!fs::is_directory(directory)) {
        throw ResultError(fmt::format("{}: is no directory of results (there is none of that name); name one that a run has written",
                                      directory.string()));
    }
    require_complete(directory);
    StoredRun run;
    run.directory = directory;
    const Hdf5Reader file(directory / "result.h5");
    detail::exchange_blocks(file, run);
    read_history(file, run);
    const auto take = [&](const auto& read_part) {
        try {
            read_part();
        } catch (const ResultError& error) {
            if (reading == Reading::whole) throw;
            run.gaps.emplace_back(error.what());
        }
    };
    take([&] { read_energies(file, run.history.samples(), run.history.energy); });
    take([&] { read_names(file, run); });
    take([&] { read_loads(file, run); });
    take([&] { detail::exchange_shapes(file, run.blocks.mass.size(), run.blocks.shapes); });
    take([&] { read_falls(file, run); });
    take([&] { read_origin(file, run); });
    take([&] { read_losses(file, run); });
    take([&] { read_frames(file, run); });
    take([&] { detail::exchange_sensors(file, run.sensors); });
    take([&] { run.scene = file.attribute("scene"); });
    take([&] { run.state_hash = file.attribute("state_hash"); });
    take([&] { read_similitude(file, run); });
    for (const BaseState& base : run.history.base) {
        run.peak_base_acceleration = run.peak_base_acceleration.cwiseMax(base.acceleration.cwiseAbs());
    }
    run.final.time = run.history.time.back();
    run.is_status_known = false;
    run.status = run.falls.at_collapse.empty() ? RunStatus::completed : RunStatus::collapsed;
    take([&] {
        read_summary(directory / "summary.json", file.checksum(), run);
        run.is_status_known = true;
    });
    return run;
}

}  // namespace musim::lsdem
