#include "cli/scaling/uncertainty_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

/// A quantity's key in JSON and the unit it is reported in there.
struct MeasureKey {
    std::string_view name;
    std::string_view key;
    std::string_view unit_name;  ///< empty: SI
    double unit = 1.0;           ///< in SI
};

const MeasureKey& find_key(const std::string& name) {
    static const MeasureKey kKeys[] = {{"pga", "pga_g", "g", scaling::kStandardGravity.value()},
                                       {"pgv", "pgv_cm_s", "cm/s", 0.01},
                                       {"pgd", "pgd_cm", "cm", 0.01},
                                       {"arias", "arias_m_s", "m/s"},
                                       {"duration", "duration_s", "s"},
                                       {"time_step", "dt_s", "s"},
                                       {"height", "height_m", "m"}};
    static const MeasureKey kNone{};
    const auto found = std::find_if(std::begin(kKeys), std::end(kKeys), [&](const MeasureKey& entry) { return entry.name == name; });
    return found == std::end(kKeys) ? kNone : *found;
}

std::string key_of(const scaling::UncertainPair& pair) {
    const MeasureKey& known = find_key(pair.name);
    return known.key.empty() ? pair.name : std::string(known.key);
}

/// Adds a result to a line of a table: its name under a title, value, u, u/value, and what the samples say.
void add_result(NamedValues& line, const std::string& title, const std::string& name, const scaling::UncertainResult& result,
                const scaling::RationalDimension& dimension) {
    const bool certain = result.first_order.relative == 0.0;
    const double value = result.first_order.value;
    const auto in_its_unit = [&](double other, int digits) { return scaling::format_si_like(other, value, dimension, digits); };
    const auto add = [&](const std::string& column, const std::string& text) { line.push_back({{}, column, text}); };
    add(title, name);
    add("value", in_its_unit(value, 7));
    add("u", certain ? "-" : format_uncertainty(result.first_order.uncertainty(), value, dimension));
    add("u/value", format_share(result.first_order.relative));
    if (!result.samples) return;
    const scaling::SampleSummary& samples = *result.samples;
    add("mean", certain ? "-" : in_its_unit(samples.mean, 5));
    add("sd", certain ? "-" : format_uncertainty(samples.standard_deviation, value, dimension));
    add("median", certain ? "-" : in_its_unit(samples.median, 5));
    add(coverage_title() + " interval",
        certain ? "-" : fmt::format("{} to {}", in_its_unit(samples.lower, 4), in_its_unit(samples.upper, 4)));
}

}  // namespace

std::string format_share(double share) { return share == 0.0 ? "-" : fmt::format("{:.3g} %", 100.0 * share); }

std::string format_uncertainty(double uncertainty, double value, const scaling::RationalDimension& dimension) {
    int digits = 2;
    std::string text = scaling::format_si_like(uncertainty, value, dimension, digits);
    while (text.find("e+") != std::string::npos) text = scaling::format_si_like(uncertainty, value, dimension, ++digits);
    return text;
}

nlohmann::json to_json(const scaling::SampleSummary& samples, double unit) {
    return {{"mean", samples.mean / unit},
            {"standard_deviation", samples.standard_deviation / unit},
            {"median", samples.median / unit},
            {"interval", {samples.lower / unit, samples.upper / unit}}};
}

nlohmann::json to_json(const scaling::UncertainResult& result, double unit) {
    nlohmann::json object{{"value", result.first_order.value / unit},
                          {"standard_uncertainty", result.first_order.uncertainty() / unit},
                          {"relative", result.first_order.relative}};
    if (result.samples) object["monte_carlo"] = to_json(*result.samples, unit);
    return object;
}

nlohmann::json to_json(const scaling::FirstOrder& result, const std::vector<scaling::UncertainInput>& inputs,
                       const scaling::SampleSummary* samples) {
    const scaling::CoverageInterval interval = scaling::find_interval(result);
    nlohmann::json exponents = nlohmann::json::object();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (result.exponents[i] != 0.0) exponents[inputs[i].name] = result.exponents[i];
    }
    nlohmann::json object{{"value", result.value},
                          {"standard_uncertainty", result.uncertainty()},
                          {"relative", result.relative},
                          {"interval", {interval.lower, interval.upper}},
                          {"exponents", exponents}};
    if (samples != nullptr) object["monte_carlo"] = to_json(*samples, 1.0);
    return object;
}

std::string describe_interval(const scaling::FirstOrder& result, const scaling::SampleSummary* samples) {
    if (result.relative == 0.0) return "-";
    if (samples != nullptr) return fmt::format("{:.4g} to {:.4g}", samples->lower, samples->upper);
    const scaling::CoverageInterval interval = scaling::find_interval(result);
    return fmt::format("{:.4g} to {:.4g}", interval.lower, interval.upper);
}

std::string coverage_title() { return fmt::format("{:g} %", 100.0 * scaling::kCoverage); }

std::string describe_main_input(const scaling::FirstOrder& result, const std::vector<scaling::UncertainInput>& inputs) {
    if (result.relative == 0.0) return "-";
    std::size_t main = 0;
    const auto share = [&](std::size_t i) { return std::abs(result.exponents[i] * inputs[i].quantity.relative()) / result.relative; };
    for (std::size_t i = 1; i < inputs.size(); ++i) {
        if (share(i) > share(main)) main = i;
    }
    return fmt::format("{} ({:.3g} %)", inputs[main].name, 100.0 * share(main) * share(main));
}

