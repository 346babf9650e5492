#include "lsdem/results/write_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/result_layout.hpp"
#include "lsdem/results/staged_files.hpp"
#include "lsdem/results/summary.hpp"

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
    detail::exchange_blocks(file, run);
    if (run.blocks.is_listed()) file.write_texts("/blocks/name", run.blocks.name);
    if (!run.falls.time.empty()) detail::exchange_falls(file, n, run.falls, !run.falls.at_collapse.empty());
    if (std::optional<StageOrigin> origin = run.origin) detail::exchange_origin(file, n, *origin);
    if (std::optional<Losses> losses = run.losses) detail::exchange_losses(file, *losses);
    if (const Frames& frames = run.frames; !frames.time.empty()) {
        file.exchange("/frames/time", {frames.time.size()}, std::vector<float>(frames.time.begin(), frames.time.end()), "s");
        detail::exchange_frames(file, n, frames, !frames.contact_force.empty());
    }
    file.write_attribute("scene", header.scene);
    file.write_attribute("similitude", run.similitude.is_identity() ? "null" : to_json(run.similitude).dump());
    file.write_attribute("program_version", header.program_version);
    file.write_attribute("state_hash", run.state_hash);
    return file.image();
}

/// One instant in XDMF: the blocks as points, with whatever `attributes` describes.
std::string xdmf_grid(double time, std::size_t blocks, const std::string& points, const std::string& attributes) {
    return fmt::format(
        "  <Grid Name=\"blocks\">\n   <Time Value=\"{}\"/>\n   <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n"
        "   <Geometry GeometryType=\"XYZ\">{}</Geometry>\n{}  </Grid>\n",
        time, blocks, points, attributes);
}

std::string xdmf_attribute(std::string_view name, std::string_view type, const std::string& data) {
    return fmt::format("   <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name, type, data);
}

/// A dataset of n rows.
std::string xdmf_data(std::string_view path, std::size_t n, int width, int precision) {
    return fmt::format("<DataItem Dimensions=\"{} {}\" NumberType=\"Float\" Precision=\"{}\" Format=\"HDF\">result.h5:{}</DataItem>", n,
                       width, precision, path);
}

/// Row `k` of a dataset of frames.
std::string xdmf_frame(std::string_view path, std::size_t k, std::size_t frames, std::size_t n, int width) {
    return fmt::format(
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"1 {2} {3}\"><DataItem Dimensions=\"3 3\" Format=\"XML\">{0} 0 0 1 1 1 1 {2} {3}"
        "</DataItem><DataItem Dimensions=\"{1} {2} {3}\" NumberType=\"Float\" Precision=\"4\" "
        "Format=\"HDF\">result.h5:{4}</DataItem></DataItem>",
        k, frames, n, width, path);
}

/// Likewise of one number per block.
std::string xdmf_frame_of_numbers(std::string_view path, std::size_t k, std::size_t frames, std::size_t n) {
    return fmt::format(
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"1 {2}\"><DataItem Dimensions=\"3 2\" Format=\"XML\">{0} 0 1 1 1 {2}"
        "</DataItem><DataItem Dimensions=\"{1} {2}\" NumberType=\"Float\" Precision=\"4\" "
        "Format=\"HDF\">result.h5:{3}</DataItem></DataItem>",
        k, frames, n, path);
}

/// Frames when the run kept any, else its first and last instant.
std::string make_xdmf(const RunResult& run) {
    const std::size_t n = run.blocks.mass.size();
    const std::string size = xdmf_attribute("size [m]", "Vector", xdmf_data("/blocks/size", n, 3, 8));
    std::string grids;
    const std::size_t frames = run.frames.time.size();
    const auto force = [&](std::size_t k) {
        return run.frames.contact_force.empty()
                   ? std::string()
                   : xdmf_attribute("contact force [N]", "Scalar", xdmf_frame_of_numbers("/frames/contact_force", k, frames, n));
    };
    for (std::size_t k = 0; k < frames; ++k) {
        grids += xdmf_grid(run.frames.time[k], n, xdmf_frame("/frames/position", k, frames, n, 3),
                           size + xdmf_attribute("velocity [m/s]", "Vector", xdmf_frame("/frames/velocity", k, frames, n, 3)) +
                               xdmf_attribute("quaternion", "Matrix", xdmf_frame("/frames/quaternion", k, frames, n, 4)) + force(k));
    }
    if (frames == 0) {
        const auto turn = [&](const char* path) { return xdmf_attribute("quaternion", "Matrix", xdmf_data(path, n, 4, 8)); };
        grids += xdmf_grid(run.initial.time, n, xdmf_data("/blocks/initial_position", n, 3, 8), size + turn("/blocks/initial_quaternion"));
        grids += xdmf_grid(run.final.time, n, xdmf_data("/blocks/final_position", n, 3, 8), size + turn("/blocks/final_quaternion"));
    }
    return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n  <Grid GridType=\"Collection\" CollectionType=\"Temporal\">\n" +
           grids + "  </Grid>\n </Domain>\n</Xdmf>\n";
}

/// Time, base velocity and the velocity of every spine block, in SI; each number reads back as the same double.
std::string make_spine_csv(const RunResult& run) {
    std::string csv = "time_s,base_vx_m_s,base_vy_m_s,base_vz_m_s";
    for (const std::string& head : head_spine(run)) fmt::format_to(std::back_inserter(csv), ",{0}_vx_m_s,{0}_vy_m_s,{0}_vz_m_s", head);
    csv += '\n';
    const std::size_t ns = run.spine.size();
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        const Vector3& base = run.history.base[k].velocity;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}", run.history.time[k], base.x(), base.y(), base.z());
        for (std::size_t s = 0; s < ns; ++s) {
            const Vector3& v = run.history.spine_velocity[k * ns + s];
            fmt::format_to(std::back_inserter(csv), ",{},{},{}", v.x(), v.y(), v.z());
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
    files_.write(subfolder / "result.xdmf", make_xdmf(run));
    files_.write(subfolder / "spine.csv", make_spine_csv(run));
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
