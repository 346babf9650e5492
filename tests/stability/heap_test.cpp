#include <doctest/doctest.h>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Blocks poured from a loose lattice. With a share s of wood's stiffness the step is 1/√s times as long, and a corner sinks in deeper.
/// Where it meets a face at 45° the springs of depth d hold K d⁴/24: a block that falls 0.4 m sinks in by 0.15 s^(-1/4) of its thin edge,
/// and n that fall as one by n^(1/4) times that.
Model make_poured_heap(int side, int layers, double share) { return make_loose_pile(stiffened(coarse_wood(), share), side, layers); }

/// Collisions book up to 1 % of the energy wrongly (docs/theory/overlap_contact.md); what lies still must not gain any of it back.
constexpr Demands kPoured{.closure = 0.02, .gain = 1e-3, .kinetic = 1e-4, .overlap = 0.2};

/// Six layers fall together: what sinks in by less than the whole edge has not passed through.
constexpr Demands kPouredFromHigh{.closure = 0.02, .gain = 1e-3, .kinetic = 1e-4, .overlap = 1.0};

}  // namespace

TEST_SUITE("stability-slow") {
    TEST_CASE("a heap of 36 blocks is poured and comes to rest") {
        const Model heap = make_poured_heap(3, 4, 0.1);
        check_sound("heap of 36", observe(heap, default_time_step(heap), 1.5, 300), kPoured);
    }

    TEST_CASE("a heap of 36 blocks with the nodes of both sides is poured and comes to rest") {
        Model heap = make_poured_heap(3, 4, 0.1);
        heap.numerics.face_contact = FaceContact::nodes;
        heap.numerics.contact_nodes = ContactNodes::both;
        check_sound("heap of 36, nodes of both sides", observe(heap, default_time_step(heap), 1.0, 200), kPoured);
    }

    TEST_CASE("a heap of 216 blocks is poured and comes to rest") {
        // blocks that are thrown out tumble over the ground and rock; of a heap of eight layers the last one until 1.8 s
        const Model heap = make_poured_heap(6, 6, 0.02);
        check_sound("heap of 216", observe(heap, default_time_step(heap), 1.8, 300), kPouredFromHigh);
    }
}
