#include "lsdem/study/trace_file.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/result_error.hpp"
#include "records/atomic_file.hpp"

namespace musim::lsdem {
namespace {

constexpr const char* kFormat = "musim-trace/1";

}  // namespace

void write_trace(const std::filesystem::path& file, const RunTrace& trace) {
    nlohmann::json quantities = nlohmann::json::array();
    for (const QuantityFamily& family : trace.quantities) {
        quantities.push_back(
            {{"key", family.key}, {"title", family.title}, {"unit", family.unit}, {"level", family.level}, {"value", family.value}});
    }
    const nlohmann::json object = {
        {"format", kFormat}, {"diverged", trace.diverged}, {"image", trace.image}, {"running", trace.running}, {"quantities", quantities}};
    records::write_file_atomically(file, make_checked_json(object));
}

std::optional<RunTrace> read_trace(const std::filesystem::path& file) {
    try {
        const nlohmann::json object = read_checked_json(file);
        if (object.at("format") != kFormat) return std::nullopt;
        RunTrace trace;
        trace.diverged = object.at("diverged").get<bool>();
        trace.image = object.at("image").get<bool>();
        trace.running = object.at("running").get<std::vector<double>>();
        for (const nlohmann::json& family : object.at("quantities")) {
            trace.quantities.push_back({family.at("key").get<std::string>(), family.at("title").get<std::string>(),
                                        family.at("unit").get<std::string>(), family.at("level").get<std::vector<int>>(),
                                        family.at("value").get<std::vector<double>>()});
        }
        return trace;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    } catch (const ResultError&) {
        return std::nullopt;
    }
}

}  // namespace musim::lsdem
