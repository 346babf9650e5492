#include "lsdem/scene/scale_scene.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/build_model.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;
using scaling::make_similitude;
using scaling::Similitude;

namespace {

std::vector<double> times(std::vector<double> values, double factor) {
    for (double& value : values) value *= factor;
    return values;
}

void check_vector(const Vector3& scaled, const Vector3& prototype, double factor) { CHECK(scaled == Vector3(prototype * factor)); }

/// Level-set values on a coarse lattice around the body, for any kind of level set.
void check_level_sets(const Shape& scaled, const Shape& prototype, double length) {
    REQUIRE(scaled.level_set.index() == prototype.level_set.index());
    const auto value = [](const Shape& shape, const Vector3& x) {
        return std::visit([&](const auto& set) { return set.value(x); }, shape.level_set);
    };
    for (int i = -4; i <= 4; ++i) {
        for (int j = -4; j <= 4; ++j) {
            const Vector3 x(0.3 * i * prototype.half_extents.x(), 0.3 * j * prototype.half_extents.y(),
                            0.3 * (i + j) * prototype.half_extents.z());
            CHECK(value(scaled, length * x) == length * value(prototype, x));
        }
    }
}

void check_shapes(const Shape& scaled, const Shape& prototype, double length) {
    const SurfaceNodes& a = scaled.nodes;
    const SurfaceNodes& b = prototype.nodes;
    for (const auto member : {&SurfaceNodes::x, &SurfaceNodes::y, &SurfaceNodes::z, &SurfaceNodes::center_x, &SurfaceNodes::center_y,
                              &SurfaceNodes::center_z, &SurfaceNodes::half_x, &SurfaceNodes::half_y, &SurfaceNodes::half_z}) {
        CHECK(a.*member == times(b.*member, length));
    }
    for (const auto member : {&SurfaceNodes::area_x, &SurfaceNodes::area_y, &SurfaceNodes::area_z}) {
        CHECK(a.*member == times(b.*member, length * length));
    }
    check_vector(scaled.half_extents, prototype.half_extents, length);
    CHECK(scaled.volume == prototype.volume * length * length * length);
    check_vector(scaled.inertia_over_mass, prototype.inertia_over_mass, length * length);
    CHECK(scaled.face_area == prototype.face_area * length * length);
    check_level_sets(scaled, prototype, length);
}

void check_materials(const Material& scaled, const Material& prototype, const Similitude& s) {
    const double stiffness_per_area = s.factor<scaling::StiffnessPerArea>();
    CHECK(scaled.normal_stiffness == prototype.normal_stiffness * stiffness_per_area);
    CHECK(scaled.shear_stiffness == prototype.shear_stiffness * stiffness_per_area);
    CHECK(scaled.friction == prototype.friction * s.friction());
    CHECK(scaled.restitution == prototype.restitution);
    CHECK(scaled.shear_damping_ratio == prototype.shear_damping_ratio);
}

/// Every field of `scaled` is that of `prototype` times its factor, to the last bit.
void check_models(const Model& scaled, const Model& prototype, const Similitude& s) {
    REQUIRE(scaled.shapes.size() == prototype.shapes.size());
    for (std::size_t k = 0; k < scaled.shapes.size(); ++k) check_shapes(scaled.shapes[k], prototype.shapes[k], s.length());
    REQUIRE(scaled.materials.size() == prototype.materials.size());
    for (std::size_t k = 0; k < scaled.materials.size(); ++k) check_materials(scaled.materials[k], prototype.materials[k], s);
    REQUIRE(scaled.blocks.size() == prototype.blocks.size());
    for (std::size_t k = 0; k < scaled.blocks.size(); ++k) {
        const Block& a = scaled.blocks[k];
        const Block& b = prototype.blocks[k];
        CHECK(a.shape == b.shape);
        CHECK(a.material == b.material);
        CHECK(a.mass == b.mass * s.mass());
        CHECK(a.height_offset == b.height_offset * s.length());
        check_vector(a.position, b.position, s.length());
        CHECK(a.orientation.coeffs() == b.orientation.coeffs());
        check_vector(a.velocity, b.velocity, s.velocity());
        check_vector(a.angular_velocity, b.angular_velocity, s.frequency());
        CHECK(a.fixed == b.fixed);
        CHECK(a.rotation_locked == b.rotation_locked);
    }
    CHECK(scaled.ground.present == prototype.ground.present);
    check_materials(scaled.ground.material, prototype.ground.material, s);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(scaled.ground.motion.shift[axis].start == prototype.ground.motion.shift[axis].start * s.time());
        CHECK(scaled.ground.motion.shift[axis].dt == prototype.ground.motion.shift[axis].dt * s.time());
        CHECK(scaled.ground.motion.shift[axis].velocity == times(prototype.ground.motion.shift[axis].velocity, s.velocity()));
    }
    check_vector(scaled.gravity, prototype.gravity, s.gravity());
    CHECK(scaled.numerics.contact_nodes == prototype.numerics.contact_nodes);
    CHECK(scaled.numerics.face_contact == prototype.numerics.face_contact);
}

