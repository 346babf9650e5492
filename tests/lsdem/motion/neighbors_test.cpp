#include "lsdem/motion/neighbors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "lsdem/motion/motion_kernel.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

using Entry = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  ///< leader, follower, node

std::set<Entry> listed(const ContactList& list) {
    std::set<Entry> entries;
    for (const ContactPair& pair : list.pairs)
        for (std::uint32_t n = pair.first_node; n < pair.first_node + pair.node_count; ++n)
            entries.insert({pair.leader, pair.follower, list.nodes[n]});
    return entries;
}

/// Nodes of any block that lie in any other, or in the ground, by looking at all of them.
std::set<Entry> find_by_brute_force(const Model& model, const Bodies& bodies) {
    std::set<Entry> entries;
    for (std::uint32_t l = 0; l < bodies.size(); ++l) {
        const SurfaceNodes& nodes = model.shapes[model.blocks[l].shape].nodes;
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            const Vector3 world = bodies.pose[l].rotation * nodes.position(i) + bodies.pose[l].position;
            if (world.z() < 0.0) entries.insert({l, bodies.ground(), i});
            for (std::uint32_t f = 0; f < bodies.size(); ++f) {
                if (f == l || !(model.numerics.contact_nodes == ContactNodes::both || leads(bodies, l, f))) continue;
                const BoxLevelSet box{model.shapes[model.blocks[f].shape].half_extents};
                if (box.value(bodies.pose[f].rotation.transpose() * (world - bodies.pose[f].position)) < 0.0) entries.insert({l, f, i});
            }
        }
    }
    return entries;
}

/// Blocks thrown at random into a box so small that they overlap.
Model make_random_heap(std::uint32_t seed) {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.numerics.face_contact = FaceContact::nodes;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> even(0.0, 1.0);
    for (int i = 0; i < 60; ++i)
        model.blocks.push_back(make_block(stone, 0.12 * Vector3(even(random), even(random), even(random)) - Vector3(0.05, 0.06, 0.0),
                                          random_orientation(random)));
    return model;
}

/// Largest drift of any block, as a step that moves nothing finds it.
double find_drift(const NeighborSearch& search, Bodies bodies, bool is_turned = false) {
    musim::lsdem::detail::TouchList touches;
    touches.rebuild(bodies.size(), {}, {});
    const std::vector<PairForce> forces;
    return musim::lsdem::detail::move_blocks(
        {.touches = touches, .forces = forces, .reference = search.reference(), .is_turned = is_turned}, {0, bodies.size()}, bodies);
}

}  // namespace

TEST_CASE("the neighbor list of a random heap holds every touching node that brute force finds") {
    for (const ContactNodes which : {ContactNodes::leader, ContactNodes::both}) {
        for (std::uint32_t seed = 1; seed <= 5; ++seed) {
            Model model = make_random_heap(seed);
            model.numerics.contact_nodes = which;
            const Bodies bodies(model);
            NeighborSearch search(model);
            ContactList list;
            Losses finished{std::vector<PairWork>(bodies.size()), {}};
            search.rebuild(bodies, list, finished);
            const std::set<Entry> near = listed(list), touching = find_by_brute_force(model, bodies);
            REQUIRE(touching.size() > 100);
            CHECK(std::includes(near.begin(), near.end(), touching.begin(), touching.end()));
            CHECK(std::is_sorted(list.pairs.begin(), list.pairs.end(), [](const ContactPair& a, const ContactPair& b) {
                const auto place = [](const ContactPair& p) {
                    return std::tuple{std::min(p.leader, p.follower), std::max(p.leader, p.follower), p.leader};
                };
                return place(a) < place(b);
            }));
        }
    }
}

// Boxes that meet by their overlap carry no nodes in the list; the pair has to be there, whichever leads.
TEST_CASE("the neighbor list of a random heap holds every pair of boxes of which brute force finds a node in the other") {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        Model model = make_random_heap(seed);
        model.numerics.face_contact = FaceContact::overlap;
        const Bodies bodies(model);
        NeighborSearch search(model);
        ContactList list;
        Losses finished{std::vector<PairWork>(bodies.size()), {}};
        search.rebuild(bodies, list, finished);
        std::size_t blocks = 0, missed = 0;
        for (const auto& [leader, follower, node] : find_by_brute_force(model, bodies)) {
            const auto joins = [l = leader, f = follower](const ContactPair& p) { return p.leader == l && p.follower == f; };
            const auto found = std::find_if(list.pairs.begin(), list.pairs.end(), joins);
            missed += found == list.pairs.end() ? 1 : 0;
            blocks += bodies.is_ground(follower) ? 0 : 1;
        }
        REQUIRE(blocks > 100);
        CHECK(missed == 0);
    }
}

