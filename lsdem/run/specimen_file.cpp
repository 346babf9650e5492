#include "lsdem/run/specimen_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/hdf5_reader.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/results/result_layout.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "records/atomic_file.hpp"

namespace musim::lsdem {
namespace {

constexpr std::string_view kFormat = "musim-specimen/5";

/// Edge lengths that differ by less than this part are the same, written at another scale.
constexpr double kSameLength = 1e-9;

/// A quaternion whose length differs from 1 by more than this is no rotation.
constexpr double kSameRotation = 1e-9;

/// Parts of a scene that a specimen does not depend on.
constexpr std::array kUnrelated{"schema", "name", "base_motion", "motions", "output", "preparation"};

/// The follower of a contact with the ground.
constexpr long long kOnGround = -1;

double weight_of(const Model& model, std::size_t index) { return model.blocks[index].mass * model.gravity.norm(); }

/// The couple of the weight of this block at the end of its height [N·m].
double couple_of_weight(const Model& model, std::size_t index) {
    return weight_of(model, index) * 2.0 * half_extents(model, model.blocks[index]).z();
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    throw ResultError(fmt::format("{}: {}", file.string(), what));
}

void require_specimen(const detail::Hdf5Reader& reader, const std::filesystem::path& file) {
    const std::string format = reader.has("/blocks/tilt") ? reader.attribute("format") : "";
    if (format == kFormat) return;
    if (format.starts_with("musim-specimen/")) {
        refuse(file, fmt::format("it has format {}, this program reads {} (another version wrote it); move it and prepare it again", format,
                                 kFormat));
    }
    refuse(file, "not a prepared specimen; name another file");
}

/// Friction of the contacts of a specimen, at the weights of `model`.
std::vector<Preload> read_preloads(const detail::Hdf5Reader& reader, const std::filesystem::path& file, const Model& model) {
    const auto leader = reader.read<long long>("/contacts/leader", 1), follower = reader.read<long long>("/contacts/follower", 1);
    const auto friction = reader.read<double>("/contacts/friction_over_block_weight", 2);
    const auto couple = reader.read<double>("/contacts/couple_over_block_weight_and_height", 1);
    const auto known = [&](long long block) { return block >= 0 && block < static_cast<long long>(model.blocks.size()); };
    const std::size_t contacts = leader.values.size();
    if (follower.values.size() != contacts || friction.values.size() != 3 * contacts || couple.values.size() != contacts) {
        refuse(file, "the lists of its contacts differ in length (a damaged file); prepare it again");
    }
    std::vector<Preload> preloads(contacts);
    for (std::size_t i = 0; i < contacts; ++i) {
        const long long below = leader.values[i], above = follower.values[i];
        if (!known(below) || !(known(above) || above == kOnGround)) {
            refuse(file, fmt::format("contact {} names a block that is not there (a damaged file); prepare it again", i));
        }
        Preload& preload = preloads[i];
        preload.leader = static_cast<std::size_t>(below);
        if (above != kOnGround) preload.follower = static_cast<std::size_t>(above);
        preload.friction = weight_of(model, preload.leader) * Eigen::Map<const Vector3>(&friction.values[3 * i]);
        preload.couple = couple.values[i] * couple_of_weight(model, preload.leader);
        if (!preload.is_finite()) {
            refuse(file, fmt::format("the friction of contact {} is damaged (a number is missing or not finite); prepare it again", i));
        }
    }
    return preloads;
}

/// State of n blocks in a file; nothing where it is of another number, or its lists differ in length.
std::optional<StoredSpecimen> read_blocks(const detail::Hdf5Reader& reader, std::size_t n) {
    const auto size = reader.read<double>("/blocks/size", 2), position = reader.read<double>("/blocks/position", 2);
    const auto quaternion = reader.read<double>("/blocks/quaternion", 2);
    if (size.values.size() != 3 * n || position.values.size() != 3 * n || quaternion.values.size() != 4 * n) return std::nullopt;
    StoredSpecimen stored;
    stored.layer = reader.layers("/blocks/layer", n);
    if (stored.layer.size() != n) return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) {
        stored.size.push_back(detail::Hdf5Numbers<Vector3>::make(&size.values[3 * i]));
        stored.places.position.push_back(detail::Hdf5Numbers<Vector3>::make(&position.values[3 * i]));
        stored.places.orientation.push_back(detail::Hdf5Numbers<Quaternion>::make(&quaternion.values[4 * i]));
    }
    return stored;
}

}  // namespace

std::string describe_inputs(const Scene& scene, const PreparationSettings& preparation) {
    auto inputs = nlohmann::ordered_json::parse(write_scene(scene));
    for (const char* key : kUnrelated) inputs.erase(key);
    inputs["time"].erase("duration");
    inputs["preparation"] = {{"placing", to_string(preparation.placing)},
                             {"damping_rate", preparation.settling.damping_rate},
                             {"rest", preparation.settling.rest},
                             {"reaction", preparation.settling.reaction},
                             {"patience", preparation.settling.patience},
                             {"stride", preparation.stride},
                             {"lowering", preparation.lowering},
                             {"layer_rest", preparation.layer_rest},
                             {"layer_patience", preparation.layer_patience},
                             {"added_patience", preparation.added_patience},
                             {"resting_patience", preparation.resting_patience},
                             {"early_rest", preparation.early_rest},
                             {"last_damping", preparation.last_damping},
                             {"last_damping_with_mass_scaling", preparation.last_damping_with_mass_scaling}};
    if (preparation.from_equilibrium) inputs["preparation"]["from_equilibrium"] = true;
    return inputs.dump();
}

std::string specimen_file_name(const std::string& inputs) { return "specimen-" + detail::name_content(inputs) + ".h5"; }

