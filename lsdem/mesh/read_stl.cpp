#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lsdem/mesh/detail/binary_numbers.hpp"
#include "lsdem/mesh/detail/mesh_making.hpp"
#include "lsdem/mesh/detail/mesh_words.hpp"
#include "lsdem/mesh/read_mesh.hpp"

namespace musim::lsdem {
namespace {

using detail::is_word;
using detail::MeshMaking;
using detail::MeshWords;

constexpr std::size_t kStlHeader = 84;    // bytes: 80 of any text, the number of triangles
constexpr std::size_t kStlTriangle = 50;  // bytes: normal and three corners of three 32-bit numbers, two of colour
constexpr std::size_t kStlNormal = 12;    // bytes

Mesh parse_binary_stl(std::string_view bytes, std::size_t triangles, const std::string& file, const MeshLimits& limits) {
    MeshMaking making(file, "binary STL", limits);
    making.mesh().indexed = false;
    making.mesh().single_precision = true;
    for (std::size_t t = 0; t < triangles; ++t) {
        const char* const corners = bytes.data() + kStlHeader + t * kStlTriangle + kStlNormal;
        for (std::size_t c = 0; c < 3; ++c) {
            Vector3 x;
            for (std::size_t a = 0; a < 3; ++a) {
                const auto value = detail::load_number<float>(corners + 4 * (3 * c + a), std::endian::little);
                if (!std::isfinite(value)) {
                    detail::fail_mesh(file, 0, fmt::format("triangle {} has a corner whose {} is {}", t + 1, "xyz"[a], value),
                                      "correct or remove it");
                }
                x[static_cast<Eigen::Index>(a)] = static_cast<double>(value) + 0.0;  // -0 is 0
            }
            making.add_corner(static_cast<std::uint32_t>(making.vertices()));
            making.add_vertex(x);
        }
        making.end_face(0);
    }
    return making.take();
}

/// The words of a text, with one of them looked at before it is taken.
class StlText {
  public:
    explicit StlText(MeshWords& words) : words_(&words), ahead_(words.next()) {}

    std::string_view ahead() const { return ahead_; }
    std::string_view take() {
        const std::string_view word = ahead_;
        ahead_ = words_->next();
        return word;
    }
    void require(std::string_view keyword) {
        if (!is_word(ahead_, keyword)) {
            words_->fail(fmt::format("{} stands where '{}' should", detail::quote_word(ahead_), keyword),
                         ahead_.empty() ? "the file has lost its end" : "correct the file");
        }
        take();
    }
    double take_coordinate(std::string_view meaning) {
        const double value = detail::parse_coordinate(*words_, ahead_, meaning);
        take();
        return value;
    }
    bool is_facet_ahead() const {
        MeshWords rest = *words_;
        return is_word(ahead_, "facet") && is_word(rest.next(), "normal");
    }
    std::size_t line() const { return words_->line(); }
    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const { words_->fail(problem, remedy); }

  private:
    MeshWords* words_;
    std::string_view ahead_;
};

/// One facet; its normal is what its corners say.
void parse_facet(StlText& text, MeshMaking& making) {
    const std::size_t line = text.line();
    text.require("facet");
    text.require("normal");
    for (int i = 0; i < 3; ++i) {
        if (is_word(text.ahead(), "outer")) text.fail("a normal has fewer than three numbers", "correct the facet");
        text.take();
    }
    text.require("outer");
    text.require("loop");
    for (int c = 0; c < 3; ++c) {
        text.require("vertex");
        Vector3 x;
        for (Eigen::Index a = 0; a < 3; ++a) x[a] = text.take_coordinate(std::string_view("xyz").substr(static_cast<std::size_t>(a), 1));
        making.add_corner(static_cast<std::uint32_t>(making.vertices()));
        making.add_vertex(x);
    }
    text.require("endloop");
    text.require("endfacet");
    making.end_face(line);
}

/// The words behind "solid", up to the first facet or the end of the solid.
std::vector<std::string_view> parse_solid_name(StlText& text) {
    std::vector<std::string_view> name;
    while (!text.ahead().empty() && !is_word(text.ahead(), "endsolid") && !text.is_facet_ahead()) name.push_back(text.take());
    return name;
}

/// Passes the words behind "endsolid" before the next solid: the name again, or another.
void skip_solid_name(StlText& text, const std::vector<std::string_view>& name) {
    for (const std::string_view word : name) {
        if (text.ahead() != word) break;
        text.take();
    }
    while (!text.ahead().empty() && !is_word(text.ahead(), "solid")) {
        if (text.is_facet_ahead()) text.fail("a facet stands behind the end of its solid", "correct the file");
        text.take();
    }
}

Mesh parse_text_stl(std::string_view bytes, const std::string& file, const MeshLimits& limits) {
    MeshMaking making(file, "text STL", limits);
    making.mesh().indexed = false;
    MeshWords words(bytes, file);
    StlText text(words);
    while (!text.ahead().empty()) {
        text.require("solid");
        const std::vector<std::string_view> name = parse_solid_name(text);
        making.choose_group({.object = {}, .name = fmt::format("{}", fmt::join(name, " "))});
        while (!is_word(text.ahead(), "endsolid")) parse_facet(text, making);
        text.require("endsolid");
        skip_solid_name(text, name);
    }
    return making.take();
}

}  // namespace

Mesh parse_stl(std::string_view bytes, const std::string& file, const MeshLimits& limits) {
    // many binary files begin with the word "solid", too: the length decides
    std::size_t triangles = 0, needed = 0;
    if (bytes.size() >= kStlHeader) {
        triangles = detail::load_number<std::uint32_t>(bytes.data() + kStlHeader - 4, std::endian::little);
        needed = kStlHeader + triangles * kStlTriangle;
        if (bytes.size() == needed) return parse_binary_stl(bytes, triangles, file, limits);
    }
    // no text has a zero byte
    const bool text = bytes.find('\0') == std::string_view::npos;
    MeshWords words(bytes, file);
    if (text && is_word(words.next(), "solid")) return parse_text_stl(bytes, file, limits);
    if (text || needed == 0) {
        detail::fail_mesh(file, 0, "is no STL: it neither begins with 'solid' nor has the length of a binary one", "is it the right file?");
    }
    detail::fail_mesh(
        file, 0, fmt::format("has {} bytes, but its {} triangles take {}", bytes.size(), triangles, needed),
        bytes.size() < needed ? "the file has lost its end; write it again" : "write it again without what stands behind them");
}

}  // namespace musim::lsdem