const std::string kSynthetic =
    R"(, "base_motion": {"signal": "synthetic", "pga": "0.511 g", "pgv": "42.4 cm/s", "duration": "10 s", "dt": "0.005 s", "start": "0.3 s"})";
const std::string kSineMotion = R"(, "base_motion": {"signal": "sine", "amplitude": "0.4 g", "frequency": "3 Hz", "cycles": 4})";
const std::string kGrid = R"(, "shape": {"kind": "box", "level_set": "grid", "voxel": "0.65 mm"})";
const std::string kSphere = R"(, "shape": {"kind": "sphere", "radius": "10 cm", "nodes": 60, "voxel": "1 cm"})";

}  // namespace

TEST_CASE("the model of a twin is the scaled model, bit for bit in all fields, for factors that are powers of two") {
    const std::vector<std::string> texts{
        make_scene_text(kTower, kSynthetic),
        make_scene_text(kWall, kSineMotion),
        make_scene_text(kWall, kSineMotion + R"(, "contact": {"faces": "nodes", "nodes": "both"})"),
        make_scene_text(kBlocks, kSteel + kRicker + R"(, "ground": {"friction": 0.2})"),
        make_scene_text(kColumn, kGrid + R"(, "base_motion": {"signal": "step", "velocity": "32 mm/s"})"),
        make_scene_text(R"({"kind": "blocks", "blocks": [{"position": [0, 0, "0.1 m"], "velocity": [1, 2, 3]}]})", kSphere),
    };
    const std::vector<Similitude> similitudes{
        make_similitude("exact", {.length = 1.0 / 16.0}),
        make_similitude("exact", {.length = 1.0 / 64.0}),
        make_similitude("exact", {.length = 4.0, .gravity = 4.0, .density = 0.5}),
        make_similitude("mu", {.length = 1.0 / 16.0, .friction = 0.25}),
        make_similitude("froude", {.length = 1.0 / 16.0, .friction = 0.25}),
    };
    for (const std::string& text : texts) {
        const Scene scene = parse_scene(text);
        const Model prototype = make_model(scene);
        for (const Similitude& similitude : similitudes) {
            CAPTURE(text);
            CAPTURE(similitude.length());
            check_models(make_model(scale_scene(scene, similitude)), prototype, similitude);
        }
    }
}

TEST_CASE("times, rates and the time step of a twin are scaled") {
    Scene scene = parse_scene(make_scene_text(kColumn, R"(, "output": {"spine_rate": "100 Hz", "frame_rate": "25 Hz"})"));
    scene.time.step = scaling::Time::from_value(1e-4);
    const Scene twin = scale_scene(scene, make_similitude("exact", {.length = 1.0 / 16.0}));
    CHECK(twin.time.duration.value() == 0.25);
    CHECK(twin.time.step->value() == 0.25e-4);
    CHECK(twin.time.safety == scene.time.safety);
    CHECK(twin.output.spine_rate.value() == 400.0);
    CHECK(twin.output.frame_rate->value() == 100.0);
    CHECK(twin.name == scene.name);
}

TEST_CASE("the automatic time step of a twin is the scaled one, bit for bit") {
    const Scene scene = parse_scene(make_scene_text(kTower));
    const Similitude similitude = make_similitude("exact", {.length = 1.0 / 16.0});
    const Scene twin = scale_scene(scene, similitude);
    CHECK(compute_time_step(twin, make_model(twin)).value() == compute_time_step(scene, make_model(scene)).value() * similitude.time());
}

