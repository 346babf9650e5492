#include "lsdem/block_height.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "lsdem/motion/neighbors.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// The same blocks twice: as one shape whose blocks have height offsets, and each with a shape of its own height.
struct Twins {
    Model offset, own;

    template <class Change>
    void change(const Change& change) {
        change(offset);
        change(own);
    }
};

/// A block that stands by its own: where, turned how, and how much taller than the stone it is [part of its height].
struct Place {
    double strain = 0.0;
    Vector3 position = Vector3::Zero();  ///< centre of mass [m]
    Quaternion orientation = Quaternion::Identity();
    Vector3 velocity = Vector3::Zero();
    Vector3 angular_velocity = Vector3::Zero();
};

/// `voxel`: of grids [m], or zero for closed-form boxes.
Shape make_stone_shape(const Stone& stone, double height, const NodeLattice& lattice, double voxel) {
    const Vector3 size(stone.size.x(), stone.size.y(), height);
    return voxel > 0.0 ? make_grid_box_shape(size, lattice, voxel) : make_box_shape(size, lattice);
}

Twins make_twins(const Stone& stone, const std::vector<Place>& places, double voxel = 0.0) {
    const NodeLattice lattice = make_node_lattice(stone.size, stone.nodes_per_face);
    Twins twins;
    twins.offset = twins.own = make_model(stone);
    twins.offset.shapes = {make_stone_shape(stone, stone.size.z(), lattice, voxel)};
    twins.own.shapes.clear();
    for (const Place& place : places) {
        Block block;
        const double offset = place.strain * stone.size.z();
        block.mass = stone.density * stone.size.x() * stone.size.y() * (stone.size.z() + offset);
        block.position = place.position;
        block.orientation = place.orientation;
        block.velocity = place.velocity;
        block.angular_velocity = place.angular_velocity;
        block.shape = twins.own.shapes.size();
        twins.own.shapes.push_back(make_stone_shape(stone, stone.size.z() + offset, lattice, voxel));
        twins.own.blocks.push_back(block);
        block.shape = 0;
        block.height_offset = offset;
        twins.offset.blocks.push_back(block);
    }
    return twins;
}

/// Upright blocks of these strains on each other, at nominal contact.
std::vector<Place> stack(const Stone& stone, const std::vector<double>& strains, double x = 0.0) {
    std::vector<Place> places;
    double bottom = 0.0;
    for (const double strain : strains) {
        const double height = stone.size.z() * (1.0 + strain);
        places.push_back({.strain = strain, .position = {x, 0.0, bottom + 0.5 * height}});
        bottom += height;
    }
    return places;
}

/// Distances that the blocks of two twins moved, and by which the twins came apart.
struct Comparison {
    double moved = 0.0;   ///< farthest any block went or turned [heights, rad]
    double apart = 0.0;   ///< largest difference between the twins [heights, rad]
    double losses = 0.0;  ///< difference of friction and damping losses over their sum [-]
};

Comparison compare(const Twins& twins, double height, std::uint64_t steps) {
    const double step = 0.5 * compute_critical_time_step(twins.own);
    Simulation a(twins.offset, step), b(twins.own, step);
    const Kinematics start = b.kinematics();
    Comparison result;
    constexpr std::uint64_t kLooks = 20;
    for (std::uint64_t look = 0; look < kLooks; ++look) {
        advance(a, steps / kLooks);
        advance(b, steps / kLooks);
        for (std::size_t i = 0; i < twins.own.blocks.size(); ++i) {
            result.moved = std::max({result.moved, (b.position(i) - start.position[i]).norm() / height,
                                     b.orientation(i).angularDistance(start.orientation[i])});
            result.apart = std::max({result.apart, (a.position(i) - b.position(i)).norm() / height,
                                     (a.orientation(i).coeffs() - b.orientation(i).coeffs()).norm()});
        }
    }
    const Energy of_a = a.energy(), of_b = b.energy();
    const double lost = of_b.friction_loss + of_b.damping_loss;
    REQUIRE(lost > 0.0);
    result.losses = std::abs(of_a.friction_loss + of_a.damping_loss - lost) / lost;
    return result;
}

