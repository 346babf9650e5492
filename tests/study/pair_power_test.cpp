#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/model_errors.hpp"
#include "lsdem/study/pair.hpp"
#include "lsdem/study/run.hpp"
#include "lsdem/study/scale_specimen.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::study;
using musim::scaling::Law;
using musim::scaling::Similitude;

namespace {

constexpr double kSize = 1e-6;

}  // namespace

TEST_CASE("errors of a millionth are found in one model among exact ones" * doctest::test_suite("slow")) {
    scene::Scene wall = scene::read_scene(std::filesystem::path(MUSIM_SOURCE_DIR) / "examples/uneven_wall.json");
    wall.output.frame_rate.reset();
    PairMember prototype{"prototype", make_specimen(wall), {}, Similitude({}, Law::exact)};
    prototype.plan = make_time_plan(wall, prototype.specimen.model);
    prototype.specimen.settling.reset();
    const Similitude similitude({.length = 0.3}, Law::exact);
    const PairMember exact{"exact", scale_specimen(prototype.specimen, similitude), prototype.plan.scaled(similitude.time()), similitude};
    std::vector<PairMember> models{exact};
    for (const ModelError error : all_model_errors()) {
        models.push_back(exact);
        models.back().label = to_string(error);
        inject(error, kSize, models.back().specimen.model);
    }
    const PairStudy study = run_pair(prototype, models, Materials::exact, {.threads = 0}, {.twins = 8, .half_step = false});
    CHECK(study.same_bits == true);
    for (const PairedRun& model : study.models) {
        CAPTURE(model.label);
        CAPTURE(model.judgement.lead);
        CHECK(model.judgement.agreement == (model.label == "exact" ? Agreement::agree : Agreement::differ));
        // well before the horizon, by its departure
        if (model.label != "exact") CHECK(model.judgement.lead_time < study.yardstick().horizon());
    }
}
