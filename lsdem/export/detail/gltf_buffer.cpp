#include "lsdem/export/detail/gltf_buffer.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace musim::lsdem::detail {
namespace {

using Json = nlohmann::ordered_json;

// glTF is little endian, as is every machine that musim runs on
static_assert(std::endian::native == std::endian::little);

/// Numbers of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

template <class Number>
void append_number(std::string& bytes, Number number) {
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), &number, sizeof(Number));
    bytes.append(raw.data(), raw.size());
}

}  // namespace

std::size_t GltfBuffer::number_of(View view) {
    const auto found = std::find(order_.begin(), order_.end(), view);
    const auto number = static_cast<std::size_t>(found - order_.begin());
    if (found == order_.end()) order_.push_back(view);
    return number;
}

std::size_t GltfBuffer::add_accessor(View view, int component, const char* type, std::size_t count, Json bounds) {
    Json accessor = {{"bufferView", number_of(view)}, {"byteOffset", data_[static_cast<std::size_t>(view)].size()}};
    accessor.update({{"componentType", component}, {"count", count}, {"type", type}});
    accessor.update(bounds);
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

std::size_t GltfBuffer::add_vertices(const std::vector<Vector3>& values, bool bounded) {
    Json bounds = Json::object();
    if (bounded) {
        // bounds are those of the numbers as they are written
        Eigen::Vector3f low = values.front().cast<float>(), high = low;
        for (const Vector3& value : values) low = low.cwiseMin(value.cast<float>()), high = high.cwiseMax(value.cast<float>());
        bounds = {{"min", {low.x(), low.y(), low.z()}}, {"max", {high.x(), high.y(), high.z()}}};
    }
    const std::size_t number = add_accessor(View::vertices, kFloat, "VEC3", values.size(), std::move(bounds));
    for (const Vector3& value : values) {
        for (int axis = 0; axis < 3; ++axis) append_number(data_[0], static_cast<float>(value[axis]));
    }
    return number;
}

std::size_t GltfBuffer::add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const std::size_t number = add_accessor(View::indices, kUnsignedInt, "SCALAR", 3 * triangles.size(), Json::object());
    for (const auto& triangle : triangles) {
        for (const std::uint32_t corner : triangle) append_number(data_[1], corner);
    }
    return number;
}

std::size_t GltfBuffer::add_times(const std::vector<float>& times) {
    const std::size_t number =
        add_accessor(View::animation, kFloat, "SCALAR", times.size(), {{"min", {times.front()}}, {"max", {times.back()}}});
    for (const float time : times) append_number(data_[2], time);
    return number;
}

std::size_t GltfBuffer::add_keys(const std::vector<float>& numbers, std::size_t width) {
    const std::size_t number = add_accessor(View::animation, kFloat, width == 3 ? "VEC3" : "VEC4", numbers.size() / width, Json::object());
    for (const float value : numbers) append_number(data_[2], value);
    return number;
}

std::size_t GltfBuffer::size() const { return data_[0].size() + data_[1].size() + data_[2].size(); }

std::string GltfBuffer::bytes() const {
    std::string all;
    for (const View view : order_) all += data_[static_cast<std::size_t>(view)];
    return all;
}

Json GltfBuffer::views() const {
    Json views = Json::array();
    std::size_t offset = 0;
    for (const View view : order_) {
        const std::size_t length = data_[static_cast<std::size_t>(view)].size();
        Json json = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
        if (view == View::vertices) json.update({{"byteStride", 12}, {"target", kArrayBuffer}});
        if (view == View::indices) json["target"] = kElementArrayBuffer;
        views.push_back(std::move(json));
        offset += length;
    }
    return views;
}

}  // namespace musim::lsdem::detail
