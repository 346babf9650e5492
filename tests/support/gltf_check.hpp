#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace musim::tests {

/// A glTF file as the specification has it: JSON, its one buffer, and what is wrong with it, one sentence each.
class GltfCheck {
  public:
    /// Reads and checks the bytes of a .glb.
    explicit GltfCheck(const std::string& glb) {
        open(glb);
        if (faults.empty()) check();
    }

    nlohmann::json json;
    std::string buffer;
    std::vector<std::string> faults;

    /// Numbers of an accessor, one item after another.
    std::vector<double> read(std::size_t accessor) const {
        const auto& a = json["accessors"][accessor];
        const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        const std::size_t width = width_of(a), stride = view.value("byteStride", 4 * width);
        const std::size_t begin = view["byteOffset"].get<std::size_t>() + a.value("byteOffset", std::size_t{0});
        std::vector<double> numbers;
        for (std::size_t i = 0; i < a["count"].get<std::size_t>(); ++i) {
            for (std::size_t k = 0; k < width; ++k) {
                const std::uint32_t raw = word(buffer, begin + i * stride + 4 * k);
                float number = 0.0F;
                std::memcpy(&number, &raw, sizeof(number));
                numbers.push_back(a["componentType"] == 5125 ? static_cast<double>(raw) : static_cast<double>(number));
            }
        }
        return numbers;
    }

  private:
    void open(const std::string& glb) {
        if (glb.size() < 28 || word(glb, 0) != 0x46546C67 || word(glb, 4) != 2) return fail("no header of glTF 2");
        if (word(glb, 8) != glb.size()) fail("the header has another length than the file");
        const std::size_t json_size = word(glb, 12), bin_at = 20 + json_size;
        if (json_size % 4 != 0 || word(glb, 16) != 0x4E4F534A || bin_at + 8 > glb.size()) return fail("no chunk of JSON");
        json = nlohmann::json::parse(glb.substr(20, json_size));
        const std::size_t bin_size = word(glb, bin_at);
        if (bin_size % 4 != 0 || word(glb, bin_at + 4) != 0x004E4942 || bin_at + 8 + bin_size != glb.size()) {
            return fail("no chunk of numbers");
        }
        buffer = glb.substr(bin_at + 8, bin_size);
        const std::size_t says = json["buffers"][0]["byteLength"];
        if (says > buffer.size() || says + 3 < buffer.size()) fail("the buffer has another length");
    }

    void fail(const std::string& fault) { faults.push_back(fault); }

