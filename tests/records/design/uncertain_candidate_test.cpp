#include "records/design/uncertain_candidate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "records/design/parse_design.hpp"
#include "records/design/sampled_candidate.hpp"
#include "records/error.hpp"
#include "scaling/uncertainty/uncertain_reading.hpp"
#include "tests/records/design/tower.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using musim::tests::message_of;
using scaling::FirstOrder;

/// Exponents are exact but for rounding, variances add by two roundings each.
constexpr double kSampleRounding = 1e-12;

const std::string kUncertainPrototype =
    R"("prototype": {"block": ["1.36 m", "2.82 m", "4.25 m"], "height": "161.5 +/- 1% m", "density": "2320 kg/m^3", "friction": "0.59 +/- 5%",
       "mass": "2.7e8 +/- 2% kg", "modulus": "29.2 GPa +/- 4%"})";
const std::string kWood =
    R"({"name": "wood", "density": "800 +/- 3% kg/m^3", "friction": "0.63+/-5%", "modulus": "3.56e9 Pa", "smallest_edge": "8 mm +/- 2%"})";
const std::string kTable =
    R"({"schema": "musim-table/1", "axes": [{"names": ["x"], "velocity": "25 cm/s +/- 4%", "payload": "500 kg +/- 6%",
    "acceleration": [{"payload": "0 kg", "limit": "2 g +/- 5%"}, {"payload": "1 t", "limit": "2 g +/- 5%"}],
    "force": "80 kN +/- 10%", "moving_mass": "3 t", "highest_frequency": "100 Hz"}]})";

/// A design on the table, with uncertain peaks.
Setting read_setting(const std::string& more, scaling::UncertainReading& reading, const std::string& material = kWood) {
    const std::string json = R"({"schema": "musim-design/1", )" + kUncertainPrototype +
                             R"(, "table": "t.json", "record": {"peaks": [{"axis": "x",
        "acceleration": "0.511 g", "velocity": "42.4 cm/s +/- 1%", "highest_frequency": "10 Hz +/- 2%"}]}, "materials": [)" +
                             material + "]" + more + "}";
    Setting setting{parse_design(json, "d.json", {}, &reading), {}};
    setting.loads = make_loads(std::get<std::vector<GivenPeaks>>(setting.design.motion),
                               records::parse_shake_table(kTable, "t.json", &reading), "d.json");
    return setting;
}

struct Answer {
    std::vector<scaling::UncertainInput> inputs;
    std::vector<Candidate> candidates;
    std::vector<UncertainCandidate> uncertain;
};

Answer find_answer(const std::string& more, const std::string& material = kWood) {
    scaling::UncertainReading reading("d.json");
    const Setting setting = read_setting(more, reading, material);
    std::vector<MovedSetting> moved;
    for (const auto& each :
         scaling::read_moved(reading, [&](scaling::UncertainReading& one) { return read_setting(more, one, material); })) {
        moved.push_back({each.below, each.above});
    }
    const std::vector<Candidate> candidates = find_candidates(setting);
    return {reading.inputs(), candidates, propagate(setting, candidates, reading.inputs(), moved)};
}

/// Samples of the only candidate.
struct SampledAnswer {
    Candidate candidate;
    SampledCandidate sampled;

    const SampledLimit& limit(const std::string& name) const {
        std::size_t i = 0;
        while (candidate.limits.at(i).limit != name) ++i;
        return sampled.limits[i];
    }
};

SampledAnswer draw_answer(const std::string& more, const std::string& material, const scaling::MonteCarloSettings& settings) {
    scaling::UncertainReading reading("d.json");
    const auto read = [&](scaling::UncertainReading& each) { return read_setting(more, each, material); };
    const Setting setting = read(reading);
    const std::vector<Candidate> candidates = find_candidates(setting);
    const auto draw = [&](std::span<const double> values) { return scaling::read_drawn(reading, values, read); };
    return {candidates.front(), draw_candidates(setting, candidates, reading.inputs(), draw, settings).candidates.front()};
}

