#include "lsdem/results/write_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/result_layout.hpp"
#include "lsdem/results/staged_files.hpp"
#include "lsdem/results/summary.hpp"
#include "lsdem/results/write_xdmf.hpp"

namespace musim::lsdem {
namespace {

using detail::Hdf5File;

std::vector<char> make_hdf5(const RunResult& run, const ResultHeader& header) {
    const hsize_t n = run.blocks.mass.size();
    Hdf5File file;
    file.exchange("/time", {run.history.samples()}, run.history.time, "s");
    detail::exchange_base(file, run.history.base);
    detail::exchange_spine(file, run);
    detail::exchange_spine_motion(file, run);
    std::vector<Energy> energies = run.history.energy;
    for (Energy& energy : energies) energy.elastic_normal += energy.elastic_shear;
    detail::exchange_energies(file, energies);
    if (!run.loads.empty()) {
        file.write_texts("/loads/name", run.loads);
        detail::exchange_loads(file, run);
    }
    detail::exchange_blocks(file, run);
    detail::exchange_shapes(file, n, run.blocks.shapes);
    if (run.blocks.is_listed()) file.write_texts("/blocks/name", run.blocks.name);
    if (!run.falls.time.empty()) detail::exchange_falls(file, n, run.falls, !run.falls.at_collapse.empty());
    if (std::optional<StageOrigin> origin = run.origin) detail::exchange_origin(file, n, *origin);
    if (std::optional<Losses> losses = run.losses) detail::exchange_losses(file, *losses);
    if (const Frames& frames = run.frames; !frames.time.empty()) {
        file.exchange("/frames/time", {frames.time.size()}, std::vector<float>(frames.time.begin(), frames.time.end()), "s");
        detail::exchange_frames(file, n, frames, !frames.contact_force.empty());
    }
    detail::exchange_sensors(file, run.sensors);
    if (run.blocks.shapes.any()) detail::write_surface(file, detail::list_surface(run.blocks));
    file.write_attribute("scene", header.scene);
    file.write_attribute("similitude", run.similitude.is_identity() ? "null" : to_json(run.similitude).dump());
    file.write_attribute("program_version", header.program_version);
    file.write_attribute("state_hash", run.state_hash);
    return file.image();
}

/// Time, base velocity and the velocity of every spine block, in SI; each number reads back as the same double. Where the base turns, its
/// angular velocity too.
std::string make_spine_csv(const RunResult& run) {
    const bool turns = find_base_turn(run.history).has_value();
    std::string csv = "time_s,base_vx_m_s,base_vy_m_s,base_vz_m_s";
    if (turns) csv += ",base_wx_rad_s,base_wy_rad_s,base_wz_rad_s";
    for (const std::string& head : head_spine(run)) fmt::format_to(std::back_inserter(csv), ",{0}_vx_m_s,{0}_vy_m_s,{0}_vz_m_s", head);
    csv += '\n';
    const std::size_t ns = run.spine.size();
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        const Vector3& base = run.history.base[k].velocity;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}", run.history.time[k], base.x(), base.y(), base.z());
        if (turns) {
            const Vector3& w = run.history.base[k].turn_rates.velocity;
            fmt::format_to(std::back_inserter(csv), ",{},{},{}", w.x(), w.y(), w.z());
        }
        for (std::size_t s = 0; s < ns; ++s) {
            const Vector3& v = run.history.spine_velocity[k * ns + s];
            fmt::format_to(std::back_inserter(csv), ",{},{},{}", v.x(), v.y(), v.z());
        }
        csv += '\n';
    }
    return csv;
}

/// Time, force and displacement of every load, in SI.
std::string make_loads_csv(const RunResult& run) {
    std::string csv = "time_s";
    for (const std::string& name : run.loads) fmt::format_to(std::back_inserter(csv), ",{0}_force_n,{0}_displacement_m", name);
    csv += '\n';
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        fmt::format_to(std::back_inserter(csv), "{}", run.history.time[k]);
        for (std::size_t l = 0; l < run.loads.size(); ++l) {
            const LoadState& load = run.history.load[k * run.loads.size() + l];
            fmt::format_to(std::back_inserter(csv), ",{},{}", load.force, load.displacement);
        }
        csv += '\n';
    }
    return csv;
}

/// A file of a folder, and what folders it leaves empty.
void remove_file(const std::filesystem::path& directory, const std::filesystem::path& name) {
    std::error_code ignored;
    std::filesystem::remove(directory / name, ignored);
    for (auto part = name.parent_path(); !part.empty(); part = part.parent_path()) std::filesystem::remove(directory / part, ignored);
}

}  // namespace

void ResultFolder::add_run(const std::filesystem::path& subfolder, const RunResult& run, const ResultHeader& header) {
    const std::vector<char> hdf5 = make_hdf5(run, header);
    nlohmann::json summary = make_summary(run);
    summary["result_checksum"] = detail::find_checksum({hdf5.data(), hdf5.size()});
    summary["program_version"] = header.program_version;
    if (!run.similitude.is_identity()) summary["similitude"] = to_json(run.similitude);

    files_.write(subfolder / "result.h5", {hdf5.data(), hdf5.size()});
    files_.write(subfolder / "result.xdmf", detail::make_xdmf(run));
    files_.write(subfolder / "spine.csv", make_spine_csv(run));
    for (const SensorTable& table : make_sensor_tables(run.sensors)) files_.write(subfolder / table.name, table.csv);
    if (!run.loads.empty()) files_.write(subfolder / "loads.csv", make_loads_csv(run));
    files_.write(subfolder / "summary.json", make_checked_json(std::move(summary)));
}

ResultFolder::ResultFolder(const std::filesystem::path& directory, ResultOrigin origin, Overwriting overwriting) : files_(directory) {
    set_origin(std::move(origin), overwriting);
}

void ResultFolder::set_origin(ResultOrigin origin, Overwriting overwriting) {
    const std::filesystem::path& directory = files_.directory();
    if (overwriting == Overwriting::refuse) refuse_other_results(directory, origin);
    detail::remove_leftovers(directory / kContentsName);
    const bool goes_on = overwriting == Overwriting::resume && is_of(directory, origin);
    contents_ = FolderContents{.origin = std::move(origin), .complete = true, .files = {}};
    (goes_on ? contents_->files : older_) = list_results(directory);
}

void ResultFolder::commit() {
    if (!contents_) return files_.commit();
    std::vector<std::string>& files = contents_->files;
    for (const std::filesystem::path& name : files_.names()) files.push_back(name.string());
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());

    // a kill from here on leaves a folder that says it is not complete, and lists whatever is in it
    FolderContents between = *contents_;
    between.complete = false;
    between.files.insert(between.files.end(), older_.begin(), older_.end());
    write_contents(files_.directory(), between);
    for (const std::string& old : older_) {
        if (!std::binary_search(files.begin(), files.end(), old)) remove_file(files_.directory(), old);
    }
    older_.clear();
    files_.commit();
    write_contents(files_.directory(), *contents_);
}

void ResultFolder::add_json(const std::filesystem::path& name, const nlohmann::json& object) {
    files_.write(name, make_checked_json(object));
}

}  // namespace musim::lsdem
