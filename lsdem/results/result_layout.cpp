#include "lsdem/results/result_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/rotation.hpp"

namespace musim::lsdem::detail {
namespace {

std::string group_of(std::size_t shape) { return fmt::format("/shapes/{}", shape); }

/// Corners of a face, into those of the shape.
std::span<const std::size_t> find_corners(const ShapeLists& lists, std::size_t face) {
    const std::size_t begin = lists.first[face], end = face + 1 < lists.first.size() ? lists.first[face + 1] : lists.face_corners.size();
    if (begin > end || end > lists.face_corners.size()) throw std::invalid_argument("its faces have no corners of their own");
    return std::span(lists.face_corners).subspan(begin, end - begin);
}

/// A convex piece of a shape: the faces from `begin` to `end`.
Polyhedron make_piece(const ShapeLists& lists, std::size_t begin, std::size_t end) {
    std::map<std::size_t, std::uint32_t> number;  // of the piece's corners, by those of the shape
    for (std::size_t f = begin; f < end; ++f) {
        for (const std::size_t corner : find_corners(lists, f)) number[corner] = 0;
    }
    std::vector<Vector3> corners;
    for (auto& [of_shape, of_piece] : number) {
        if (of_shape >= lists.corners.size()) throw std::invalid_argument("a face names a corner that is not there");
        of_piece = static_cast<std::uint32_t>(corners.size());
        corners.push_back(lists.corners[of_shape]);
    }
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t f = begin; f < end; ++f) {
        std::vector<std::uint32_t>& face = faces.emplace_back();
        for (const std::size_t corner : find_corners(lists, f)) face.push_back(number.at(corner));
    }
    Polyhedron piece = make_polyhedron(std::move(corners), faces);
    for (std::size_t f = begin; f < end; ++f) piece.faces[f - begin].outer = lists.outer[f] != 0;
    return piece;
}

/// The turn of each sample as a rotation vector, at most half a turn [rad], and its rates.
struct TurnColumns {
    std::vector<Vector3> turn, velocity, acceleration;
};

template <class File, class Columns>
void exchange_turn(File& file, std::size_t samples, Columns& columns, std::vector<Vector3>& pivot) {
    file.exchange("/base/turn", {samples}, columns.turn, "rad");
    file.exchange("/base/angular_velocity", {samples}, columns.velocity, "rad/s");
    file.exchange("/base/angular_acceleration", {samples}, columns.acceleration, "rad/s^2");
    file.exchange("/base/pivot", {1}, pivot, "m");
}

}  // namespace

void exchange_base_turn(Hdf5File& file, const std::vector<BaseState>& base) {
    if (std::none_of(base.begin(), base.end(), turns)) return;
    TurnColumns columns;
    for (const BaseState& state : base) {
        columns.turn.push_back(rotation_vector(Quaternion::Identity(), state.turn));
        columns.velocity.push_back(state.turn_rates.velocity);
        columns.acceleration.push_back(state.turn_rates.acceleration);
    }
    std::vector<Vector3> pivot{base.front().pivot};
    exchange_turn(file, base.size(), columns, pivot);
}

void exchange_base_turn(const Hdf5Reader& file, std::vector<BaseState>& base) {
    if (!file.has("/base/turn")) return;
    TurnColumns columns;
    std::vector<Vector3> pivot;
    exchange_turn(file, base.size(), columns, pivot);
    for (std::size_t k = 0; k < base.size(); ++k) {
        base[k].turn = turn_by(columns.turn[k]);
        base[k].turn_rates = {columns.velocity[k], columns.acceleration[k]};
        base[k].pivot = pivot[0];
    }
}

ShapeLists ShapeLists::of(const BlockShape& shape) {
    ShapeLists lists;
    for (std::size_t p = 0; p < shape.solid.pieces.size(); ++p) {
        const Polyhedron& piece = shape.solid.pieces[p];
        const std::size_t before = lists.corners.size();
        lists.corners.insert(lists.corners.end(), piece.corners.begin(), piece.corners.end());
        for (const Polyhedron::Face& face : piece.faces) {
            lists.first.push_back(lists.face_corners.size());
            for (const std::uint32_t corner : piece.loop(face)) lists.face_corners.push_back(before + corner);
            lists.piece.push_back(p);
            lists.outer.push_back(face.outer ? 1 : 0);
        }
    }
    lists.radius = {shape.radius};
    return lists;
}

