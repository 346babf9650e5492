#include "lsdem/export/gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "lsdem/export/base64.hpp"
#include "lsdem/export/detail/gltf_buffer.hpp"
#include "lsdem/export/surface_mesh.hpp"
#include "lsdem/plot/body_view.hpp"
#include "records/error.hpp"

namespace musim::lsdem {
namespace {

using Json = nlohmann::ordered_json;

/// Parts of a .glb: its own header, and that of each chunk [bytes].
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942, kHeader = 12, kChunkHeader = 8;

/// Bytes of numbers in a file: those whose places 31 bits can say, which readers count on.
constexpr std::size_t kMostNumbers = std::size_t{1} << 31U;

void append_word(std::string& bytes, std::uint32_t word) {
    for (unsigned byte = 0; byte < 4; ++byte) bytes += static_cast<char>(word >> 8U * byte & 0xFFU);
}

void pad(std::string& bytes, char filling) { bytes.resize((bytes.size() + 3) / 4 * 4, filling); }

/// A part of "#rrggbb" as glTF wants it: linear [IEC 61966-2-1].
double find_linear(const std::string& color, std::size_t at) {
    const double share = std::stoi(color.substr(at, 2), nullptr, 16) / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

/// Quaternion (x, y, z, w) of unit length, the order of glTF.
std::array<float, 4> write_turn(const Eigen::Vector4d& wxyz) {
    const Eigen::Vector4d unit = wxyz.normalized();
    return {static_cast<float>(unit[1]), static_cast<float>(unit[2]), static_cast<float>(unit[3]), static_cast<float>(unit[0])};
}

class GltfDocument {
  public:
    GltfDocument(const ExportedBlocks& exported, const std::string& version) : exported_(exported) {
        document_["asset"] = {{"version", "2.0"}, {"generator", "musim " + version}, {"extras", make_extras()}};
        document_["scene"] = 0;
        document_["scenes"] = Json::array({{{"name", exported.name}, {"nodes", {0}}}});
        add_nodes();
        add_animation();
    }

    std::string write(GltfForm form) {
        if (buffer_.size() > kMostNumbers) {
            throw records::WriteError(fmt::format(
                "the motion takes {:.2g} GB, and readers of glTF take 2 (too many frames, or blocks); run the scene again with a lower "
                "output.frame_rate",
                1e-9 * static_cast<double>(buffer_.size())));
        }
        const std::string numbers = buffer_.bytes();
        document_["buffers"] = Json::array({{{"byteLength", numbers.size()}}});
        document_["bufferViews"] = buffer_.views();
        document_["accessors"] = buffer_.accessors();
        if (form == GltfForm::binary) return write_binary(numbers);
        document_["buffers"][0]["uri"] = "data:application/octet-stream;base64," + encode_base64(numbers);
        return dump();
    }

  private:
    std::string dump() const { return document_.dump(-1, ' ', false, Json::error_handler_t::replace); }

    std::string write_binary(const std::string& numbers) const {
        std::string json = dump(), bin = numbers;
        pad(json, ' ');
        pad(bin, '\0');
        std::string bytes;
        append_word(bytes, kMagic);
        append_word(bytes, kVersion);
        append_word(bytes, static_cast<std::uint32_t>(kHeader + 2 * kChunkHeader + json.size() + bin.size()));
        append_word(bytes, static_cast<std::uint32_t>(json.size()));
        append_word(bytes, kJsonChunk);
        bytes += json;
        append_word(bytes, static_cast<std::uint32_t>(bin.size()));
        append_word(bytes, kBinChunk);
        return bytes + bin;
    }

    Json make_extras() const {
        const scaling::Similitude& similitude = exported_.similitude;
        Json extras = {{"name", exported_.name},
                       {"units", {{"length", "m"}, {"time", "s"}, {"mass", "kg"}}},
                       {"axes", "below the root node z is up, as in the scene; the root node turns it into y"},
                       {"frames", exported_.frames.time.size()},
                       {"prototype_time_over_time", 1.0 / similitude.time()},
                       {"prototype_length_over_length", 1.0 / similitude.length()}};
        if (!exported_.frames.time.empty()) {
            extras["time_s"] = {exported_.frames.time.front(), exported_.frames.time.back()};
            extras["prototype_time_s"] = {exported_.frames.time.front() / similitude.time(),
                                          exported_.frames.time.back() / similitude.time()};
        }
        return extras;
    }

    /// Root node, and one node a block.
    void add_nodes() {
        const double half = 0.5 * std::numbers::sqrt2;
        Json children = Json::array(), nodes = Json::array();
        for (std::size_t b = 0; b < exported_.blocks.size(); ++b) children.push_back(b + 1);
        nodes.push_back({{"name", exported_.name.empty() ? "musim" : exported_.name}, {"rotation", {-half, 0.0, 0.0, half}}});
        if (!children.empty()) nodes[0]["children"] = std::move(children);
        for (std::size_t b = 0; b < exported_.blocks.size(); ++b) {
            const ExportedBlock& block = exported_.blocks[b];
            const Quaternion& q = block.orientation;
            const Eigen::Vector3f place = block.position.cast<float>();
            Json extras = {{"block", b}, {"mass_kg", block.mass}, {"layer", block.layer}};
            if (!block.material.empty()) extras["material"] = block.material;
            if (!block.shape->name.empty()) extras["shape"] = block.shape->name;
            nodes.push_back({{"name", block.name},
                             {"mesh", find_or_add_mesh(block)},
                             {"translation", {place.x(), place.y(), place.z()}},
                             {"rotation", write_turn({q.w(), q.x(), q.y(), q.z()})},
                             {"extras", std::move(extras)}});
        }
        document_["nodes"] = std::move(nodes);
    }

    std::size_t find_or_add_material(const std::string& name) {
        const auto [found, is_new] = materials_.try_emplace(name, materials_.size());
        if (is_new) {
            const std::string color = find_swatch(static_cast<int>(found->second));
            Json looks = {{"baseColorFactor", {find_linear(color, 1), find_linear(color, 3), find_linear(color, 5), 1.0}},
                          {"metallicFactor", 0.0},
                          {"roughnessFactor", 0.9}};
            document_["materials"].push_back({{"name", name.empty() ? "blocks" : name}, {"pbrMetallicRoughness", std::move(looks)}});
        }
        return found->second;
    }

    /// Meshes of one shape in several materials share their numbers.
    std::size_t find_or_add_mesh(const ExportedBlock& block) {
        const std::size_t material = find_or_add_material(block.material);
        const auto [found, is_new] = meshes_.try_emplace({block.shape.get(), material}, meshes_.size());
        if (!is_new) return found->second;
        auto list = lists_.find(block.shape.get());
        if (list == lists_.end()) {
            const SurfaceMesh mesh = make_surface_mesh(*block.shape);
            const std::size_t places = buffer_.add_vertices(mesh.places, true), normals = buffer_.add_vertices(mesh.normals, false);
            list = lists_.emplace(block.shape.get(), std::array{places, normals, buffer_.add_indices(mesh.triangles)}).first;
        }
        Json primitive = {{"attributes", {{"POSITION", list->second[0]}, {"NORMAL", list->second[1]}}},
                          {"indices", list->second[2]},
                          {"material", material}};
        Json mesh = {{"primitives", Json::array({std::move(primitive)})}};
        mesh["name"] = block.shape->name.empty() ? "box" : block.shape->name;
        document_["meshes"].push_back(std::move(mesh));
        return found->second;
    }

    /// Translation and rotation of every block that moves.
    void add_animation() {
        const Frames& frames = exported_.frames;
        const std::size_t n = exported_.blocks.size();
        if (frames.time.size() < 2) return;
        std::vector<float> times(frames.time.begin(), frames.time.end());
        Json channels = Json::array(), samplers = Json::array();
        std::optional<std::size_t> input;
        const auto add = [&](std::size_t block, const char* path, const std::vector<float>& keys, std::size_t width) {
            const auto differs = [&](std::size_t k) {
                return !std::equal(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(width), &keys[k * width]);
            };
            bool moves = false;
            for (std::size_t k = 1; k < times.size() && !moves; ++k) moves = differs(k);
            if (!moves) return;
            if (!input) input = buffer_.add_times(times);
            channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", block + 1}, {"path", path}}}});
            samplers.push_back({{"input", *input}, {"interpolation", "LINEAR"}, {"output", buffer_.add_keys(keys, width)}});
        };
        for (std::size_t b = 0; b < n; ++b) {
            std::vector<float> places, turns;
            Eigen::Vector4d before = frames.quaternion[b].cast<double>();
            for (std::size_t k = 0; k < times.size(); ++k) {
                const Eigen::Vector3f& place = frames.position[k * n + b];
                places.insert(places.end(), {place.x(), place.y(), place.z()});
                // of the two quaternions of a turn the one nearer to that before it
                Eigen::Vector4d now = frames.quaternion[k * n + b].cast<double>();
                if (now.dot(before) < 0.0) now = -now;
                before = now;
                const std::array<float, 4> turn = write_turn(now);
                turns.insert(turns.end(), turn.begin(), turn.end());
            }
            require_finite(places, turns, b);
            add(b, "translation", places, 3);
            add(b, "rotation", turns, 4);
        }
        if (channels.empty()) return;
        document_["animations"] = Json::array({{{"name", "motion"}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}}});
    }

    static void require_finite(const std::vector<float>& places, const std::vector<float>& turns, std::size_t block) {
        const auto finite = [](float number) { return std::isfinite(number); };
        if (std::all_of(places.begin(), places.end(), finite) && std::all_of(turns.begin(), turns.end(), finite)) return;
        throw records::WriteError(
            fmt::format("the frames of block {} are no poses (the run diverged, or is damaged); run it again", block));
    }

    const ExportedBlocks& exported_;
    Json document_;
    detail::GltfBuffer buffer_;
    std::map<std::string, std::size_t> materials_;
    std::map<std::pair<const BlockShape*, std::size_t>, std::size_t> meshes_;
    std::map<const BlockShape*, std::array<std::size_t, 3>> lists_;  ///< accessors of places, normals and triangles
};

}  // namespace

std::string make_gltf(const ExportedBlocks& exported, GltfForm form, const std::string& version) {
    return GltfDocument(exported, version).write(form);
}

}  // namespace musim::lsdem