TEST_CASE("the list stays complete while no block has drifted farther than allowed") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const Model model = make_random_heap(seed);
        Bodies bodies(model);
        NeighborSearch search(model);
        ContactList list;
        Losses finished{std::vector<PairWork>(bodies.size()), {}};
        search.rebuild(bodies, list, finished);
        // as far as allowed: half by moving, half by turning
        const double allowed = search.allowed_drift();
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            bodies.pose[i].position += 0.49 * allowed * Vector3(even(random), even(random), even(random)).normalized();
            const double reach = 3.0 * model.shapes[0].half_extents.norm();
            const Vector3 axis = Vector3(even(random), even(random), even(random)).normalized();
            bodies.orientation[i] = Eigen::AngleAxisd(0.49 * allowed / reach, axis) * bodies.orientation[i];
            bodies.pose[i].rotation = bodies.orientation[i].toRotationMatrix();
        }
        REQUIRE(find_drift(search, bodies) <= allowed);
        std::set<Entry> near = listed(list);
        for (const Entry& entry : find_by_brute_force(model, bodies)) {
            const auto [leader, follower, node] = entry;
            // who leads a new pair is decided when the list is made; a pair may have changed places in height since
            const bool known = near.contains(entry) ||
                               (!bodies.is_ground(follower) && !near.empty() &&
                                std::any_of(list.pairs.begin(), list.pairs.end(), [&, l = leader, f = follower](const ContactPair& p) {
                                    return p.leader == f && p.follower == l;
                                }));
            CHECK(known);
        }
    }
}

TEST_CASE("two blocks that are not listed cannot meet while neither has drifted farther than allowed") {
    const Stone stone = wood();
    const double skin = kNeighborSkin * std::min({stone.size.x(), stone.size.y(), stone.size.z()});
    for (const FaceContact how : {FaceContact::nodes, FaceContact::overlap}) {
        // side by side, just beyond the skin and just within
        for (const bool is_listed : {false, true}) {
            CAPTURE(is_listed);
            Model model = make_model(stone);
            model.numerics.face_contact = how;
            const double distance = stone.size.x() + (is_listed ? 0.999 : 1.001) * skin;
            for (const double x : {0.0, distance}) model.blocks.push_back(make_block(stone, {x, 0.0, stone.size.z()}));
            Bodies bodies(model);
            NeighborSearch search(model);
            ContactList list;
            Losses finished{std::vector<PairWork>(bodies.size()), {}};
            search.rebuild(bodies, list, finished);
            CHECK(list.pairs.size() == (is_listed ? 1 : 0));
            // each towards the other as far as allowed: half the gap, so that the faces still do not touch
            for (const std::size_t i : {0U, 1U}) bodies.pose[i].position.x() += (i == 0 ? 1.0 : -1.0) * search.allowed_drift();
            const double gap = bodies.pose[1].position.x() - bodies.pose[0].position.x() - stone.size.x();
            if (!is_listed) CHECK(gap > 0.0);
            CHECK(std::abs(gap) < 0.01 * skin);
        }
    }
}

TEST_CASE("drift is measured against the base") {
    const Model model = make_resting_column(wood(), 2);
    Bodies bodies(model);
    NeighborSearch search(model);
    ContactList list;
    Losses finished{std::vector<PairWork>(bodies.size()), {}};
    search.rebuild(bodies, list, finished);
    for (BodyPose& pose : bodies.pose) pose.position.x() += 0.01;
    CHECK(find_drift(search, bodies) < 1e-15);
    bodies.pose.back().position.x() = 0.0;
    CHECK(find_drift(search, bodies) == relative(0.01, 1e-9));
}

TEST_CASE("drift is measured against a base that has turned") {
    const Model model = make_resting_column(wood(), 2);
    Bodies bodies(model);
    NeighborSearch search(model);
    ContactList list;
    Losses finished{std::vector<PairWork>(bodies.size()), {}};
    search.rebuild(bodies, list, finished);
    const Quaternion turn(Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()));
    for (std::size_t i = 0; i <= bodies.size(); ++i) {
        bodies.orientation[i] = turn * bodies.orientation[i];
        bodies.pose[i].rotation = bodies.orientation[i].toRotationMatrix();
        bodies.pose[i].position = turn * bodies.pose[i].position;
    }
    CHECK(find_drift(search, bodies, true) < 1e-15);
    bodies.pose[1].position += bodies.up() * 0.01;
    CHECK(find_drift(search, bodies, true) == relative(0.01, 1e-9));
}

TEST_CASE("the lower block leads and of equals the first") {
    const Model model = make_resting_column(wood(), 2);
    Bodies bodies(model);
    CHECK(leads(bodies, 0, 1));
    CHECK_FALSE(leads(bodies, 1, 0));
    bodies.pose[1].position.z() = bodies.pose[0].position.z();
    CHECK(leads(bodies, 0, 1));
    CHECK_FALSE(leads(bodies, 1, 0));
    // whichever is listed first
    bodies.pose[1].position.z() -= 1e-9;
    CHECK(leads(bodies, 1, 0));
    CHECK_FALSE(leads(bodies, 0, 1));
}
