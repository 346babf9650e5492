#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/result_options.hpp"
#include "lsdem/calibration/block_sample.hpp"
#include "lsdem/results/write_results.hpp"
#include "scaling/angle.hpp"

/// Parts that the tests of `musim calibrate` share; each adds its own subcommand.
namespace musim::cli {

using scaling::kDegree;
inline constexpr double kMega = 1e6;

/// The block under test: a preset, and what is said otherwise.
struct SampleOptions {
    std::string material;
    std::vector<Number> block;
    std::optional<Number> density, normal_stiffness, shear_stiffness, friction, ground_friction, restitution;

    void add_to(CLI::App& command);
    lsdem::BlockSample sample() const;
};

/// Options that every test has besides its own.
struct TestOptions : ResultOptions {
    SampleOptions sample;

    void add_to(CLI::App& app, const char* files);
};

nlohmann::json describe_sample(const lsdem::BlockSample& sample);

void add_stiffness_command(CLI::App& calibrate, Action& action);
void add_friction_command(CLI::App& calibrate, Action& action);
void add_restitution_command(CLI::App& calibrate, Action& action);
void add_presets_command(CLI::App& calibrate, Action& action);

}  // namespace musim::cli
