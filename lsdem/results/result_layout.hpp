#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "lsdem/results/hdf5_reader.hpp"
#include "lsdem/results/history.hpp"

/// The datasets of result.h5, group by group, which one list writes (File: Hdf5File) and reads back (const Hdf5Reader). Each list that is
/// read back is as long as what was read before says. Layout in docs/user/file_formats.md.
namespace musim::lsdem::detail {

/// One member of every item of a list that has its length.
template <class File, class Items, class Item, class Value>
void exchange_member(File& file, const std::string& path, Items& items, Value Item::*member, const std::string& units) {
    std::vector<Value> column;
    for (const Item& item : items) column.push_back(item.*member);
    file.exchange(path, {items.size()}, column, units);
    if constexpr (!std::is_const_v<Items>) {
        for (std::size_t k = 0; k < items.size(); ++k) items[k].*member = column[k];
    }
}

inline void exchange_layers(Hdf5File& file, const std::string& path, hsize_t count, std::size_t /*blocks*/,
                            const std::vector<int>& layers) {
    file.exchange(path, {count}, layers, "1");
}
inline void exchange_layers(const Hdf5Reader& file, const std::string& path, hsize_t count, std::size_t blocks, std::vector<int>& layers) {
    layers = file.layers(path, blocks);
    if (layers.size() != count) file.fail(path + " has another size than the rest");
}

/// Turn of the base, where it turns.
void exchange_base_turn(Hdf5File& file, const std::vector<BaseState>& base);
void exchange_base_turn(const Hdf5Reader& file, std::vector<BaseState>& base);

template <class File, class Base>
void exchange_base(File& file, Base& base) {
    exchange_member(file, "/base/displacement", base, &BaseState::displacement, "m");
    exchange_member(file, "/base/velocity", base, &BaseState::velocity, "m/s");
    exchange_member(file, "/base/acceleration", base, &BaseState::acceleration, "m/s^2");
    exchange_base_turn(file, base);
}

template <class File, class Run>
void exchange_spine(File& file, Run& run) {
    const hsize_t ns = file.count("/spine/block", run.spine.block);
    exchange_layers(file, "/spine/level", ns, run.blocks.mass.size(), run.spine.level);
    file.exchange("/spine/block", {ns}, run.spine.block, "1");
}

template <class File, class Run>
void exchange_spine_motion(File& file, Run& run) {
    const std::vector<hsize_t> shape{run.history.samples(), run.spine.size()};
    file.exchange("/spine/position", shape, run.history.spine_position, "m");
    file.exchange("/spine/velocity", shape, run.history.spine_velocity, "m/s");
    file.exchange("/spine/rotation_vector", shape, run.history.spine_rotation, "rad");
}

/// The energy of all springs is one number: that of normal ones.
template <class File>
void exchange_energies(File& file, std::vector<Energy>& energies) {
    exchange_member(file, "/energy/kinetic", energies, &Energy::kinetic, "J");
    exchange_member(file, "/energy/potential", energies, &Energy::gravitational, "J");
    exchange_member(file, "/energy/elastic", energies, &Energy::elastic_normal, "J");
    exchange_member(file, "/energy/friction", energies, &Energy::friction_loss, "J");
    exchange_member(file, "/energy/damping", energies, &Energy::damping_loss, "J");
    exchange_member(file, "/energy/preparation", energies, &Energy::preparation_loss, "J");
    exchange_member(file, "/energy/base_work", energies, &Energy::base_work, "J");
}

/// Loads of a run that has some.
template <class File, class Run>
void exchange_loads(File& file, Run& run) {
    const std::vector<hsize_t> shape{run.history.samples(), run.loads.size()};
    std::vector<double> force, displacement;
    for (const LoadState& load : run.history.load) force.push_back(load.force), displacement.push_back(load.displacement);
    file.exchange("/loads/force", shape, force, "N");
    file.exchange("/loads/displacement", shape, displacement, "m");
    exchange_member(file, "/energy/load_work", run.history.energy, &Energy::load_work, "J");
    if constexpr (!std::is_const_v<Run>) {
        run.history.load.clear();
        for (std::size_t k = 0; k < force.size(); ++k) run.history.load.push_back({force[k], displacement[k]});
    }
}

template <class File, class Run>
void exchange_blocks(File& file, Run& run) {
    const hsize_t n = file.count("/blocks/mass", run.blocks.mass);
    file.exchange("/blocks/size", {n}, run.blocks.size, "m");
    file.exchange("/blocks/mass", {n}, run.blocks.mass, "kg");
    exchange_layers(file, "/blocks/layer", n, n, run.blocks.layer);
    file.exchange("/blocks/initial_position", {n}, run.initial.position, "m");
    file.exchange("/blocks/initial_quaternion", {n}, run.initial.orientation, "1");
    file.exchange("/blocks/final_position", {n}, run.final.position, "m");
    file.exchange("/blocks/final_quaternion", {n}, run.final.orientation, "1");
}

/// A shape as lists: its faces, piece by piece, and their corners.
struct ShapeLists {
    std::vector<Vector3> corners;           ///< [m]
    std::vector<std::size_t> first;         ///< of a face's corners in `face_corners`
    std::vector<std::size_t> face_corners;  ///< into `corners`: counter-clockwise seen from outside
    std::vector<std::size_t> piece;         ///< convex piece that a face is of
    std::vector<int> outer;                 ///< 1: the face is part of the surface; 0: it lies between two pieces
    std::vector<double> radius;             ///< of a ball, whose surface the faces stand for [m]; 0: there is none