void write_specimen(const std::filesystem::path& file, const PreparedSpecimen& prepared, const std::string& inputs,
                    const std::string& version) {
    const Model& model = prepared.specimen.model;
    std::vector<Vector3> size, position, friction;
    std::vector<Quaternion> orientation;
    std::vector<double> offset, couple;
    std::vector<int> fallen(model.blocks.size(), 0);
    for (const MovedBlock& moved : prepared.rest.fallen) fallen[moved.block] = 1;
    for (const Block& block : model.blocks) {
        size.emplace_back(2.0 * half_extents(model, block));
        position.push_back(block.position);
        offset.push_back(block.height_offset);
        orientation.push_back(block.orientation);
    }
    std::vector<long long> leader, follower;
    for (const Preload& contact : model.preload) {
        leader.push_back(static_cast<long long>(contact.leader));
        follower.push_back(contact.follower ? static_cast<long long>(*contact.follower) : kOnGround);
        friction.emplace_back(contact.friction / weight_of(model, contact.leader));
        couple.push_back(contact.couple / couple_of_weight(model, contact.leader));
    }
    const hsize_t blocks = model.blocks.size(), contacts = model.preload.size();
    detail::Hdf5File out;
    out.exchange("/blocks/size", {blocks}, size, "m");
    detail::exchange_shapes(out, blocks, make_block_table(prepared.specimen).shapes);
    out.exchange("/blocks/height_offset", {blocks}, offset, "m");
    out.exchange("/blocks/layer", {blocks}, prepared.specimen.layer, "1");
    out.exchange("/blocks/position", {blocks}, position, "m");
    out.exchange("/blocks/quaternion", {blocks}, orientation, "1");
    out.exchange("/blocks/tilt", {blocks}, prepared.tilt, "rad");
    out.exchange("/blocks/fallen", {blocks}, fallen, "1");
    out.exchange("/contacts/normal_force_over_block_weight", {prepared.force.size()}, prepared.force, "1");
    out.exchange("/contacts/leader", {contacts}, leader, "1");
    out.exchange("/contacts/follower", {contacts}, follower, "1");
    out.exchange("/contacts/friction_over_block_weight", {contacts}, friction, "1");
    out.exchange("/contacts/couple_over_block_weight_and_height", {contacts}, couple, "1");
    out.write_attribute("format", std::string(kFormat));
    out.write_attribute("inputs", inputs);
    out.write_attribute("program_version", version);
    const std::vector<char> bytes = out.image();
    records::write_file_atomically(file, {bytes.data(), bytes.size()});
}

std::string read_specimen_inputs(const std::filesystem::path& file) {
    const detail::Hdf5Reader reader(file);
    require_specimen(reader, file);
    return reader.attribute("inputs");
}

StoredSpecimen read_specimen(const std::filesystem::path& file) {
    const detail::Hdf5Reader reader(file);
    require_specimen(reader, file);
    std::vector<double> tilt = reader.read<double>("/blocks/tilt", 1).values;
    std::optional<StoredSpecimen> specimen = read_blocks(reader, tilt.size());
    if (!specimen) refuse(file, "the lists of its blocks differ in length (a damaged file); prepare it again");
    specimen->inputs = reader.attribute("inputs");
    specimen->program_version = reader.attribute("program_version");
    detail::exchange_shapes(reader, tilt.size(), specimen->shapes);
    specimen->tilt = std::move(tilt);
    if (reader.has("/blocks/fallen")) {
        const auto fallen = reader.read<long long>("/blocks/fallen", 1).values;
        specimen->fallen = static_cast<std::size_t>(std::count(fallen.begin(), fallen.end(), 1));
    }
    specimen->force = reader.read<double>("/contacts/normal_force_over_block_weight", 1).values;
    return *std::move(specimen);
}

void take_places(const std::filesystem::path& file, Specimen& specimen) {
    const detail::Hdf5Reader reader(file);
    require_specimen(reader, file);
    std::vector<Block>& blocks = specimen.model.blocks;
    const std::size_t n = blocks.size();
    const std::optional<StoredSpecimen> stored = read_blocks(reader, n);
    if (!stored) {
        refuse(file, fmt::format("{} blocks where the scene has {} (a specimen of another structure); prepare one of this",
                                 reader.count("/blocks/layer", specimen.layer), n));
    }
    const double scale = 2.0 * half_extents(specimen.model, blocks[0]).z() / stored->size[0].z();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector3 here = 2.0 * half_extents(specimen.model, blocks[i]), there = stored->size[i];
        const bool same = ((here - scale * there).cwiseAbs() - kSameLength * here).maxCoeff() <= 0.0;
        if (!same || stored->layer[i] != specimen.layer[i]) {
            refuse(file, fmt::format("block {} is {:.6g} x {:.6g} x {:.6g} m in layer {} where the scene has {:.6g} x {:.6g} x {:.6g} m in "
                                     "layer {} (other heights, seed or tiling); prepare a specimen of this scene",
                                     i, scale * there.x(), scale * there.y(), scale * there.z(), stored->layer[i], here.x(), here.y(),
                                     here.z(), specimen.layer[i]));
        }
        blocks[i].position = scale * stored->places.position[i];
        blocks[i].orientation = stored->places.orientation[i];
        if (!blocks[i].position.allFinite() || !(std::abs(blocks[i].orientation.norm() - 1.0) < kSameRotation)) {
            refuse(file, fmt::format("the place of block {} is damaged (a number is not finite, or its quaternion is no rotation); prepare "
                                     "it again",
                                     i));
        }
    }
    specimen.model.preload = read_preloads(reader, file, specimen.model);
}

}  // namespace musim::lsdem
