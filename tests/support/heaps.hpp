#pragma once

#include <cmath>
#include <cstddef>
#include <random>

#include "lsdem/model.hpp"
#include "tests/support/models.hpp"

namespace musim::lsdem::tests {

/// Random rotation, evenly spread.
inline Quaternion random_orientation(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
}

/// side³ blocks without gravity or ground, apart, turned at random, that fly towards the middle and spin.
inline Model make_tumbling_cloud(const Stone& stone, int side) {
    Model model = make_model(stone);
    model.gravity.setZero();
    model.ground.present = false;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    const double pitch = 1.05 * stone.size.norm();
    for (int i = 0; i < side * side * side; ++i) {
        const int layer = i / (side * side), row = i / side % side;
        const Vector3 cell(i % side, row, layer);
        Block block = make_block(stone, pitch * (cell - Vector3::Constant(0.5 * (side - 1))), random_orientation(random));
        block.velocity = -20.0 * block.position + 0.1 * Vector3(even(random), even(random), even(random));
        block.angular_velocity = 40.0 * Vector3(even(random), even(random), even(random));
        model.blocks.push_back(block);
    }
    return model;
}

/// Blocks turned at random and dropped on the ground from a loose lattice of side x side x layers places.
inline Model make_loose_pile(const Stone& stone, int side, int layers) {
    Model model = make_model(stone);
    std::mt19937 random(11);
    const double pitch = 1.02 * stone.size.norm();
    for (int i = 0; i < side * side * layers; ++i) {
        const int layer = i / (side * side), row = i / side % side;
        const Vector3 cell(i % side, row, 0.52 + layer);
        model.blocks.push_back(make_block(stone, pitch * cell, random_orientation(random)));
    }
    return model;
}

/// A block cut in two across its wide side, which ends every other layer of a wall.
inline Shape make_half_shape(const Stone& stone) {
    const NodeLattice whole = make_node_lattice(stone.size, stone.nodes_per_face);
    return make_box_shape({stone.size.x(), 0.5 * stone.size.y(), stone.size.z()}, {whole.nx, (whole.ny + 1) / 2, whole.nz});
}

/// Walls in running bond: `rows` walls beside each other, `per_row` upright blocks long, `layers` high, at nominal contact. Every other
/// layer is shifted by half a block along the wall and ends in half blocks, so that a whole block rests on two.
inline Model make_running_bond(const Stone& stone, std::size_t rows, std::size_t per_row, std::size_t layers) {
    Model model = make_model(stone);
    model.shapes.push_back(make_half_shape(stone));
    const double gap = 1e-3 * stone.size.z(), pitch_x = stone.size.x() + gap, pitch_y = stone.size.y() + gap;
    for (std::size_t course = 0; course < layers * rows; ++course) {
        const std::size_t layer = course / rows, row = course % rows;
        const double x = static_cast<double>(row) * pitch_x, z = (static_cast<double>(layer) + 0.5) * stone.size.z();
        const bool shifted = layer % 2 == 1;
        for (std::size_t i = shifted ? 1 : 0; i < per_row; ++i) {
            const double place = static_cast<double>(i) - (shifted ? 0.5 : 0.0);
            model.blocks.push_back(make_block(stone, {x, place * pitch_y, z}));
        }
        if (!shifted) continue;
        for (const double end : {-0.25, static_cast<double>(per_row) - 0.75}) {
            Block half = make_block(stone, {x, end * pitch_y, z});
            half.shape = 1;
            half.mass *= 0.5;
            model.blocks.push_back(half);
        }
    }
    return model;
}

/// Makes blocks up to `most` shorter than their shape, each with its own height; their bottoms stay where they are.
inline Model shortened(Model model, double most) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> even(0.0, 1.0);
    for (Block& block : model.blocks) {
        const double part = most * even(random), height = 2.0 * model.shapes[block.shape].half_extents.z();
        block.height_offset = -part * height;
        block.mass *= 1.0 - part;
        block.position.z() -= 0.5 * part * height;
    }
    return model;
}

}  // namespace musim::lsdem::tests