    /// Lists of a shape.
    static ShapeLists of(const BlockShape& shape);
    /// The shape of these lists. Throws std::invalid_argument where they make none.
    BlockShape make(const std::string& name) const;
};

template <class File, class Lists>
void exchange_shape(File& file, const std::string& group, Lists& lists) {
    file.exchange(group + "/corners", {file.count(group + "/corners", lists.corners)}, lists.corners, "m");
    const hsize_t faces = file.count(group + "/face_first", lists.first);
    file.exchange(group + "/face_first", {faces}, lists.first, "1");
    file.exchange(group + "/face_corners", {file.count(group + "/face_corners", lists.face_corners)}, lists.face_corners, "1");
    file.exchange(group + "/face_piece", {faces}, lists.piece, "1");
    file.exchange(group + "/face_outer", {faces}, lists.outer, "1");
    file.exchange(group + "/radius", {1}, lists.radius, "m");
}

/// Shapes of blocks that are no boxes, where there are any. Reading throws ResultError of what is no shape.
void exchange_shapes(Hdf5File& file, hsize_t blocks, const BlockShapes& shapes);
void exchange_shapes(const Hdf5Reader& file, hsize_t blocks, BlockShapes& shapes);

/// Which blocks begin in the air, where any does.
inline void exchange_airborne(Hdf5File& file, hsize_t blocks, const Falls& falls) {
    const bool any = std::find(falls.airborne.begin(), falls.airborne.end(), 1) != falls.airborne.end();
    if (any) file.exchange("/blocks/airborne", {blocks}, falls.airborne, "1");
}
inline void exchange_airborne(const Hdf5Reader& file, hsize_t blocks, Falls& falls) {
    if (file.has("/blocks/airborne")) file.exchange("/blocks/airborne", {blocks}, falls.airborne, "1");
}

template <class File, class RunFalls>
void exchange_falls(File& file, hsize_t blocks, RunFalls& falls, bool has_collapsed) {
    file.exchange("/blocks/fall_time", {blocks}, falls.time, "s");
    file.exchange("/blocks/fall_displacement", {blocks}, falls.displacement, "m");
    if (has_collapsed) file.exchange("/blocks/collapse_displacement", {blocks}, falls.at_collapse, "m");
    exchange_airborne(file, blocks, falls);
}

/// Group of a sensor.
inline std::string group_of(const SensorHistory& sensor) { return "/sensors/" + sensor.name; }

/// Readings of a sensor, one dataset for each quantity, besides their times.
template <class File, class History>
void exchange_readings(File& file, hsize_t readings, History& sensor) {
    const std::vector<SensorChannel>& channels = find_channels(sensor.kind);
    std::vector<std::vector<double>> columns;
    for (std::size_t c = 0; c < channels.size(); ++c) columns.push_back(sensor.column(c));
    for (std::size_t first = 0, last = 0; first < channels.size(); first = last) {
        const std::string quantity = channels[first].quantity;
        while (last < channels.size() && quantity == channels[last].quantity) ++last;
        const std::size_t width = last - first;
        std::vector<double> rows(readings * width);
        for (std::size_t i = 0; i < columns[first].size() * width; ++i) rows[i] = columns[first + i % width][i / width];
        file.exchange(group_of(sensor) + "/" + quantity, {readings, width}, rows, channels[first].unit);
        for (std::size_t c = first; c < last; ++c) {
            columns[c].clear();
            for (std::size_t k = 0; k < readings; ++k) columns[c].push_back(rows[k * width + (c - first)]);
        }
    }
    if constexpr (!std::is_const_v<History>) {
        sensor.values.clear();
        for (std::size_t k = 0; k < readings; ++k) {
            for (const std::vector<double>& column : columns) sensor.values.push_back(column[k]);
        }
    }
}

/// Sensors, where there are any; of one that read nothing the description alone.
void exchange_sensors(Hdf5File& file, const std::vector<SensorHistory>& sensors);
void exchange_sensors(const Hdf5Reader& file, std::vector<SensorHistory>& sensors);

/// State that a later stage of a sequence takes over; the stage is counted from 1 as in the names of folders.
template <class File>
void exchange_origin(File& file, hsize_t blocks, StageOrigin& origin) {
    std::vector<std::size_t> stage{origin.stage + 1};
    std::vector<double> time{origin.time};
    std::vector<Vector3> base{origin.base};
    file.exchange("/origin/stage", {1}, stage, "1");
    file.exchange("/origin/time", {1}, time, "s");
    file.exchange("/origin/base_displacement", {1}, base, "m");
    file.exchange("/origin/position", {blocks}, origin.position, "m");
    file.exchange("/origin/quaternion", {blocks}, origin.orientation, "1");
    origin.stage = stage[0] - 1;
    origin.time = time[0];
    origin.base = base[0];
}

/// By the block that leads the interface, see lsdem::Losses.
template <class File>
void exchange_losses(File& file, Losses& losses) {
    std::vector<double> ground{losses.ground.friction, losses.ground.damping};
    exchange_member(file, "/losses/friction", losses.block, &PairWork::friction, "J");
    exchange_member(file, "/losses/damping", losses.block, &PairWork::damping, "J");
    file.exchange("/losses/ground", {2}, ground, "J");
    losses.ground = {ground[0], ground[1]};
}

template <class File, class RunFrames>
void exchange_frames(File& file, hsize_t blocks, RunFrames& frames, bool has_forces) {
    const std::vector<hsize_t> shape{frames.time.size(), blocks};
    file.exchange("/frames/position", shape, frames.position, "m");
    file.exchange("/frames/quaternion", shape, frames.quaternion, "1");
    file.exchange("/frames/velocity", shape, frames.velocity, "m/s");
    if (has_forces) file.exchange("/frames/contact_force", shape, frames.contact_force, "N");
}

}  // namespace musim::lsdem::detail
