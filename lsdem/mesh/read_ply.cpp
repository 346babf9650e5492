#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "lsdem/mesh/detail/binary_numbers.hpp"
#include "lsdem/mesh/detail/mesh_making.hpp"
#include "lsdem/mesh/detail/mesh_words.hpp"
#include "lsdem/mesh/detail/ply_header.hpp"
#include "lsdem/mesh/read_mesh.hpp"

namespace musim::lsdem {
namespace {

using detail::is_word;
using detail::MeshMaking;
using detail::MeshWords;
using detail::PlyElement;
using detail::PlyHeader;
using detail::PlyProperty;
using detail::PlyType;

/// The numbers behind the header, one after the other.
class PlyNumbers {
  public:
    PlyNumbers(MeshWords& words, std::string_view bytes, const PlyHeader& header)
        : words_(&words), bytes_(bytes), order_(header.order), offset_(header.size) {}

    /// A number, which a binary file may have as not finite; `meaning` of it for messages.
    double take_real(PlyType type, std::string_view meaning) {
        return order_ ? load(type) : detail::parse_coordinate(*words_, words_->next(), meaning);
    }

    long long take_whole(PlyType type, std::string_view meaning) {
        if (order_) return static_cast<long long>(load(type));
        const std::string_view word = words_->next();
        const std::optional<long long> value = detail::parse_whole(word);
        if (!value) fail(fmt::format("{} is {}, no whole number", meaning, detail::quote_word(word)), "correct the file");
        return *value;
    }

    void skip(PlyType type) {
        if (order_) {
            load(type);
        } else if (words_->next().empty()) {
            fail("the last rows of the header's elements are missing", "the file has lost its end; write it again");
        }
    }

    /// Fails where anything but blanks stands behind the last row.
    void require_end() {
        const bool ended = order_ ? bytes_.find_first_not_of(" \t\r\n", offset_) == std::string_view::npos : words_->next().empty();
        if (!ended) fail("something stands behind the rows that the header counts", "correct the header's counts");
    }

    bool is_binary() const { return order_.has_value(); }
    std::size_t line() const { return order_ ? 0 : words_->line(); }

    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
        detail::fail_mesh(words_->file(), line(), problem, remedy);
    }

  private:
    /// The next number of a binary file; a double holds those of every type.
    double load(PlyType type) {
        const std::size_t size = detail::find_size(type);
        if (bytes_.size() - offset_ < size) {
            fail("the last rows of the header's elements are missing", "the file has lost its end; write it again");
        }
        const char* const bytes = bytes_.data() + offset_;
        offset_ += size;
        switch (type) {
            case PlyType::int8:
                return detail::load_number<std::int8_t>(bytes, *order_);
            case PlyType::uint8:
                return detail::load_number<std::uint8_t>(bytes, *order_);
            case PlyType::int16:
                return detail::load_number<std::int16_t>(bytes, *order_);
            case PlyType::uint16:
                return detail::load_number<std::uint16_t>(bytes, *order_);
            case PlyType::int32:
                return detail::load_number<std::int32_t>(bytes, *order_);
            case PlyType::uint32:
                return detail::load_number<std::uint32_t>(bytes, *order_);
            case PlyType::float32:
                return static_cast<double>(detail::load_number<float>(bytes, *order_));
            case PlyType::float64:
                return detail::load_number<double>(bytes, *order_);
        }
        return 0.0;
    }

    MeshWords* words_;
    std::string_view bytes_;
    std::optional<std::endian> order_;
    std::size_t offset_;
};

/// Passes a property that is of no use.
void skip_property(PlyNumbers& numbers, const PlyProperty& property) {
    const long long count = property.count ? numbers.take_whole(*property.count, "the count of a list") : 1;
    for (long long i = 0; i < count; ++i) numbers.skip(property.type);
}

/// The axis of a coordinate among the properties of a vertex.
std::optional<Eigen::Index> find_axis(const PlyProperty& property) {
    for (Eigen::Index a = 0; a < 3; ++a) {
        if (!property.count && is_word(property.name, std::string_view("xyz").substr(static_cast<std::size_t>(a), 1))) return a;
    }
    return std::nullopt;
}

void read_vertices(PlyNumbers& numbers, const PlyElement& element, MeshMaking& making) {
    bool found[3] = {false, false, false};
    making.mesh().single_precision = numbers.is_binary();
    for (const PlyProperty& property : element.properties) {
        const std::optional<Eigen::Index> axis = find_axis(property);
        if (!axis) continue;
        found[*axis] = true;
        if (property.type == PlyType::float64) making.mesh().single_precision = false;
    }
    if (!found[0] || !found[1] || !found[2]) numbers.fail("element vertex has not the properties x, y and z", "write them");
    for (std::size_t v = 0; v < element.rows; ++v) {
        Vector3 x = Vector3::Zero();
        for (const PlyProperty& property : element.properties) {
            const std::optional<Eigen::Index> axis = find_axis(property);
            if (!axis) {
                skip_property(numbers, property);
                continue;
            }
            const double value = numbers.take_real(property.type, property.name);
            if (!std::isfinite(value)) {
                numbers.fail(fmt::format("{} of vertex {}, counted from 0, is {}", property.name, v, value), "correct or remove it");
            }
            x[*axis] = value + 0.0;  // -0 is 0
        }
        making.add_vertex(x);
    }
}

void read_faces(PlyNumbers& numbers, const PlyElement& element, MeshMaking& making) {
    const auto is_corners = [](const PlyProperty& property) {
        return property.count && is_whole(property.type) &&
               (is_word(property.name, "vertex_indices") || is_word(property.name, "vertex_index"));
    };
    if (std::none_of(element.properties.begin(), element.properties.end(), is_corners)) {
        numbers.fail("element face has no list vertex_indices of whole numbers", "write it");
    }
    for (std::size_t f = 0; f < element.rows; ++f) {
        std::size_t line = 0;
        for (const PlyProperty& property : element.properties) {
            if (!is_corners(property)) {
                skip_property(numbers, property);
                continue;
            }
            const long long count = numbers.take_whole(*property.count, "the number of corners");
            line = numbers.line();
            for (long long c = 0; c < count; ++c) {
                const long long vertex = numbers.take_whole(property.type, "a corner");
                if (vertex < 0 || vertex > std::numeric_limits<std::uint32_t>::max()) {
                    numbers.fail(fmt::format("a corner of face {} is vertex {}", f + 1, vertex), "correct the face");
                }
                making.add_corner(static_cast<std::uint32_t>(vertex));
            }
        }
        making.end_face(line);
    }
}

}  // namespace

Mesh parse_ply(std::string_view bytes, const std::string& file, const MeshLimits& limits) {
    MeshWords words(bytes, file);
    const PlyHeader header = detail::parse_ply_header(words, bytes);
    MeshMaking making(file, header.order ? "binary PLY" : "text PLY", limits);
    PlyNumbers numbers(words, bytes, header);
    bool found_faces = false;
    for (const PlyElement& element : header.elements) {
        if (element.properties.empty()) continue;
        if (is_word(element.name, "vertex")) {
            read_vertices(numbers, element, making);
        } else if (is_word(element.name, "face")) {
            read_faces(numbers, element, making);
            found_faces = true;
        } else {
            for (std::size_t row = 0; row < element.rows; ++row) {
                for (const PlyProperty& property : element.properties) skip_property(numbers, property);
            }
        }
    }
    numbers.require_end();
    if (!found_faces) numbers.fail("has no element face", "write its surface as faces, not as points or strips");
    return making.take();
}

}  // namespace musim::lsdem
