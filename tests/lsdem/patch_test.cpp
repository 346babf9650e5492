#include "lsdem/patches.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "lsdem/detail/patch_kernel.hpp"
#include "lsdem/neighbors.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Two blocks, the upper one shifted and turned a little, so that edges of both bound their patch.
Model make_shifted_pair(const Stone& stone) {
    Model model = make_model(stone);
    model.ground.present = false;
    model.blocks.push_back(make_block(stone, Vector3::Zero()));
    const Vector3 shift(0.2 * stone.size.x(), -0.3 * stone.size.y(), stone.size.z());
    model.blocks.push_back(make_block(stone, shift, Quaternion(Eigen::AngleAxisd(0.01, Vector3::UnitZ()))));
    return model;
}

/// Contacts of blocks whose poses are given.
struct Contacts {
    explicit Contacts(const Model& model) : search(model), bodies(model) {
        bodies.previous_position = bodies.position;
        bodies.previous_rotation = bodies.rotation;
        Losses finished{std::vector<PairWork>(bodies.size()), {}};
        search.rebuild(bodies, BasePose{}, list, finished);
        REQUIRE(list.pairs.size() == 1);
        REQUIRE(list.pairs.front().is_patch());
    }

    const PairForce& compute(double dt) {
        detail::compute_patches(bodies, BasePose{}, dt, 0, list.patches.groups.size(), list);
        list.first_step = false;
        return list.forces.front();
    }

    double of(std::size_t field) const { return list.patches.field(0, field)[0]; }

    NeighborSearch search;
    Bodies bodies;
    ContactList list;
};

/// Moves the upper block by a displacement and a rotation vector about its centre.
void move_upper(Bodies& bodies, const Vector3& displacement, const Vector3& turn) {
    bodies.position[1] += displacement;
    bodies.travel[1] += displacement.norm() + 2.0 * bodies.half[1].norm() * turn.norm();
    if (turn.norm() > 0.0) bodies.rotation[1] = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * bodies.rotation[1];
}

double difference(const PairForce& a, const PairForce& b) {
    return ((a.force - b.force).norm() + (a.leader_torque - b.leader_torque).norm() + (a.follower_torque - b.follower_torque).norm());
}

}  // namespace

TEST_CASE("the weights of a patch have the area and the second moment of the continuous face from three nodes on") {
    for (const int p : {2, 3, 4, 7, 11, 40}) {
        for (const int q : {2, 3, 6}) {
            CAPTURE(p);
            CAPTURE(q);
            const PatchLattice lattice = make_patch_lattice(p, q);
            double area = 0.0, first = 0.0, second_p = 0.0, second_q = 0.0, smallest = 1.0;
            for (std::size_t i = 0; i < lattice.size(); ++i) {
                area += lattice.w[i];
                first += lattice.ws[i] + lattice.wt[i];
                second_p += lattice.ws[i] * lattice.s[i];
                second_q += lattice.wt[i] * lattice.t[i];
                smallest = std::min(smallest, lattice.w[i]);
            }
            CHECK(area == relative(1.0, 1e-14));
            CHECK(std::abs(first) < 1e-14);
            CHECK(second_p == relative(p == 2 ? 1.0 : 1.0 / 3.0, 1e-13));
            CHECK(second_q == relative(q == 2 ? 1.0 : 1.0 / 3.0, 1e-13));
            CHECK(lattice.second_p == relative(second_p, 1e-13));
            CHECK(lattice.second_q == relative(second_q, 1e-13));
            CHECK(smallest > 0.0);
        }
    }
}