/// The normal distribution function.
double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Four standard errors of a share of samples.
double share_error(double share, std::size_t samples) { return 4.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(samples)); }

/// The uncertain range of a limit.
const UncertainRange& range_of(const Answer& answer, const std::string& limit) {
    const std::vector<LimitRanges>& limits = answer.candidates.front().limits;
    std::size_t i = 0;
    while (limits.at(i).limit != limit) ++i;
    return answer.uncertain.front().limits[i].front();
}

const FirstOrder& group_of(const Answer& answer, const std::string& name) {
    const std::vector<GroupFactor>& groups = answer.candidates.front().chosen->groups;
    std::size_t i = 0;
    while (groups.at(i).name != name) ++i;
    return answer.uncertain.front().chosen->groups[i];
}

}  // namespace

TEST_CASE("ends of length scales have the uncertainties of their closed forms") {
    const Answer answer = find_answer(R"(, "limits": {"hall_height": "6 m +/- 5 cm"})");
    // velocity: L ≤ (V/v)²/(U G)
    CHECK(range_of(answer, "velocity of axis x").largest->relative ==
          relative(std::hypot(std::hypot(0.08, 0.02), std::hypot(0.05, 0.05)), kSampleRounding));
    // payload: L ≤ (m/(R M))^(1/3)
    CHECK(range_of(answer, "payload of axis x").largest->relative ==
          relative(std::hypot(std::hypot(0.06, 0.03), 0.02) / 3.0, kSampleRounding));
    // highest frequency: L ≥ U G (f_P/f)²
    CHECK(range_of(answer, "highest frequency of axis x").smallest->relative ==
          relative(std::hypot(std::hypot(0.05, 0.05), 0.04), kSampleRounding));
    CHECK(range_of(answer, "hall height").largest->relative == relative(std::hypot(0.05 / 6.0, 0.01), kSampleRounding));
    CHECK(range_of(answer, "smallest edge").smallest->relative == relative(0.02, kSampleRounding));
    CHECK_FALSE(range_of(answer, "hall height").smallest.has_value());  // the end of the search
    // the feasible range has the ends of the limits that bind by the values
    const FeasibleRange& feasible = answer.candidates.front().ranges.front();
    CHECK(feasible.binds_above == "payload of axis x");
    CHECK(answer.uncertain.front().ranges.front().largest->relative == range_of(answer, "payload of axis x").largest->relative);
    CHECK(answer.uncertain.front().ranges.front().smallest->value == feasible.scales.smallest);
}

TEST_CASE("an end that is no power has the slope of its limit") {
    // force: U G a (M_0 + R L³ M) ≤ F, hence L³ = (F/(U G a) − M_0)/(R M); with s = F/(U G a)/(F/(U G a) − M_0) the exponents are s/3 of F
    const Answer answer = find_answer("");
    const double over_acceleration = 80e3 / (0.63 / 0.59 * 0.511 * 9.80665);
    const double s = over_acceleration / (over_acceleration - 3e3);
    const double expected = std::hypot(s * std::hypot(0.1, std::hypot(0.05, 0.05)), std::hypot(0.03, 0.02)) / 3.0;
    const FirstOrder& end = *range_of(answer, "force of axis x").largest;
    CHECK(end.value == relative(std::cbrt((over_acceleration - 3e3) / (800.0 / 2320.0 * 2.7e8)), 1e-12));
    CHECK(end.relative == relative(expected, 1e-5));  // central differences: h² = 1e-6 of slopes near 1
}

