#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair.hpp"
#include "lsdem/study/run.hpp"
#include "lsdem/study/scale_specimen.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::study;
using musim::scaling::Law;
using musim::scaling::Similitude;

namespace {

constexpr double kError = 1.0 + 1e-6;

using Change = std::function<void(Model&)>;

Change change_materials(const std::function<void(Material&)>& change) {
    return [change](Model& model) {
        for (Material& material : model.materials) change(material);
        change(model.ground.material);
    };
}

/// Every property of a model that similitude asks for, off by a millionth; and one contact that has lost its friction.
std::vector<std::pair<std::string, Change>> make_errors() {
    return {{"nothing", [](Model&) {}},
            {"normal stiffness", change_materials([](Material& m) { m.normal_stiffness *= kError; })},
            {"shear stiffness", change_materials([](Material& m) { m.shear_stiffness *= kError; })},
            {"friction", change_materials([](Material& m) { m.friction *= kError; })},
            {"restitution", change_materials([](Material& m) { m.restitution *= kError; })},
            {"mass",
             [](Model& m) {
                 for (Block& block : m.blocks) block.mass *= kError;
             }},
            {"gravity", [](Model& m) { m.gravity *= kError; }},
            {"step of the record",
             [](Model& m) {
                 for (BaseComponent& along : m.ground.motion) along.dt *= kError;
             }},
            {"slip", [](Model& m) { m.preload.at(m.preload.size() / 2).friction.setZero(); }}};
}

}  // namespace

TEST_CASE("a millionth of any property, or one contact without its friction, is seen in one model among exact ones" *
          doctest::test_suite("slow")) {
    scene::Scene wall = scene::read_scene(std::filesystem::path(MUSIM_SOURCE_DIR) / "examples/uneven_wall.json");
    wall.output.frame_rate.reset();
    PairMember prototype{"prototype", make_specimen(wall), {}, Similitude({}, Law::exact)};
    prototype.plan = make_time_plan(wall, prototype.specimen.model);
    prototype.specimen.settling.reset();
    std::vector<PairMember> models;
    for (const auto& [name, change] : make_errors()) {
        const Similitude similitude({.length = 0.3}, Law::exact);
        models.push_back({name, scale_specimen(prototype.specimen, similitude), prototype.plan.scaled(similitude.time()), similitude});
        change(models.back().specimen.model);
    }
    const PairStudy study = run_pair(prototype, models, Materials::exact, {.threads = 0}, {.twins = 8, .half_step = false});
    CHECK(study.same_bits == true);
    for (const PairedRun& model : study.models) {
        CAPTURE(model.label);
        CAPTURE(model.judgement.lead);
        CHECK(model.judgement.agreement == (model.label == "nothing" ? Agreement::agree : Agreement::differ));
        // well before the horizon, by its departure
        if (model.label != "nothing") CHECK(model.judgement.lead_time < study.yardstick().horizon());
    }
}
