#include "lsdem/model_hash.hpp"

#include "lsdem/archive.hpp"
#include "lsdem/material_fields.hpp"

namespace musim::lsdem {
namespace {

/// Level sets are hashed, never read back.
void exchange(Archive& archive, std::variant<BoxLevelSet, GridLevelSet>& level_set) {
    std::size_t kind = level_set.index();
    archive(kind);
    if (auto* box = std::get_if<BoxLevelSet>(&level_set)) archive(box->half);
    if (const auto* grid = std::get_if<GridLevelSet>(&level_set)) {
        Vector3 origin = grid->origin();
        double spacing = grid->spacing();
        std::array<std::size_t, 3> counts = grid->counts();
        std::vector<double> values = grid->values();
        archive(origin, spacing, counts, values);
    }
}

}  // namespace

// a field that is missing here lets a state pass for that of another model
static void exchange(Archive& archive, SurfaceNodes& n) {
    archive(n.x, n.y, n.z, n.area_x, n.area_y, n.area_z, n.center_x, n.center_y, n.center_z, n.half_x, n.half_y, n.half_z);
}

static void exchange(Archive& archive, Plane& p) { archive(p.normal, p.offset); }

static void exchange(Archive& archive, Polyhedron::Face& f) { archive(f.plane, f.first, f.count, f.outer); }

static void exchange(Archive& archive, Polyhedron& p) { archive(p.corners, p.faces, p.loops, p.neighbours, p.wholes); }

static void exchange(Archive& archive, Shape& s) {
    exchange(archive, s.level_set);
    archive(s.nodes, s.faceted, s.node_spacing, s.half_extents, s.volume, s.inertia_over_mass, s.face_area);
    if (s.solid == nullptr) return;
    Solid solid = *s.solid;
    archive(solid.pieces);
}

static void exchange(Archive& archive, Material& m) {
    for (const MaterialField& field : kMaterialFields) archive(m.*field.member);
}

static void exchange(Archive& archive, MaterialPair& p) { archive(p.first, p.second, p.joint); }

static void exchange(Archive& archive, Block& b) {
    archive(b.shape, b.material, b.mass, b.height_offset, b.position, b.orientation, b.velocity, b.angular_velocity, b.fixed,
            b.rotation_locked, b.with_base);
}

static void exchange(Archive& archive, BaseComponent& c) { archive(c.start, c.dt, c.velocity); }

/// Models whose ground does not turn keep their names.
static void exchange(Archive& archive, BaseComponents& m) {
    archive(m.shift);
    if (m.turns()) archive(m.turn, m.pivot);
}

static void exchange(Archive& archive, Ground& g) { archive(g.present, g.material, g.motion); }

static void exchange(Archive& archive, Preload& p) { archive(p.leader, p.follower, p.friction, p.couple); }

/// Nothing of a model without it, whose states keep their names.
static void exchange(Archive& archive, JointScatter& s) {
    if (s.friction != 0.0) archive(s.friction, s.seed);
}

static void exchange(Archive& archive, Load& l) {
    archive(l.block, l.point, l.direction, l.force, l.displacement, l.stiffness, l.start, l.rise);
}

static void exchange(Archive& archive, Model& m) {
    archive(m.shapes, m.materials, m.pairs, m.blocks, m.ground, m.gravity, m.numerics.contact_nodes, m.numerics.skip_rest,
            m.numerics.skip_apart, m.numerics.face_contact, m.velocity_damping, m.preload, m.scatter);
    // nothing of a model without any, as of scatter
    for (Load& load : m.loads) archive(load);
}

std::uint64_t hash_model(Model model, double time_step) {
    Archive archive;
    archive(model, time_step);
    return hash_bytes(archive.bytes());
}

}  // namespace musim::lsdem
