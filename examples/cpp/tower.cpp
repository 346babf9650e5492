// Motion of the top of a concrete tower against its base under a record, by a model at 1:25, in the prototype's units.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <stdexcept>

#include "lsdem/lsdem.hpp"
#include "scaling/scaling.hpp"

int main(int argc, char** argv) try {
    using namespace musim;
    using namespace boost::units::si;
    if (argc != 3) throw std::invalid_argument("usage: tower RECORD COMPONENT");

    lsdem::Scene tower{.name = "six layers of fourteen blocks"};
    const lsdem::Triple<scaling::Length> block{1.36 * meters, 2.82 * meters, 4.25 * meters};
    tower.structure = lsdem::Tower{.layers = 6, .block = block, .tiling = lsdem::find_tiling_preset("ring_14")};
    tower.material = lsdem::fit_to_block(lsdem::find_material_preset("concrete"), block);
    tower.base_motion.source = lsdem::RecordMotion{.file = std::filesystem::absolute(argv[1]), .components = {argv[2]}};
    tower.time.duration = 20.0 * seconds;
    tower.output.spine_rate = 10.0 * hertz;

    const auto similitude = scaling::make_similitude("mu", {.length = 1.0 / 25.0, .friction = 0.65 / 0.59});
    for (const auto& [time, x, y, z] : lsdem::measure_top(lsdem::run_model(tower, similitude, {.threads = 2}))) {
        fmt::print("{:6.2f} s  {:8.4f} m\n", time.value(), x.value());
    }
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