BlockShape ShapeLists::make(const std::string& name) const {
    const auto is_place = [](const Vector3& corner) { return corner.allFinite(); };
    if (!std::all_of(corners.begin(), corners.end(), is_place)) throw std::invalid_argument("a corner is no place");
    if (!(radius.front() >= 0.0)) throw std::invalid_argument("its radius is none");
    BlockShape shape{.name = name, .solid = {}, .radius = radius.front()};
    for (std::size_t f = 0; f < first.size();) {
        const auto end =
            std::find_if(piece.begin() + static_cast<std::ptrdiff_t>(f), piece.end(), [&](std::size_t p) { return p != piece[f]; });
        const auto next = static_cast<std::size_t>(end - piece.begin());
        shape.solid.pieces.push_back(make_piece(*this, f, next));
        f = next;
    }
    if (shape.solid.pieces.empty()) throw std::invalid_argument("it has no faces");
    return shape;
}

void exchange_shapes(Hdf5File& file, hsize_t blocks, const BlockShapes& shapes) {
    if (!shapes.any()) return;
    file.exchange("/blocks/shape", {blocks}, shapes.of_block, "1");
    std::vector<std::string> names;
    for (std::size_t k = 0; k < shapes.list.size(); ++k) {
        const ShapeLists lists = ShapeLists::of(*shapes.list[k]);
        exchange_shape(file, group_of(k), lists);
        names.push_back(shapes.list[k]->name);
    }
    file.write_texts("/shapes/name", names);
}

void exchange_shapes(const Hdf5Reader& file, hsize_t blocks, BlockShapes& shapes) {
    if (!file.has("/blocks/shape")) return;
    BlockShapes read;
    file.exchange("/blocks/shape", {blocks}, read.of_block, "1");
    const std::vector<std::string> names = file.texts("/shapes/name");
    for (std::size_t k = 0; k < names.size(); ++k) {
        ShapeLists lists;
        exchange_shape(file, group_of(k), lists);
        try {
            read.list.push_back(std::make_shared<const BlockShape>(lists.make(names[k])));
        } catch (const std::invalid_argument& error) {
            file.fail(fmt::format("{} is no shape: {}", group_of(k), error.what()));
        }
    }
    for (const int shape : read.of_block) {
        if (shape < -1 || shape >= static_cast<int>(names.size())) file.fail("/blocks/shape names a shape that is not there");
    }
    shapes = std::move(read);
}

void exchange_sensors(Hdf5File& file, const std::vector<SensorHistory>& sensors) {
    if (sensors.empty()) return;
    std::vector<std::string> descriptions;
    for (const SensorHistory& sensor : sensors) {
        descriptions.push_back(describe_sensor(sensor));
        if (sensor.values.empty()) continue;
        std::vector<double> time;
        for (std::size_t k = 0; k < sensor.readings(); ++k) time.push_back(sensor.time(k));
        file.exchange(group_of(sensor) + "/time", {time.size()}, time, "s");
        exchange_readings(file, time.size(), sensor);
    }
    file.write_texts("/sensor_list", descriptions);
}

void exchange_sensors(const Hdf5Reader& file, std::vector<SensorHistory>& sensors) {
    if (!file.has("/sensor_list")) return;
    std::vector<SensorHistory> read;
    for (const std::string& description : file.texts("/sensor_list")) {
        try {
            read.push_back(parse_sensor_description(description));
        } catch (const std::runtime_error& error) {
            file.fail(fmt::format("/sensor_list describes no sensor: {}", error.what()));
        }
        SensorHistory& sensor = read.back();
        const std::string time = group_of(sensor) + "/time";
        if (file.has(time)) exchange_readings(file, file.count(time, std::vector<double>{}), sensor);
    }
    sensors = std::move(read);
}

}  // namespace musim::lsdem::detail
