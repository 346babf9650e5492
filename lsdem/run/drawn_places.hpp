#pragma once

#include <numbers>
#include <vector>

#include "lsdem/results/rest.hpp"
#include "lsdem/run/simulate.hpp"

/// Which blocks stand where they are drawn, and which have left their places since.
namespace musim::lsdem {

/// A block has left its place when the middle of the joint with each block that carries it, and with the ground where that does, has opened
/// or slipped by more than this part of the block's smallest edge [-]: as much as kFallenDrop is of its height. Blocks of unequal height
/// that come to rest on each other stay far below; one whose middle slides over the edge that carries it moves by twice as much.
inline constexpr double kLeftPlace = 0.25;

/// A block has also left its place when it has turned by more than this against each block that carries it, and the ground where that does
/// [rad]: half of the turn of has_fallen. Blocks of unequal height turn by up to 15 degrees at the top of a tower of 38 layers.
inline constexpr double kLeftTurn = 0.125 * std::numbers::pi;

/// The blocks of a model as boxes where they are.
std::vector<BoxPose> find_boxes(const Model& model);

/// Blocks that have fallen since they were drawn (Specimen::drawn), each against what it was drawn on:
///
///   has_fallen(turn since drawn, sunk − s)          s: how far it can sink until it rests, the largest sum of gaps down to the ground
///   or  min |d| > kLeftPlace × its smallest edge    d: slip and opening of the middle of the joint; closing the gap there is none
///   or  min turn > kLeftTurn                        both against a carrier, the least over its carriers
///
/// Layers that settle as a whole so are no fall, however many they are. Fixed blocks and blocks in the air (find_airborne) cannot fall.
/// Empty where nothing is known of how the specimen was drawn. `now`: poses, also of a specimen that was never simulated.
std::vector<MovedBlock> find_fallen(const Specimen& specimen, const Kinematics& now);

/// One entry per block, 1: it begins in the air, so that it cannot fall from a place. Of listed blocks those that nothing carries
/// (find_carriers), or that are thrown up faster than it takes to rise by kFallenDrop of their height, v² > 2 g·H/4.
std::vector<int> find_airborne(const Specimen& specimen, const Kinematics& start);

/// Notes on the end of a preparation: which blocks have fallen, and whether so many that the structure is not run (Rest::collapsed):
/// of listed blocks any, since a drawing is meant as it is; of layers, whose heights are drawn at random, kCollapsedFraction.
void note_fallen(const Specimen& specimen, const Kinematics& now, Rest& rest);

}  // namespace musim::lsdem