// One copy looks at every node in every step, the other only where it must.
TEST_CASE("a patch that is summed in closed form gives the forces of its nodes to rounding") {
    const Stone stone = wood();
    const double dt = 1e-5, depth = stone.weight() / stone.normal_stiffness;
    Contacts closed(make_shifted_pair(stone)), by_node(make_shifted_pair(stone));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    int in_closed_form = 0, slid = 0, parted = 0, parted_in_closed_form = 0;
    double worst = 0.0;
    for (int step = 0; step < 4000; ++step) {
        // rest, tremble, slide and rock in turn, about a depth that the weight would press
        const int phase = step / 250 % 4;
        const double slide = phase == 2 ? 0.02 * depth : phase == 1 ? 1e-4 * depth : 0.0;
        const double rock = phase == 3 ? 2.0 * depth / stone.size.x() : phase == 1 ? 1e-3 * depth / stone.size.x() : 0.0;
        const double lift = step == 0 ? -10.0 * depth : phase == 1 ? 1e-3 * depth * even(random) : 0.0;
        const Vector3 move(slide * even(random), slide * even(random), lift);
        const Vector3 turn(rock * even(random), rock * even(random), 1e-3 * rock * even(random));
        const auto advance = [&](Contacts& contacts) {
            move_upper(contacts.bodies, move, turn);
            return contacts.compute(dt);
        };
        by_node.list.patches.field(0, patch_field::slack)[0] = -1.0;
        const double friction_before = closed.of(patch_field::friction_loss);
        const PairForce a = advance(closed), b = advance(by_node);
        const double size = 10.0 * depth * stone.normal_stiffness * (1.0 + stone.size.norm());
        worst = std::max(worst, difference(a, b) / size);
        const bool common = closed.of(patch_field::slip_u) != 0.0 || closed.of(patch_field::slip_v) != 0.0;
        in_closed_form += common ? 1 : 0;
        slid += closed.of(patch_field::friction_loss) > friction_before ? 1 : 0;
        const double touching = closed.of(patch_field::touching);
        const bool in_part = touching > 0.0 && touching < static_cast<double>(closed.list.patches.lattices.back().size());
        parted += in_part ? 1 : 0;
        parted_in_closed_form += in_part && common ? 1 : 0;
        REQUIRE(touching == by_node.of(patch_field::touching));
    }
    MESSAGE("closed form in " << in_closed_form << " of 4000 steps, sliding in " << slid << ", partly open in " << parted << ", "
                              << parted_in_closed_form << " of these in closed form; forces differ by " << worst << " of the load");
    CHECK(in_closed_form > 400);
    CHECK(slid > 400);
    CHECK(parted > 200);
    CHECK(parted_in_closed_form > 200);
    // sums of 48 nodes over 4000 steps in two orders
    CHECK(worst < 4000.0 * 2.2e-16);
    CHECK(closed.of(patch_field::friction_loss) == relative(by_node.of(patch_field::friction_loss), 1e-10));
    CHECK(closed.of(patch_field::elastic_shear) == relative(by_node.of(patch_field::elastic_shear), 1e-10));
}

// Tilted, so that the pressed strip lies on an edge of either block; without friction and dashpots the force has a potential.
TEST_CASE("the forces of a patch are the gradient of its energy and balance each other") {
    Stone stone = wood();
    stone.friction = 0.0;
    stone.restitution = 1.0;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    const double h = 1e-9 * stone.size.z();
    for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(trial);
        Model model = make_shifted_pair(stone);
        const double tilt = trial % 2 == 0 ? 0.05 : 1e-4;
        const Vector3 turn = tilt * Vector3(even(random), even(random), 0.05 * even(random));
        Block& upper = model.blocks[1];
        upper.position += 0.2 * stone.size.cwiseProduct(Vector3(even(random), even(random), 0.0));
        upper.orientation = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * upper.orientation;
        upper.position.z() += 0.5 * tilt * stone.size.x() * even(random);
        const auto energy = [&](const Vector3& displacement, const Vector3& rotation) {
            Contacts contacts(model);
            move_upper(contacts.bodies, displacement, rotation);
            contacts.compute(1.0);
            return contacts.of(patch_field::elastic_normal);
        };
        Contacts contacts(model);
        const PairForce at = contacts.compute(1.0);
        if (!(contacts.of(patch_field::elastic_normal) > 0.0)) continue;

        // the upper block follows
        Vector3 force, torque;
        for (int a = 0; a < 3; ++a) {
            const Vector3 e = Vector3::Unit(a), none = Vector3::Zero();
            const double angle = h / stone.size.z();
            force[a] = -(energy(h * e, none) - energy(-h * e, none)) / (2.0 * h);
            torque[a] = -(energy(none, angle * e) - energy(none, -angle * e)) / (2.0 * angle);
        }
        const double size = at.force.norm();
        CHECK((-at.force - force).norm() < 1e-4 * size);
        CHECK((at.follower_torque - torque).norm() < 1e-4 * size * stone.size.z());
        const Vector3 arm = contacts.bodies.position[1] - contacts.bodies.position[0];
        CHECK((at.leader_torque + at.follower_torque - arm.cross(at.force)).norm() < 1e-12 * size * stone.size.norm());
    }
}
