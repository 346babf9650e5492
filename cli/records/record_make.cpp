#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/records/record_output.hpp"
#include "cli/records/record_peaks.hpp"
#include "cli/usage.hpp"
#include "cli/whole_option.hpp"
#include "records/synthesis/ricker.hpp"
#include "records/synthesis/sine_sweep.hpp"
#include "records/synthesis/synthetic.hpp"
#include "records/synthesis/velocity_pulse.hpp"

namespace musim::cli {
namespace {

using scaling::si::meters_per_second;
using scaling::si::seconds;

/// Options that every kind of motion has.
struct MakeOptions {
    Number dt{0.005};  ///< [s]
    RecordOutputOptions output;
    bool json = false;

    void add_to(CLI::App& command) {
        command.add_option("--dt", dt, "Time step [s] (default 0.005)")->type_name("NUMBER")->check(above_zero());
        output.add_to(command);
        add_json_option(command, json);
    }
};

CLI::Option* add_number(CLI::App& command, const std::string& name, Number& number, const std::string& help) {
    return command.add_option(name, number, help + fmt::format(" (default {:g})", number.value))->type_name("NUMBER");
}

/// Makes, writes and reports.
int make_record(const MakeOptions& options, const std::function<records::GroundMotion()>& make) {
    options.output.check();
    const records::GroundMotion motion = make();
    options.output.write(motion);
    const records::Component& component = motion.components.front();
    const NamedValues peaks = find_peaks(motion, component);
    if (options.json) {
        print_json({{"out", options.output.out}, {"event", motion.event}, {"history", motion.history}, {"peaks", to_json(peaks)}});
        return kDone;
    }
    print_titles("", peaks);
    print_row("made", peaks);
    print("\n{}\n\nWritten to {}\n", motion.history.front(), options.output.out);
    return kDone;
}

/// Adds what every kind of motion is asked; the command writes the record that `make` makes of its options.
template <class Options, class Make>
void finish(CLI::App& command, Action& action, const std::shared_ptr<Options>& options, const Make& make) {
    options->common.add_to(command);
    command.callback(
        [&action, options, make] { action = [options, make] { return make_record(options->common, [&] { return make(*options); }); }; });
}

struct RickerOptions {
    MakeOptions common;
    Number frequency{1.0}, pga{0.5};
};

void add_ricker(CLI::App& make, Action& action) {
    auto options = std::make_shared<RickerOptions>();
    CLI::App* command = make.add_subcommand("ricker", "Ricker acceleration pulse, two periods to each side of its peak");
    add_number(*command, "--frequency", options->frequency, "Peak frequency [Hz]")->check(above_zero());
    add_number(*command, "--pga", options->pga, "Peak acceleration [g]")->check(above_zero());
    finish(*command, action, options, [](const RickerOptions& asked) {
        return records::make_ricker_record(
            {.amplitude = asked.pga.value * scaling::kStandardGravity, .frequency = asked.frequency.value / seconds},
            asked.common.dt.value * seconds);
    });
}

struct PulseOptions {
    MakeOptions common;
    Number frequency{0.5}, amplitude{50.0}, cycles{2.0}, phase{0.0};
    bool return_home = false;
};

void add_pulse(CLI::App& make, Action& action) {
    auto options = std::make_shared<PulseOptions>();
    CLI::App* command = make.add_subcommand("pulse", "Near-fault velocity pulse of Mavroeidis and Papageorgiou (2003)");
    add_number(*command, "--frequency", options->frequency, "Prevailing frequency f_p [Hz]")->check(above_zero());
    add_number(*command, "--amplitude", options->amplitude, "Amplitude A of the velocity's envelope [cm/s]")->check(above_zero());
    add_number(*command, "--cycles", options->cycles, "Length of the envelope in periods, gamma, above 1")
        ->check(check_number([](double cycles) { return cycles > 1.0; }, " is not above 1"));
    add_number(*command, "--phase", options->phase, "Phase nu [degrees]; 90 is antisymmetric");
    command->add_flag("--return-home", options->return_home, "End without displacement; by default the pulse's own residual stays");
    finish(*command, action, options, [](const PulseOptions& asked) {
        return records::make_velocity_pulse_record({.amplitude = 0.01 * asked.amplitude.value * meters_per_second,
                                                    .frequency = asked.frequency.value / seconds,
                                                    .cycles = asked.cycles,
                                                    .phase_deg = asked.phase},
                                                   asked.common.dt.value * seconds, asked.return_home);
    });
}

struct SweepOptions {
    MakeOptions common;
    Number from{0.5}, to{10.0}, amplitude{0.1}, duration{40.0}, taper{0.05};
    bool linear = false;
};

void add_sweep(CLI::App& make, Action& action) {
    auto options = std::make_shared<SweepOptions>();
    CLI::App* command = make.add_subcommand("sweep", "Sine sweep, logarithmic in time unless --linear");
    add_number(*command, "--from", options->from, "First frequency [Hz]")->check(above_zero());
    add_number(*command, "--to", options->to, "Last frequency [Hz]")->check(above_zero());
    add_number(*command, "--amplitude", options->amplitude, "Amplitude of the acceleration [g]")->check(above_zero());
    add_number(*command, "--duration", options->duration, "Duration [s]")->check(above_zero());
    add_number(*command, "--taper", options->taper, "Part that each end fades over [fraction of the duration, 0 to 0.5]")
        ->check(between(0.0, 0.5));
    command->add_flag("--linear", options->linear, "Equal time per Hz instead of per octave");
    finish(*command, action, options, [](const SweepOptions& asked) {
        return records::make_sine_sweep_record({.amplitude = asked.amplitude.value * scaling::kStandardGravity,
                                                .first = asked.from.value / seconds,
                                                .last = asked.to.value / seconds,
                                                .kind = asked.linear ? records::SweepKind::linear : records::SweepKind::logarithmic,
                                                .dt = asked.common.dt.value * seconds,
                                                .duration = asked.duration.value * seconds,
                                                .taper = asked.taper});
    });
}

struct StochasticOptions {
    MakeOptions common;
    Number pga{0.511}, pgv{42.4}, duration{40.0};
    std::optional<Number> d5_95;
    std::uint64_t seed = 1;
};

void add_stochastic(CLI::App& make, Action& action) {
    auto options = std::make_shared<StochasticOptions>();
    CLI::App* command = make.add_subcommand("stochastic", "Filtered noise that has PGA, PGV and, if wanted, D5-95");
    add_number(*command, "--pga", options->pga, "Peak acceleration [g]")->check(above_zero());
    add_number(*command, "--pgv", options->pgv, "Peak velocity [cm/s]")->check(above_zero());
    command->add_option("--d5-95", options->d5_95, "Significant duration [s], met within 1 % (default: free)")
        ->type_name("NUMBER")
        ->check(above_zero());
    add_number(*command, "--duration", options->duration, "Duration [s]")->check(above_zero());
    add_whole_option(*command, "--seed", options->seed, "Another seed, another motion")->capture_default_str();
    finish(*command, action, options, [](const StochasticOptions& asked) {
        records::SyntheticSettings settings{.pga = asked.pga.value * scaling::kStandardGravity,
                                            .pgv = 0.01 * asked.pgv.value * meters_per_second,
                                            .dt = asked.common.dt.value * seconds,
                                            .duration = asked.duration.value * seconds,
                                            .seed = asked.seed};
        if (asked.d5_95) settings.d5_95 = asked.d5_95->value * seconds;
        return records::make_synthetic_record(settings);
    });
}

}  // namespace

void add_record_make_command(CLI::App& record, Action& action) {
    CLI::App* command = record.add_subcommand("make", "Make a motion: Ricker pulse, near-fault pulse, sweep or filtered noise");
    command->require_subcommand(1);
    add_ricker(*command, action);
    add_pulse(*command, action);
    add_sweep(*command, action);
    add_stochastic(*command, action);
    group_commands(*command, "Make a motion by a formula", {"ricker", "pulse", "sweep"});
    group_commands(*command, "Make an earthquake", {"stochastic"});
    command->footer(
        "Examples:\n"
        "  musim record make ricker --frequency 2 --pga 0.3 -o ricker.csv\n"
        "  musim record make pulse --frequency 0.5 --amplitude 80 --cycles 2.4 --phase 60 -o pulse.csv\n"
        "  musim record make sweep --from 0.5 --to 20 --amplitude 0.05 --duration 60 -o sweep.at2\n"
        "  musim record make stochastic --pga 0.4 --pgv 30 --d5-95 12 --seed 7 -o noise.csv --json");
}

}  // namespace musim::cli