TEST_CASE("groups, factors and shares of a model have uncertainties at the given length") {
    const Answer answer = find_answer(R"(, "length": "1/60")");
    CHECK(group_of(answer, "mu^N").relative == 0.0);
    CHECK(group_of(answer, "omega/p").relative == relative(0.5 * std::hypot(0.05, 0.05), kSampleRounding));
    CHECK(group_of(answer, "mu/tan(alpha)").relative == relative(std::hypot(0.05, 0.05), kSampleRounding));
    // κ_n = E/(ρ g l): the model's density and the prototype's modulus
    CHECK(group_of(answer, "kappa_n").relative == relative(std::hypot(0.04, 0.03), kSampleRounding));
    const UncertainState& state = *answer.uncertain.front().chosen;
    CHECK(state.groups.size() == answer.candidates.front().chosen->groups.size());
    CHECK(state.used.size() == answer.candidates.front().chosen->uses.size());
    CHECK(state.mass.relative == relative(std::hypot(0.03, 0.02), kSampleRounding));
    CHECK(state.mass.value == answer.candidates.front().chosen->mass.value());
    CHECK_FALSE(state.cost.has_value());
    for (std::size_t i = 0; i < state.scales.size(); ++i) {
        CAPTURE(scaling::kModelScales[i].name);
        CHECK(state.scales[i].value == answer.candidates.front().chosen->scales.*scaling::kModelScales[i].factor);
        if (scaling::kModelScales[i].name == "time") {
            CHECK(state.scales[i].relative == relative(0.5 * std::hypot(0.05, 0.05), kSampleRounding));
        }
    }
}

TEST_CASE("uncertain factors and gravity of laws are inputs, too") {
    const Answer answer = find_answer(
        R"-(, "length": "1/60", "laws": [{"law": "gravity_distorted", "set": {"a": "1.5 +/- 3%"}}], "gravity": "(2+/-1%)/(1+/-2%)")-");
    // λ_t = √(λ_l/λ_a) at a length that is certain
    CHECK(answer.uncertain.front().chosen->scales[2].relative == relative(0.5 * 0.03, kSampleRounding));
    CHECK(group_of(answer, "a/g").relative == relative(std::hypot(0.03, std::hypot(0.01, 0.02)), kSampleRounding));
}

TEST_CASE("where an uncertainty makes no sense one line says so") {
    scaling::UncertainReading reading("d.json");
    const auto refusal = [&](const std::string& more) { return message_of<records::ReadError>([&] { read_setting(more, reading); }); };
    CHECK(refusal(R"(, "length": "1/107 +/- 1%")") ==
          "d.json: length is \"1/107 +/- 1%\" (+/- makes no sense here: it is chosen); give the value alone");
    CHECK(refusal(R"(, "limits": {"camera": {"rate": "4800 Hz", "pictures": "1000+/-1%"}})") ==
          "d.json: limits: camera: pictures is \"1000+/-1%\" (+/- makes no sense here: they are chosen); give the value alone");
    CHECK(refusal(R"(, "limits": {"hall_height": "6 m +/- -5 cm"})")
              .find("d.json: limits: hall_height: \"6 m +/- -5 cm\": the uncertainty is") == 0);
    // without a reading values alone are taken
    CHECK(message_of<records::ReadError>([] { records::parse_shake_table(kTable, "t.json"); }) ==
          "t.json: axes 1: velocity is \"25 cm/s +/- 4%\" (+/- makes no sense here: values alone are used); give the value alone");
    // a law that admits one value of the friction factor alone
    CHECK(message_of<scaling::SimilitudeError>([] {
              find_answer(R"(, "laws": ["exact"])", R"({"name": "copy", "density": "2320 kg/m^3", "friction": "0.59 +/- 5%"})");
          }).find("copy by law exact: prototype: friction is uncertain, and the law admits its value alone (") == 0);
}