/// The twins move by more than `least_motion` [heights, rad] and alike. A height, a spacing or a dashpot that is off in its last bit makes
/// overlaps, a millionth of a height, differ by 1e-10 of themselves, and impacts and slip let that grow: seen are 2e-11 heights at most.
void check_same(const Twins& twins, std::uint64_t steps, double least_motion) {
    const Comparison result = compare(twins, 2.0 * twins.offset.shapes.front().half_extents.z(), steps);
    INFO("moved " << result.moved << ", apart " << result.apart << ", losses " << result.losses);
    CHECK(result.moved > least_motion);
    CHECK(result.apart < 1e-10);
    CHECK(result.losses < 1e-8);
}

/// Boxes that meet by their overlap, and by the nodes of one or of both blocks.
template <class Check>
void for_all_contacts(Twins twins, const Check& check) {
    check(twins);
    twins.change([](Model& model) { model.numerics.face_contact = FaceContact::nodes; });
    check(twins);
    twins.change([](Model& model) { model.numerics.contact_nodes = ContactNodes::both; });
    check(twins);
}

/// A push of the base that makes blocks slide and rock.
void shake_layers(Model& model) {
    model.ground.motion.shift[0] = sample_velocity(0.02, 40, [](double t) { return 0.25 * std::sin(300.0 * t); });
    model.ground.motion.shift[1] = sample_velocity(0.02, 40, [](double t) { return 0.15 * std::sin(200.0 * t); });
}

const std::vector<double> kStrains{0.03, -0.02, 0.0, 0.01};

/// A fast block on its way to hit the side of the one next to it.
std::vector<Place> collide(const Stone& stone, double strain, double other) {
    std::vector<Place> places = stack(stone, {strain});
    places.push_back(stack(stone, {other}, 1.01 * stone.size.x()).front());
    places.front().velocity = {0.2, 0.05, 0.0};
    return places;
}

/// Contacts that a neighbor search finds.
ContactList find_contacts(const Model& model) {
    NeighborSearch search(model);
    Bodies bodies(model);
    ContactList list;
    Losses finished{.block = std::vector<PairWork>(model.blocks.size()), .ground = {}};
    search.rebuild(bodies, list, finished);
    return list;
}

}  // namespace

TEST_CASE("a shaken column of offset blocks moves as one of blocks with shapes of their own") {
    Twins twins = make_twins(wood(), stack(wood(), kStrains));
    twins.change(shake_layers);
    for_all_contacts(twins, [](const Twins& t) { check_same(t, 3000, 1e-3); });
}

TEST_CASE("an offset block strikes the side of its neighbor as one with a shape of its own") {
    // side faces meet: their heights bound the contact, and cells of nodes stretch along them
    for_all_contacts(make_twins(wood(), collide(wood(), 0.03, -0.02)), [](const Twins& t) { check_same(t, 3000, 1e-2); });
}

TEST_CASE("offset blocks that lie on either side slip and press as those with shapes of their own") {
    // on the face across x and on that across y; the upper one ends within the face of the lower one
    for (const int axis : {0, 1}) {
        const Quaternion turn(Eigen::AngleAxisd(0.5 * kPi, Vector3::Unit(1 - axis)));
        std::vector<Place> places;
        for (const int i : {0, 1}) {
            const Vector3 position = (i + 0.5) * wood().size[axis] * Vector3::UnitZ() + 0.1 * i * wood().size.z() * Vector3::Unit(axis);
            places.push_back({.strain = i == 0 ? 0.03 : -0.02, .position = position, .orientation = turn});
        }
        Twins twins = make_twins(wood(), places);
        twins.change(shake_layers);
        for_all_contacts(twins, [](const Twins& t) { check_same(t, 4000, 2e-3); });
        // and rocks on the edges of its ends
        twins.change([&](Model& model) { model.blocks.back().angular_velocity = 3.0 * Vector3::Unit(1 - axis); });
        check_same(twins, 4000, 2e-3);
    }
}

