#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/cli/program.hpp"

using namespace musim::cli;
using doctest::Approx;

namespace {

nlohmann::json make(const Workplace& here, const std::string& arguments) {
    const Outcome outcome = here.run("record make " + arguments + " --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return outcome.json();
}

/// The only component of a record, as `record info` gives it.
nlohmann::json info_of(const Workplace& here, const std::string& file) {
    return here.run("record info --json " + file).json()["components"].at(0);
}

}  // namespace

TEST_CASE("record make writes motions that have what was asked for") {
    const Workplace here;
    const auto ricker = make(here, "ricker --frequency 2 --pga 0.3 --dt 0.004 -o ricker.csv");
    CHECK(ricker["peaks"]["pga_g"].get<double>() == Approx(0.3).epsilon(1e-12));
    CHECK(ricker["peaks"]["dt_s"] == 0.004);
    CHECK(ricker["history"].at(0).get<std::string>().find("2 Hz") != std::string::npos);
    CHECK(info_of(here, "ricker.csv")["pga_g"] == ricker["peaks"]["pga_g"]);

    // the sampled velocity is off by (2π f dt)²/12, 2e-5
    CHECK(make(here, "pulse --frequency 0.5 --amplitude 80 --cycles 2.4 -o pulse.at2")["peaks"]["pgv_cm_s"].get<double>() ==
          Approx(80.0).epsilon(1e-4));
    CHECK(make(here, "pulse --cycles 2.4 --return-home -o home.csv")["history"].at(0).get<std::string>().find("instead of") !=
          std::string::npos);

    const auto sweep = make(here, "sweep --from 1 --to 8 --amplitude 0.05 --duration 30 --linear -o sweep.csv");
    CHECK(sweep["peaks"]["duration_s"].get<double>() == Approx(30.0));
    CHECK(sweep["history"].at(0).get<std::string>().starts_with("made: linear sine sweep"));

    make(here, "stochastic --pga 0.4 --pgv 30 --d5-95 12 --seed 7 -o noise.csv");
    const auto noise = info_of(here, "noise.csv");
    CHECK(noise["pga_g"].get<double>() == Approx(0.4).epsilon(1e-9));
    CHECK(noise["pgv_cm_s"].get<double>() == Approx(30.0).epsilon(1e-6));
    CHECK(noise["d5_95_s"].get<double>() == Approx(12.0).epsilon(0.01));

    const Outcome table = here.run("record make ricker -o table.csv");
    CHECK(table.out.find("PGA [g]") != std::string::npos);
    CHECK(table.out.find("Written to table.csv") != std::string::npos);
}

// The pulse's closed form [MavroeidisPapageorgiou03] with γ = 2, ν = 0, v = A/2 (1 + cos πf τ) cos 2πf τ, on oscillators of 5 % damping
// that go on for its length after it, by the classic Runge-Kutta method.
TEST_CASE("record info finds the period of a short pulse") {
    constexpr double frequency = 0.5, length = 4.0, pi = std::numbers::pi;  // [Hz], [s]
    const auto acceleration = [&](double t) {                               // of A = 1 m/s
        if (t > length) return 0.0;
        const double theta = 2.0 * pi * frequency * (t - 0.5 * length);
        return -pi * frequency * (0.5 * std::sin(0.5 * theta) * std::cos(theta) + (1.0 + std::cos(0.5 * theta)) * std::sin(theta));
    };
    double expected = 0.0, largest = 0.0;
    for (double period = 0.5; period <= length; period *= 1.01) {
        const double omega = 2.0 * pi / period, h = period / 200.0;
        const auto pull = [&](double t, double u, double v) { return -acceleration(t) - 0.1 * omega * v - omega * omega * u; };
        double u = 0.0, v = 0.0, most = 0.0;
        for (double t = 0.0; t < 2.0 * length; t += h) {
            const double k1 = pull(t, u, v), v2 = v + 0.5 * h * k1, k2 = pull(t + 0.5 * h, u + 0.5 * h * v, v2);
            const double v3 = v + 0.5 * h * k2, k3 = pull(t + 0.5 * h, u + 0.5 * h * v2, v3);
            const double v4 = v + h * k3, k4 = pull(t + h, u + h * v3, v4);
            u += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
            v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            most = std::max(most, std::abs(u));
        }
        if (omega * most > largest) largest = omega * most, expected = period;
    }
    CAPTURE(expected);
    CHECK(expected == Approx(2.0).epsilon(0.2));

    const Workplace here;
    make(here, "pulse --frequency 0.5 --cycles 2 --phase 0 -o pulse.csv");
    // 200 periods over a ratio of 200 are 3 % apart, those here 1 %
    CHECK(info_of(here, "pulse.csv")["pulse_period_s"].get<double>() == Approx(expected).epsilon(0.04));
}

TEST_CASE("what record make cannot do is one error line") {
    const Workplace here;
    for (const auto& [code, arguments] : {std::pair{2, "ricker --frequency 0 -o a.csv"},
                                          {3, "ricker --frequency 100 -o a.csv"},
                                          {2, "pulse --cycles 1 -o a.csv"},
                                          {3, "sweep --from 5 --to 5 -o a.csv"},
                                          {2, "sweep --taper 0.7 -o a.csv"},
                                          {3, "stochastic --d5-95 39 -o a.csv"},
                                          {2, "ricker -o a.xyz"},
                                          {3, "ricker -o nowhere/a.csv"}}) {
        const std::string wrong = arguments;
        const Outcome outcome = here.run("record make " + wrong);
        CHECK_MESSAGE(outcome.exit_code == code, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), wrong, " gave ", outcome.err);
        CHECK_FALSE(here.has("a.csv"));
    }
    for (const char* wrong : {"", "earthquake -o a.csv", "ricker", "ricker --frequency x -o a.csv", "stochastic --seed -1 -o a.csv"}) {
        const Outcome outcome = here.run(std::string("record make ") + wrong);
        CHECK_MESSAGE(outcome.exit_code == 2, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), wrong, " gave ", outcome.err);
    }
}
