#include "lsdem/results/read_results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/hdf5_reader.hpp"
#include "lsdem/results/summary.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;
using detail::Hdf5Reader;

/// Checks that a dataset has as many rows as the others and a given width.
template <class Number>
void require_shape(const Hdf5Reader& file, const std::string& path, const detail::Hdf5Data<Number>& data,
                   const std::vector<hsize_t>& shape) {
    if (data.shape != shape) file.fail(fmt::format("{} has another size than the rest", path));
}

std::vector<Vector3> read_vectors(const Hdf5Reader& file, const std::string& path, std::vector<hsize_t> shape) {
    const auto data = file.doubles(path, shape.size() + 1);
    shape.push_back(3);
    require_shape(file, path, data, shape);
    std::vector<Vector3> vectors(data.values.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Eigen::Map<const Vector3>(&data.values[3 * i]);
    return vectors;
}

std::vector<Quaternion> read_quaternions(const Hdf5Reader& file, const std::string& path, hsize_t n) {
    const auto data = file.doubles(path, 2);
    require_shape(file, path, data, {n, 4});
    std::vector<Quaternion> quaternions;
    for (std::size_t i = 0; i < n; ++i) {
        const double* q = &data.values[4 * i];
        quaternions.emplace_back(q[0], q[1], q[2], q[3]);
    }
    return quaternions;
}

template <class FloatVector>
std::vector<FloatVector> read_frame_vectors(const Hdf5Reader& file, const std::string& path, const std::vector<hsize_t>& shape) {
    const auto data = file.floats(path, 3);
    require_shape(file, path, data, shape);
    const std::size_t width = shape[2];
    std::vector<FloatVector> vectors(data.values.size() / width);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Eigen::Map<const FloatVector>(&data.values[width * i]);
    return vectors;
}

/// Energies as results hold them, where springs' energy is one number; none in results without them.
void read_energies(const Hdf5Reader& file, std::size_t samples, std::vector<Energy>& read) {
    if (!file.has("/energy/kinetic")) return;
    std::vector<Energy> energies(samples);
    const auto take = [&](const char* path, double Energy::*part) {
        const auto data = file.doubles(path, 1);
        require_shape(file, path, data, {samples});
        for (std::size_t k = 0; k < samples; ++k) energies[k].*part = data.values[k];
    };
    take("/energy/kinetic", &Energy::kinetic);
    take("/energy/potential", &Energy::gravitational);
    take("/energy/elastic", &Energy::elastic_normal);
    take("/energy/friction", &Energy::friction_loss);
    take("/energy/damping", &Energy::damping_loss);
    take("/energy/preparation", &Energy::preparation_loss);
    take("/energy/base_work", &Energy::base_work);
    read = std::move(energies);
}

void read_history(const Hdf5Reader& file, StoredRun& run) {
    History& history = run.history;
    auto time = file.doubles("/time", 1);
    history.time = std::move(time.values);
    const hsize_t nt = history.time.size();
    if (nt == 0) file.fail("holds no sample");
    for (std::size_t k = 0; k < nt; ++k) {
        const bool follows = k == 0 || history.time[k] > history.time[k - 1];
        if (!follows || !std::isfinite(history.time[k])) file.fail(fmt::format("/time does not go on at sample {}", k));
    }

    const auto displacement = read_vectors(file, "/base/displacement", {nt});
    const auto velocity = read_vectors(file, "/base/velocity", {nt});
    const auto acceleration = read_vectors(file, "/base/acceleration", {nt});
    for (std::size_t k = 0; k < nt; ++k) history.base.push_back({displacement[k], velocity[k], acceleration[k]});

    for (const long long block : file.integers("/spine/block", 1).values) run.spine.block.push_back(static_cast<std::size_t>(block));
    run.spine.level = file.layers("/spine/level", run.blocks.mass.size());
    const hsize_t ns = run.spine.block.size();
    if (run.spine.level.size() != ns) file.fail("/spine/level has another size than the rest");
    for (const std::size_t block : run.spine.block) {
        if (block >= run.blocks.mass.size()) file.fail("/spine/block names a block that is not there");
    }
    history.spine_position = read_vectors(file, "/spine/position", {nt, ns});
    for (std::size_t s = 0; s < ns; ++s) {
        if (!history.spine_position[s].allFinite()) file.fail(fmt::format("/spine/position has no place for level {} at first", s));
    }
    history.spine_velocity = read_vectors(file, "/spine/velocity", {nt, ns});
    history.spine_rotation = read_vectors(file, "/spine/rotation_vector", {nt, ns});
}

void read_blocks(const Hdf5Reader& file, StoredRun& run) {
    run.blocks.mass = file.doubles("/blocks/mass", 1).values;
    const hsize_t n = run.blocks.mass.size();
    run.blocks.size = read_vectors(file, "/blocks/size", {n});
    run.blocks.layer = file.layers("/blocks/layer", n);
    if (run.blocks.layer.size() != n) file.fail("/blocks/layer has another size than the rest");
    run.initial.position = read_vectors(file, "/blocks/initial_position", {n});
    run.final.position = read_vectors(file, "/blocks/final_position", {n});
    run.initial.orientation = read_quaternions(file, "/blocks/initial_quaternion", n);
    run.final.orientation = read_quaternions(file, "/blocks/final_quaternion", n);
}

void read_falls(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/blocks/fall_time")) return;
    const hsize_t n = run.blocks.mass.size();
    auto time = file.doubles("/blocks/fall_time", 1);
    require_shape(file, "/blocks/fall_time", time, {n});
    Falls falls{.time = std::move(time.values), .displacement = read_vectors(file, "/blocks/fall_displacement", {n}), .at_collapse = {}};
    if (file.has("/blocks/collapse_displacement")) falls.at_collapse = read_vectors(file, "/blocks/collapse_displacement", {n});
    run.falls = std::move(falls);
}

void read_origin(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/origin/stage")) return;
    const hsize_t n = run.blocks.mass.size();
    StageOrigin origin;
    const auto stage = file.integers("/origin/stage", 1);
    const auto time = file.doubles("/origin/time", 1);
    require_shape(file, "/origin/stage", stage, {1});
    require_shape(file, "/origin/time", time, {1});
    origin.stage = static_cast<std::size_t>(stage.values[0]) - 1;
    origin.time = time.values[0];
    origin.base = read_vectors(file, "/origin/base_displacement", {1})[0];
    origin.position = read_vectors(file, "/origin/position", {n});
    origin.orientation = read_quaternions(file, "/origin/quaternion", n);
    run.origin = std::move(origin);
}

void read_losses(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/losses/friction")) return;
    const auto friction = file.doubles("/losses/friction", 1), damping = file.doubles("/losses/damping", 1);
    const auto ground = file.doubles("/losses/ground", 1);
    const hsize_t n = run.blocks.mass.size();
    require_shape(file, "/losses/friction", friction, {n});
    require_shape(file, "/losses/damping", damping, {n});
    require_shape(file, "/losses/ground", ground, {2});
    Losses losses{.block = {}, .ground = {ground.values[0], ground.values[1]}};
    for (std::size_t b = 0; b < n; ++b) losses.block.push_back({friction.values[b], damping.values[b]});
    run.losses = std::move(losses);
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

void read_frames(const Hdf5Reader& file, StoredRun& run) {
    if (!file.has("/frames/time")) return;
    Frames frames;
    frames.time = file.doubles("/frames/time", 1).values;
    const hsize_t nf = frames.time.size(), n = run.blocks.mass.size();
    frames.position = read_frame_vectors<Eigen::Vector3f>(file, "/frames/position", {nf, n, 3});
    frames.quaternion = read_frame_vectors<Eigen::Vector4f>(file, "/frames/quaternion", {nf, n, 4});
    frames.velocity = read_frame_vectors<Eigen::Vector3f>(file, "/frames/velocity", {nf, n, 3});
    if (file.has("/frames/contact_force")) {
        auto force = file.floats("/frames/contact_force", 2);
        require_shape(file, "/frames/contact_force", force, {nf, n});
        frames.contact_force = std::move(force.values);
    }
    run.frames = std::move(frames);
}

/// Status and collapse from the summary beside the file of that checksum.
void read_summary(const fs::path& path, const std::string& result, StoredRun& run) {
    const nlohmann::json summary = read_checked_json(path);
    if (summary.value("result_checksum", nlohmann::json()) != result) {
        throw ResultError(fmt::format("{}: is of another run than result.h5 beside it; run the scene again", path.string()));
    }
    const nlohmann::json status = summary.value("status", nlohmann::json());
    if (status == "completed") {
        run.status = RunStatus::completed;
    } else if (status == "collapsed") {
        run.status = RunStatus::collapsed;
    } else if (status == "diverged") {
        run.status = RunStatus::diverged;
    } else {
        throw ResultError(fmt::format("{}: has no status of a run (it is of another version); run the scene again", path.string()));
    }
    if (summary.contains("collapse_time_s") && summary["collapse_time_s"].is_number()) run.collapse_time = summary["collapse_time_s"];
    try {
        const auto divergence = summary.value("divergence", nlohmann::json::object());
        if (run.status == RunStatus::diverged) run.divergence = divergence.value("what", "diverged");
        run.warnings = summary.value("warnings", summary.value("doubts", std::vector<std::string>{}));  // "doubts": the old name
        run.at_rest = summary.value("rest", nlohmann::json::object()).value("at_rest", true);
        const nlohmann::json outcome = summary.value("outcome", nlohmann::json::object());
        const auto pga = outcome.value("pga_g", std::vector<double>{});
        for (std::size_t axis = 0; axis < pga.size() && axis < 3; ++axis) {
            run.peak_base_acceleration[static_cast<int>(axis)] = pga[axis] * scaling::kStandardGravity.value();
        }
        if (outcome.contains("pga_source")) run.source_pga = parse_source_pga(outcome["pga_source"]);
    } catch (const nlohmann::json::exception& error) {
        throw ResultError(fmt::format("{}: {} (it is damaged, or of another version); run the scene again", path.string(), error.what()));
    }
}

}  // namespace

StoredRun read_run(const fs::path& directory, Reading reading) {
    if (!fs::is_directory(directory)) {
        throw ResultError(
            fmt::format("{}: is no directory of results (there is none of that name); name one that `musim run -o DIR` has written",
                        directory.string()));
    }
    require_complete(directory);
    StoredRun run;
    run.directory = directory;
    const Hdf5Reader file(directory / "result.h5");
    read_blocks(file, run);
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
    take([&] { read_falls(file, run); });
    take([&] { read_origin(file, run); });
    take([&] { read_losses(file, run); });
    take([&] { read_frames(file, run); });
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
