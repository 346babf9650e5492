#include "lsdem/results/write_xdmf.hpp"

#include <fmt/format.h>

#include <memory>
#include <string_view>

namespace musim::lsdem::detail {
namespace {

/// Number of a polygon among XDMF's cells.
constexpr std::size_t kPolygon = 3;

/// One instant: the blocks by their topology and geometry, with whatever `attributes` describes.
std::string xdmf_grid(double time, const std::string& topology, const std::string& points, const std::string& attributes) {
    return fmt::format(
        "  <Grid Name=\"blocks\">\n   <Time Value=\"{}\"/>\n   {}\n   <Geometry GeometryType=\"XYZ\">{}</Geometry>\n{}  </Grid>\n", time,
        topology, points, attributes);
}

/// `center`: "Node" of blocks that are points, "Cell" of polygons.
std::string xdmf_attribute(std::string_view name, std::string_view type, const std::string& data, std::string_view center = "Node") {
    return fmt::format("   <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name, type, center, data);
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

/// A list of the group /surface.
std::string xdmf_list(std::string_view name, std::size_t n, std::string_view type) {
    return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"8\" Format=\"HDF\">result.h5:/surface/{}</DataItem>", n,
                       type, name);
}

/// The whole of a list, in a form that keeps ParaView from taking the geometry of one instant for that of all that follow: it does so where
/// the text of a topology, and that of a geometry, are the same.
std::string xdmf_topology(const Surface& surface) {
    const std::size_t n = surface.topology.size();
    return fmt::format(
        "<Topology TopologyType=\"Mixed\" NumberOfElements=\"{0}\"><DataItem ItemType=\"HyperSlab\" Dimensions=\"{1}\"><DataItem "
        "Dimensions=\"3 1\" Format=\"XML\">0 1 {1}</DataItem>{2}</DataItem></Topology>",
        surface.block.size(), n, xdmf_list("topology", n, "Int"));
}

/// A function of lists: "$0" is the first of `items`.
std::string xdmf_function(std::string_view function, const std::string& dimensions, const std::string& items) {
    return fmt::format("<DataItem ItemType=\"Function\" Function=\"{}\" Dimensions=\"{}\">{}</DataItem>", function, dimensions, items);
}

/// Corners of all faces, from positions and quaternions of the blocks.
std::string xdmf_corners(const Surface& surface, const std::string& positions, const std::string& quaternions) {
    constexpr std::string_view kPlace =
        "$0[$2] + $7 + ($1[$3]*($1[$5]*$9 - $1[$6]*$8) + $1[$4]*($1[$5]*$8 + $1[$6]*$9) - ($1[$5]*$1[$5] + $1[$6]*$1[$6])*$7)*2";
    const std::size_t n = surface.position.size();
    std::string items = positions + quaternions;
    for (const char* list : {"position", "quaternion", "quaternion_i", "quaternion_j", "quaternion_k"}) items += xdmf_list(list, n, "Int");
    for (const char* list : {"body_i", "body_j", "body_k"}) items += xdmf_list(list, n, "Float");
    return xdmf_function(kPlace, fmt::format("{} 3", n / 3), items);
}

/// Blocks as polygons.
class SurfaceGrids {
  public:
    explicit SurfaceGrids(const RunResult& run)
        : run_(run),
          surface_(list_surface(run.blocks)),
          blocks_(run.blocks.mass.size()),
          faces_(surface_.block.size()),
          numbers_(xdmf_attribute("block", "Scalar", xdmf_list("block", faces_, "Int"), "Cell")) {}

    std::string frame(std::size_t k) const {
        const std::size_t frames = run_.frames.time.size();
        const auto slab = [&](const char* path, int width) { return xdmf_frame(path, k, frames, blocks_, width); };
        std::string attributes =
            numbers_ + xdmf_attribute("velocity [m/s]", "Vector",
                                      xdmf_function("$0[$1]", fmt::format("{} 3", faces_),
                                                    slab("/frames/velocity", 3) + xdmf_list("velocity", 3 * faces_, "Int")),
                                      "Cell");
        if (!run_.frames.contact_force.empty()) {
            const std::string force = xdmf_frame_of_numbers("/frames/contact_force", k, frames, blocks_);
            attributes +=
                xdmf_attribute("contact force [N]", "Scalar",
                               xdmf_function("$0[$1]", fmt::format("{}", faces_), force + xdmf_list("block", faces_, "Int")), "Cell");
        }
        return xdmf_grid(run_.frames.time[k], xdmf_topology(surface_),
                         xdmf_corners(surface_, slab("/frames/position", 3), slab("/frames/quaternion", 4)), attributes);
    }

    std::string instant(double time, const char* positions, const char* quaternions) const {
        return xdmf_grid(time, xdmf_topology(surface_),
                         xdmf_corners(surface_, xdmf_data(positions, blocks_, 3, 8), xdmf_data(quaternions, blocks_, 4, 8)), numbers_);
    }

  private:
    const RunResult& run_;
    Surface surface_;
    std::size_t blocks_, faces_;
    std::string numbers_;
};

/// Blocks as points.
class PointGrids {
  public:
    explicit PointGrids(const RunResult& run)
        : run_(run),
          blocks_(run.blocks.mass.size()),
          topology_(fmt::format("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>", blocks_)),
          size_(xdmf_attribute("size [m]", "Vector", xdmf_data("/blocks/size", blocks_, 3, 8))) {}

    std::string frame(std::size_t k) const {
        const std::size_t frames = run_.frames.time.size();
        const auto slab = [&](const char* path, int width) { return xdmf_frame(path, k, frames, blocks_, width); };
        std::string attributes = size_ + xdmf_attribute("velocity [m/s]", "Vector", slab("/frames/velocity", 3)) +
                                 xdmf_attribute("quaternion", "Matrix", slab("/frames/quaternion", 4));
        if (!run_.frames.contact_force.empty()) {
            attributes += xdmf_attribute("contact force [N]", "Scalar", xdmf_frame_of_numbers("/frames/contact_force", k, frames, blocks_));
        }
        return xdmf_grid(run_.frames.time[k], topology_, slab("/frames/position", 3), attributes);
    }

    std::string instant(double time, const char* positions, const char* quaternions) const {
        return xdmf_grid(time, topology_, xdmf_data(positions, blocks_, 3, 8),
                         size_ + xdmf_attribute("quaternion", "Matrix", xdmf_data(quaternions, blocks_, 4, 8)));
    }

  private:
    const RunResult& run_;
    std::size_t blocks_;
    std::string topology_, size_;
};

template <class Grids>
std::string list_grids(const RunResult& run) {
    const Grids grids(run);
    std::string text;
    for (std::size_t k = 0; k < run.frames.time.size(); ++k) text += grids.frame(k);
    if (run.frames.time.empty()) {
        text += grids.instant(run.initial.time, "/blocks/initial_position", "/blocks/initial_quaternion");
        text += grids.instant(run.final.time, "/blocks/final_position", "/blocks/final_quaternion");
    }
    return text;
}

}  // namespace

Surface list_surface(const BlockTable& blocks) {
    Surface surface;
    const auto shapes = list_drawn_shapes(blocks.shapes, blocks.size);
    std::size_t corners = 0;
    for (std::size_t b = 0; b < shapes.size(); ++b) {
        for (const Polyhedron& piece : shapes[b]->solid.pieces) {
            for (const Polyhedron::Face& face : piece.faces) {
                if (!face.outer) continue;
                surface.topology.insert(surface.topology.end(), {kPolygon, face.count});
                for (const std::uint32_t corner : piece.loop(face)) surface.topology.push_back(corners + corner);
                surface.block.push_back(b);
                for (std::size_t axis = 0; axis < 3; ++axis) surface.velocity.push_back(3 * b + axis);
            }
            for (const Vector3& corner : piece.corners) {
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
                    surface.position.push_back(3 * b + i);
                    surface.quaternion.push_back(4 * b);
                    surface.quaternion_i.push_back(4 * b + 1 + i);
                    surface.quaternion_j.push_back(4 * b + 1 + j);
                    surface.quaternion_k.push_back(4 * b + 1 + k);
                    surface.body_i.push_back(corner[static_cast<Eigen::Index>(i)]);
                    surface.body_j.push_back(corner[static_cast<Eigen::Index>(j)]);
                    surface.body_k.push_back(corner[static_cast<Eigen::Index>(k)]);
                }
            }
            corners += piece.corners.size();
        }
    }
    return surface;
}

void write_surface(Hdf5File& file, const Surface& surface) {
    const auto write = [&](const char* name, const auto& list, const char* units) {
        file.exchange(std::string("/surface/") + name, {list.size()}, list, units);
    };
    write("topology", surface.topology, "1");
    write("block", surface.block, "1");
    write("velocity", surface.velocity, "1");
    write("position", surface.position, "1");
    write("quaternion", surface.quaternion, "1");
    write("quaternion_i", surface.quaternion_i, "1");
    write("quaternion_j", surface.quaternion_j, "1");
    write("quaternion_k", surface.quaternion_k, "1");
    write("body_i", surface.body_i, "m");
    write("body_j", surface.body_j, "m");
    write("body_k", surface.body_k, "m");
}

std::string make_xdmf(const RunResult& run) {
    return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n  <Grid GridType=\"Collection\" CollectionType=\"Temporal\">\n" +
           (run.blocks.shapes.any() ? list_grids<SurfaceGrids>(run) : list_grids<PointGrids>(run)) + "  </Grid>\n </Domain>\n</Xdmf>\n";
}

}  // namespace musim::lsdem::detail