    static std::uint32_t word(const std::string& bytes, std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof(value));
        return value;
    }

    static std::size_t width_of(const nlohmann::json& accessor) {
        return accessor["type"] == "SCALAR" ? 1 : accessor["type"] == "VEC3" ? 3 : 4;
    }

    void check() {
        if (json["asset"]["version"] != "2.0") fail("no version");
        check_views();
        check_accessors();
        if (!faults.empty()) return;
        for (const auto& mesh : json["meshes"]) {
            for (const auto& primitive : mesh["primitives"]) check_primitive(primitive);
        }
        check_nodes();
        for (const auto& animation : json.value("animations", nlohmann::json::array())) check_animation(animation);
    }

    void check_views() {
        std::size_t end = 0;
        for (const auto& view : json["bufferViews"]) {
            const std::size_t offset = view["byteOffset"], length = view["byteLength"];
            if (view["buffer"] != 0 || length == 0 || offset != end || offset % 4 != 0) fail("a view of the buffer lies wrong");
            end = offset + length;
        }
        if (end != json["buffers"][0]["byteLength"]) fail("views do not fill the buffer");
    }

    void check_accessors() {
        for (std::size_t i = 0; i < json["accessors"].size(); ++i) {
            const auto& a = json["accessors"][i];
            const auto& view = json["bufferViews"].at(a["bufferView"].get<std::size_t>());
            const std::size_t width = width_of(a), stride = view.value("byteStride", 4 * width), count = a["count"];
            const std::size_t offset = a.value("byteOffset", std::size_t{0});
            if (count == 0 || offset % 4 != 0 || offset + (count - 1) * stride + 4 * width > view["byteLength"].get<std::size_t>()) {
                return fail("an accessor goes beyond its view");
            }
            if (a.contains("min")) check_bounds(i);
        }
    }

    void check_bounds(std::size_t accessor) {
        const std::vector<double> numbers = read(accessor);
        const auto& a = json["accessors"][accessor];
        const std::size_t width = width_of(a);
        for (std::size_t k = 0; k < width; ++k) {
            double low = numbers[k], high = numbers[k];
            for (std::size_t i = k; i < numbers.size(); i += width) low = std::fmin(low, numbers[i]), high = std::fmax(high, numbers[i]);
            if (a["min"][k] != low || a["max"][k] != high) fail("bounds of an accessor are not those of its numbers");
        }
    }

    void check_primitive(const nlohmann::json& primitive) {
        const std::size_t position = primitive["attributes"]["POSITION"], normal = primitive["attributes"]["NORMAL"];
        if (!json["accessors"][position].contains("min")) fail("places without bounds");
        if (primitive["material"] >= json["materials"].size()) fail("a material that is not there");
        const std::vector<double> p = read(position), n = read(normal), triangles = read(primitive["indices"]);
        if (p.size() != n.size() || triangles.size() % 3 != 0) return fail("lists of a mesh differ in length");
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            std::array<std::size_t, 3> corner{};
            for (std::size_t k = 0; k < 3; ++k) corner[k] = static_cast<std::size_t>(triangles[t + k]);
            for (const std::size_t c : corner) {
                if (3 * c >= p.size()) return fail("a triangle has a corner that is not there");
            }
            check_triangle(corner, p, n);
        }
    }

    /// Counter-clockwise about its normal, which is of unit length.
    void check_triangle(const std::array<std::size_t, 3>& corner, const std::vector<double>& p, const std::vector<double>& n) {
        std::array<double, 3> u{}, v{}, m{};
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = p[3 * corner[1] + k] - p[3 * corner[0] + k];
            v[k] = p[3 * corner[2] + k] - p[3 * corner[0] + k];
            m[k] = n[3 * corner[0] + k];
        }
        const double about = m[0] * (u[1] * v[2] - u[2] * v[1]) + m[1] * (u[2] * v[0] - u[0] * v[2]) + m[2] * (u[0] * v[1] - u[1] * v[0]);
        if (!(about > 0.0)) fail("a triangle looks inward, or has no area");
        if (std::abs(std::hypot(m[0], m[1], m[2]) - 1.0) > 1e-6) fail("a normal is not of unit length");
    }

    void check_nodes() {
        std::set<std::size_t> below;
        for (const auto& node : json["nodes"]) {
            if (node.contains("mesh") && node["mesh"] >= json["meshes"].size()) fail("a mesh that is not there");
            for (const std::size_t child : node.value("children", std::vector<std::size_t>{})) {
                if (child >= json["nodes"].size() || !below.insert(child).second) fail("a node that is not there, or below two");
            }
        }
        if (below.size() + 1 != json["nodes"].size() || below.contains(0)) fail("a node outside the scene");
    }

    void check_animation(const nlohmann::json& animation) {
        std::set<std::pair<std::size_t, std::string>> targets;
        for (const auto& channel : animation["channels"]) {
            const auto& sampler = animation["samplers"].at(channel["sampler"].get<std::size_t>());
            const auto& input = json["accessors"].at(sampler["input"].get<std::size_t>());
            const auto& output = json["accessors"].at(sampler["output"].get<std::size_t>());
            const std::string path = channel["target"]["path"];
            if (input["count"] != output["count"] || !input.contains("min")) fail("key frames and their times differ in number");
            if (output["type"] != (path == "rotation" ? "VEC4" : "VEC3")) fail("key frames of another kind");
            if (!targets.emplace(channel["target"]["node"], path).second) fail("two channels move the same");
            const std::vector<double> times = read(sampler["input"]), keys = read(sampler["output"]);
            for (std::size_t k = 1; k < times.size(); ++k) {
                if (!(times[k] > times[k - 1])) fail("times of key frames do not go on");
            }
            for (std::size_t k = 0; path == "rotation" && k < keys.size(); k += 4) {
                const double length =
                    std::sqrt(keys[k] * keys[k] + keys[k + 1] * keys[k + 1] + keys[k + 2] * keys[k + 2] + keys[k + 3] * keys[k + 3]);
                if (std::abs(length - 1.0) > 1e-6) fail("a rotation is not of unit length");
            }
        }
    }
};

}  // namespace musim::tests
