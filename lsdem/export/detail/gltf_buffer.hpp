#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// The numbers of a glTF file: one buffer of three views, and the accessors that say where each list lies in them.
class GltfBuffer {
  public:
    /// Kinds of numbers, each in a view of its own.
    enum class View { vertices, indices, animation };

    /// Adds places or directions of vertices, whose bounds are kept where `bounded`; the number of their accessor.
    std::size_t add_vertices(const std::vector<Vector3>& values, bool bounded);
    /// Adds corners of triangles.
    std::size_t add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles);
    /// Adds times of key frames [s].
    std::size_t add_times(const std::vector<float>& times);
    /// Adds values of key frames, of three or four numbers each.
    std::size_t add_keys(const std::vector<float>& numbers, std::size_t width);

    /// Bytes of all views, one behind the other; each begins at a multiple of four.
    std::string bytes() const;
    std::size_t size() const;
    nlohmann::ordered_json accessors() const { return accessors_; }
    /// Views into buffer 0. Views without numbers are left out, and accessors count on that: they are asked for last.
    nlohmann::ordered_json views() const;

  private:
    std::size_t add_accessor(View view, int component, const char* type, std::size_t count, nlohmann::ordered_json bounds);
    /// Number of a view in the file; made with its first list.
    std::size_t number_of(View view);

    std::array<std::string, 3> data_;
    std::vector<View> order_;
    nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

}  // namespace musim::lsdem::detail