TEST_CASE("scaling in two steps is scaling once, bit for bit") {
    const Scene scene = parse_scene(make_scene_text(kTower, kSynthetic));
    const Similitude quarter = make_similitude("exact", {.length = 1.0 / 4.0}),
                     sixteenth = make_similitude("exact", {.length = 1.0 / 16.0});
    CHECK(scale_scene(scale_scene(scene, quarter), quarter) == scale_scene(scene, sixteenth));
    CHECK(scale_scene(scene, Similitude()) == scene);
}

TEST_CASE("a twin written to text is the same twin") {
    const Scene twin = scale_scene(parse_scene(make_scene_text(kTower, kSynthetic)), make_similitude("exact", {.length = 1.0 / 107.0}));
    CHECK(parse_scene(write_scene(twin)) == twin);
}

TEST_CASE("under the mu law friction, gravity and motion each follow their own factor") {
    const Scene scene = parse_scene(make_scene_text(kColumn, kSineMotion + R"(, "ground": {"friction": 0.4})"));
    const Similitude similitude = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.5, .gravity = 2.0, .density = 3.0});
    const Scene model = scale_scene(scene, similitude);
    CHECK(model.material.friction == scene.material.friction * 0.5);
    CHECK(model.ground.friction == 0.2);
    CHECK(model.gravity[2].value() == scene.gravity[2].value() * 2.0);  // not λ_a = λ_μ λ_g
    CHECK(model.material.density.value() == scene.material.density.value() * 3.0);
    CHECK(model.base_motion.factors.time == similitude.time());
    CHECK(model.base_motion.factors.velocity == similitude.velocity());
    // vertical shaking by λ_g λ_t, written in the file where it is another factor
    CHECK(model.base_motion.factors.velocity_vertical == doctest::Approx(2.0 * similitude.time()).epsilon(1e-15).scale(0.0));
    CHECK(parse_scene(write_scene(model)).base_motion.factors == model.base_motion.factors);
    CHECK(write_scene(scene).find("velocity_vertical") == std::string::npos);
}

TEST_CASE("a twin moves along z by its own factor") {
    const std::string step = R"(, "base_motion": {"signal": "step", "velocity": "32 mm/s", "direction": ")";
    const Similitude similitude = make_similitude("mu", {.length = 1.0 / 16.0, .friction = 0.25});
    const auto velocity = [&](const char* direction, std::size_t axis) {
        const Scene model = scale_scene(parse_scene(make_scene_text(kColumn, step + direction + R"("})")), similitude);
        return make_base_components(model.base_motion).shift[axis].velocity.front();
    };
    CHECK(velocity("x", 0) == 0.032 / 8.0);
    CHECK(velocity("z", 2) == 0.032 / 2.0);
}

TEST_CASE("a twin of its own material keeps geometry and motion and takes the measured properties of its block") {
    Scene scene = parse_scene(make_scene_text(R"({"kind": "column", "layers": 2, "block": ["1.36 m", "2.82 m", "4.25 m"]})", kSineMotion));
    scene.material.shear_damping_ratio = 0.1;
    scene.time.step = scaling::Time::from_value(1e-4);
    const Similitude similitude = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.63 / 0.59});
    const Scene twin = scale_with_own_material(scene, similitude, find_material_preset("wood"));
    const Scene exact = scale_scene(scene, similitude);
    CHECK(twin.structure == exact.structure);
    CHECK(twin.base_motion == exact.base_motion);
    CHECK(twin.material.density.value() == 800.0);
    // a division and some multiplications by 1/107 on the way
    CHECK(twin.material.normal_stiffness.value() == doctest::Approx(30e6).epsilon(1e-14));
    CHECK(twin.material.friction == 0.63);
    CHECK(twin.material.restitution == 0.3);
    CHECK(twin.material.shear_damping_ratio == 0.1);
    CHECK_FALSE(twin.time.step);
}

TEST_CASE("a scale that leaves the range of doubles is refused") {
    const Scene scene = parse_scene(make_scene_text(kColumn));
    check_message(error_of([&] { scale_scene(scene, make_similitude("exact", {.density = 1e305})); }),
                  {"scene at 1:1: /material/normal_stiffness: inf"});
}