TEST_CASE("offset blocks thrown on each other at all angles fall as those with shapes of their own") {
    std::vector<Place> places;
    std::mt19937 random(11);
    const double pitch = wood().size.norm();
    for (std::size_t i = 0; i < kStrains.size(); ++i) {
        const auto n = static_cast<double>(i);
        places.push_back({.strain = kStrains[i],
                          .position = pitch * Vector3(0.02 * n, 0.01 * n, 0.75 * (n + 0.7)),
                          .orientation = random_orientation(random),
                          .velocity = {0.0, 0.0, -1.0 - n}});
    }
    Twins twins = make_twins(wood(), places);
    check_same(twins, 12000, 1.0);
    twins.change([](Model& model) { model.numerics.face_contact = FaceContact::nodes; });
    check_same(twins, 12000, 1.0);
}

// Offsets of whole voxels, so that the own grids hold the same samples.
TEST_CASE("one grid level set serves blocks of all heights") {
    const Stone stone = wood();
    const double part = 1.0 / 60.0, voxel = part * stone.size.z();
    Twins column = make_twins(stone, stack(stone, {3.0 * part, -2.0 * part, part, 0.0}), voxel);
    column.change(shake_layers);
    check_same(column, 3000, 1e-3);
    check_same(make_twins(stone, collide(stone, 3.0 * part, -2.0 * part), voxel), 3000, 1e-2);
    check_same(make_twins(stone, collide(stone, -part, 2.0 * part), voxel), 3000, 1e-2);
}

TEST_CASE("the dashpots of a contact go with the root of the masses that meet in it") {
    const Stone stone = wood();
    const auto find_damping = [&](double below, double above) {
        std::vector<double> dampings;
        for (const ContactPair& pair : find_contacts(make_twins(stone, stack(stone, {below, above})).offset).pairs)
            dampings.push_back(pair.law.normal_damping);
        return dampings;
    };
    const std::vector<double> uneven = find_damping(0.03, -0.02), even = find_damping(0.0, 0.0);
    REQUIRE(uneven.size() == 2);
    REQUIRE(even.size() == 2);
    // 1.03·0.98/(1.03 + 0.98) m against m/2; on the ground 1.03 m
    CHECK(uneven[0] == relative(even[0] * std::sqrt(2.0 * 1.03 * 0.98 / 2.01), 1e-14));
    CHECK(uneven[1] == relative(even[1] * std::sqrt(1.03), 1e-14));
}

TEST_CASE("masses at the height of the shape are one number for blocks that differ in height only") {
    const Stone stone = wood();
    const Model model = make_twins(stone, stack(stone, {0.0371, -0.0213, 0.0, 0.0001, -0.0499})).offset;
    const std::vector<double> masses = compute_nominal_masses(model);
    CHECK(std::set<double>(masses.begin(), masses.end()) == std::set<double>{model.blocks[2].mass});
    Model denser = model;
    denser.blocks[0].mass *= 1.001;
    CHECK(compute_nominal_masses(denser)[0] == relative(1.001 * model.blocks[2].mass, 1e-14));
}

TEST_CASE("the time step is that of the shortest and the tallest block") {
    const Stone stone = wood();
    const Twins pair = make_twins(stone, stack(stone, {0.05, -0.05}));
    CHECK(compute_critical_time_step(pair.offset) == relative(compute_critical_time_step(pair.own), 1e-13));
    const Twins many = make_twins(stone, stack(stone, {0.05, -0.03, 0.0, 0.02, -0.05}));
    CHECK(compute_critical_time_step(many.offset) == relative(compute_critical_time_step(many.own), 1e-13));
    CHECK(compute_critical_time_step(many.offset) < compute_critical_time_step(make_twins(stone, stack(stone, {0.0})).offset));
}

TEST_CASE("an offset that leaves no height, is not finite, or belongs to a round body is refused") {
    Model model = make_twins(wood(), stack(wood(), {0.0})).offset;
    const auto refuses = [&](double offset) {
        model.blocks.front().height_offset = offset;
        CHECK_THROWS_AS(Simulation(model, 1e-6), std::invalid_argument);
    };
    refuses(-wood().size.z());
    refuses(-2.0 * wood().size.z());
    refuses(std::numeric_limits<double>::quiet_NaN());
    refuses(std::numeric_limits<double>::infinity());
    model.shapes.front() = make_sphere_shape(0.01, 60, 0.001);
    refuses(1e-6);
    model.blocks.front().height_offset = 0.0;
    CHECK_NOTHROW(Simulation(model, 1e-6));
}