nlohmann::json to_json(const std::vector<scaling::UncertainResult>& results, const std::vector<scaling::UncertainInput>& inputs) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::UncertainResult& result : results) {
        nlohmann::json entry = to_json(result, 1.0);
        entry["exponents"] = nlohmann::json::object();
        for (std::size_t i = 0; i < inputs.size(); ++i) entry["exponents"][inputs[i].name] = result.first_order.exponents[i];
        object[result.name] = entry;
    }
    return object;
}

nlohmann::json to_json(const std::vector<scaling::UncertainInput>& inputs) {
    nlohmann::json list = nlohmann::json::array();
    for (const scaling::UncertainInput& input : inputs) {
        const MeasureKey& given = find_key(input.name);
        list.push_back({{"name", input.name},
                        {"unit", given.unit_name.empty() ? scaling::si_unit(input.dimension) : std::string(given.unit_name)},
                        {"value", input.quantity.value / given.unit},
                        {"standard_uncertainty", input.quantity.uncertainty / given.unit},
                        {"relative", input.quantity.relative()}});
    }
    return list;
}

nlohmann::json to_json(const scaling::Draws& draws) {
    return {{"samples", draws.settings.samples},
            {"seed", draws.settings.seed},
            {"distribution", scaling::to_string(draws.settings.distribution)},
            {"coverage", scaling::kCoverage},
            {"rejected_draws", draws.rejected}};
}

nlohmann::json to_json(const scaling::UncertainReport& report) {
    nlohmann::json object{{"inputs", to_json(report.inputs)},
                          {"factors", to_json(report.factors, report.inputs)},
                          {"groups", to_json(report.groups, report.inputs)},
                          {"groups_as_shaken", to_json(report.shaken, report.inputs)}};
    if (report.draws) object["monte_carlo"] = to_json(*report.draws);
    return object;
}

nlohmann::json values_to_json(const std::vector<scaling::UncertainPair>& pairs) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::UncertainPair& pair : pairs) {
        const double unit = find_key(pair.name).unit;
        object[key_of(pair)] = {{"prototype", pair.prototype.first_order.value / unit}, {"model", pair.model.first_order.value / unit}};
    }
    return object;
}

nlohmann::json to_json(const std::vector<scaling::UncertainPair>& pairs) {
    nlohmann::json object = nlohmann::json::object();
    for (const scaling::UncertainPair& pair : pairs) {
        const double unit = find_key(pair.name).unit;
        nlohmann::json both{{"prototype", to_json(pair.prototype, unit)}, {"model", to_json(pair.model, unit)}};
        if (pair.dimension.is_dimensionless() && pair.prototype.samples) {
            both["prototype"]["monte_carlo"]["share_above_1"] = pair.prototype.samples->share_above_one;
            both["model"]["monte_carlo"]["share_above_1"] = pair.model.samples->share_above_one;
        }
        object[key_of(pair)] = both;
    }
    return object;
}

scaling::TextTable make_inputs_table(const std::vector<scaling::UncertainInput>& inputs) {
    scaling::TextTable table{.header = {"uncertain input", "value", "u", "u/value"}};
    for (const scaling::UncertainInput& input : inputs) {
        const auto& [value, uncertainty] = input.quantity;
        table.rows.push_back({input.name, scaling::format_si_like(value, value, input.dimension, 7),
                              format_uncertainty(uncertainty, value, input.dimension), format_share(input.quantity.relative())});
    }
    return table;
}

scaling::TextTable make_results_table(const std::string& title, const std::vector<scaling::UncertainResult>& results) {
    std::vector<NamedValues> lines;
    for (const scaling::UncertainResult& result : results) add_result(lines.emplace_back(), title, result.name, result, {});
    return to_table(lines);
}

scaling::TextTable make_pairs_table(const std::string& title, const std::vector<UncertainPairRow>& rows) {
    const bool tells_share = !rows.empty() && rows.front().pair->model.samples && rows.front().pair->dimension.is_dimensionless();
    std::vector<NamedValues> lines;
    for (const UncertainPairRow& row : rows) {
        for (const bool is_model : {false, true}) {
            const scaling::UncertainResult& result = is_model ? row.pair->model : row.pair->prototype;
            NamedValues& line = lines.emplace_back(row.first);
            add_result(line, title, fmt::format("{}, {}", row.pair->name, is_model ? "model" : "prototype"), result, row.pair->dimension);
            if (tells_share) line.push_back({{}, "above 1", fmt::format("{:.3g} %", 100.0 * result.samples->share_above_one)});
        }
    }
    return to_table(lines);
}

scaling::TextTable make_pairs_table(const std::string& title, const std::vector<scaling::UncertainPair>& pairs) {
    std::vector<UncertainPairRow> rows;
    rows.reserve(pairs.size());
    for (const scaling::UncertainPair& pair : pairs) rows.push_back({{}, &pair});
    return make_pairs_table(title, rows);
}

std::string describe_draws(const scaling::Draws& draws) {
    const scaling::MonteCarloSettings& settings = draws.settings;
    std::string text = fmt::format("{} samples, {}, seed {}.", settings.samples, to_string(settings.distribution), settings.seed);
    if (draws.rejected > 0) text += fmt::format(" {} draws were not positive and drawn again.", draws.rejected);
    return text;
}

}  // namespace musim::cli