TEST_CASE("samples of an end have the distribution of its closed form, and its limit binds") {
    const scaling::MonteCarloSettings settings{.samples = 1'000, .seed = 3, .distribution = scaling::Distribution::lognormal};
    const SampledAnswer answer = draw_answer(R"(, "limits": {"hall_height": "6 m +/- 5 cm"})", kWood, settings);
    // payload: L = (m/(ρ/ρ_prototype M))^(1/3), the logarithm of which is normal
    const double variance = (std::log1p(0.06 * 0.06) + std::log1p(0.03 * 0.03) + std::log1p(0.02 * 0.02)) / 9.0;
    const double drift = (-std::log1p(0.06 * 0.06) + std::log1p(0.03 * 0.03) + std::log1p(0.02 * 0.02)) / 6.0;
    const double median = std::cbrt(500.0 / (800.0 / 2320.0 * 2.7e8)) * std::exp(drift);
    const double sigma = std::sqrt(variance), root = std::sqrt(static_cast<double>(settings.samples));
    // standard errors of quantiles p: √(p (1 − p)/N) over the density there, four of them
    CHECK(std::abs(std::log(answer.sampled.largest.median / median)) < 4.0 * sigma * std::sqrt(0.5 * std::numbers::pi) / root);
    CHECK(std::abs(std::log(answer.sampled.largest.upper / median) - 1.959964 * sigma) <
          4.0 * sigma * std::sqrt(0.025 * 0.975) / (0.05845 * root));
    CHECK(answer.sampled.feasible == 1.0);  // the other end is 5.8 standard deviations below
    CHECK(answer.sampled.largest.given == settings.samples);
    CHECK(answer.limit("payload of axis x").sets_largest == 1.0);
    CHECK(answer.limit("hall height").sets_largest == 0.0);
    CHECK(answer.limit("highest frequency of axis x").sets_smallest == 1.0);
}

TEST_CASE("the share of feasible samples is that of two limits which do not cross") {
    const scaling::MonteCarloSettings settings{.samples = 1'000, .seed = 8, .distribution = scaling::Distribution::lognormal};
    // the edge asks for L ≥ s/b, by the values more than the payload leaves
    const std::string material =
        R"({"name": "wood", "density": "800 +/- 3% kg/m^3", "friction": "0.63+/-5%", "modulus": "3.56e9 Pa", "smallest_edge": "24.5 mm +/- 2%"})";
    const SampledAnswer answer = draw_answer("", material, settings);
    const double sigma =
        std::sqrt((std::log1p(0.06 * 0.06) + std::log1p(0.03 * 0.03) + std::log1p(0.02 * 0.02)) / 9.0 + std::log1p(0.02 * 0.02));
    const double drift = (-std::log1p(0.06 * 0.06) + std::log1p(0.03 * 0.03) + std::log1p(0.02 * 0.02)) / 6.0;
    const double payload = std::log(std::cbrt(500.0 / (800.0 / 2320.0 * 2.7e8))) + drift;
    const double edge = std::log(24.5e-3 / 1.36) - 0.5 * std::log1p(0.02 * 0.02);
    const double expected = normal_probability((payload - edge) / sigma);
    CHECK_FALSE(answer.candidate.is_feasible());
    CHECK(expected > 0.1);
    CHECK(std::abs(answer.sampled.feasible - expected) < share_error(expected, settings.samples));
    CHECK(static_cast<double>(answer.sampled.smallest.given) ==
          relative(answer.sampled.feasible * static_cast<double>(settings.samples), 1e-12));
    CHECK(answer.limit("smallest edge").sets_smallest == answer.sampled.feasible);
    CHECK_FALSE(answer.limit("smallest edge").broken.has_value());  // no length is given
}

TEST_CASE("the share in which a limit is broken at the length given is that of the normal distribution, the same bits for any threads") {
    scaling::MonteCarloSettings settings{.samples = 1'000, .seed = 21, .threads = 1};
    const std::string more = R"(, "limits": {"hall_height": "6 m +/- 5 cm"}, "length": "1/27")";
    const SampledAnswer answer = draw_answer(more, kWood, settings);
    // h − l/27 is normal: 6 m − 161.5 m/27, with 5 cm and 1 % of the latter
    const double expected = normal_probability((161.5 / 27.0 - 6.0) / std::hypot(0.05, 1.615 / 27.0));
    CHECK(std::abs(*answer.limit("hall height").broken - expected) < share_error(expected, settings.samples));
    CHECK(answer.limit("payload of axis x").broken == 1.0);
    settings.threads = 3;
    const SampledAnswer again = draw_answer(more, kWood, settings);
    CHECK(again.sampled.largest.upper == answer.sampled.largest.upper);
    CHECK(again.limit("hall height").broken == answer.limit("hall height").broken);
}

}  // namespace musim::records
