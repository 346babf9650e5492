#include "lsdem/run/progress_file.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "lsdem/results/drift.hpp"
#include "lsdem/results/spine_measures.hpp"
#include "lsdem/results/staged_files.hpp"
#include "records/atomic_file.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {
namespace {

constexpr const char* kProgressSchema = "musim-progress/1";

ProgressState parse_progress_state(const nlohmann::json& json) {
    ProgressState state;
    json.at("name").get_to(state.name);
    state.prepares = json.at("phase") == "preparing";
    json.at("fraction").get_to(state.fraction);
    json.at("wall_s").get_to(state.wall_time);
    if (json.contains("left_s")) state.left = json["left_s"].get<double>();
    if (json.contains("least_left_s")) state.least_left = json["least_left_s"].get<double>();
    if (json.contains("run")) state.run = parse_progress_run(json["run"]);
    return state;
}

template <class... Args, class Second>
std::function<void(Args...)> also(std::function<void(Args...)> first, Second second) {
    if (!first) return second;
    return [first = std::move(first), second](Args... args) {
        first(args...);
        second(args...);
    };
}

}  // namespace

std::vector<double> thin_extremes(const std::vector<double>& history, std::size_t count) {
    if (history.size() <= count) return history;
    std::vector<double> thinned;
    thinned.reserve(count);
    const auto at = [&](std::size_t part) { return history.begin() + static_cast<std::ptrdiff_t>(part * history.size() / count); };
    for (std::size_t part = 0; part < count; ++part) {
        thinned.push_back(*std::max_element(at(part), at(part + 1), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    }
    return thinned;
}

RunProgress observe_run(const RunResult& run, const TimePlan& plan) {
    const History& history = run.history;
    RunProgress progress;
    progress.duration = plan.duration();
    progress.stage = run.origin ? run.origin->stage + 1 : 1;
    progress.blocks = run.falls.time.size();
    progress.fallen =
        static_cast<std::size_t>(std::count_if(run.falls.time.begin(), run.falls.time.end(), [](double t) { return !std::isnan(t); }));
    progress.collapsed = run.collapse_time.has_value();
    if (history.samples() == 0) return progress;
    progress.time = history.time.back();
    progress.kinetic_energy = history.energy.back().kinetic;
    const std::size_t count = run.spine.size();
    if (count == 0) return progress;
    progress.axis = find_strongest_axis(history);
    progress.drift = find_drift(run, find_drift_pairs(run), history.samples() - 1).value;
    std::vector<double> top;
    top.reserve(history.samples());
    for (std::size_t k = 0; k < history.samples(); ++k) top.push_back(history.spine_velocity[k * count + count - 1][progress.axis]);
    progress.top_velocity = thin_extremes(top, kProgressPoints);
    return progress;
}

nlohmann::json to_json(const RunProgress& progress) {
    return {{"time_s", progress.time},         {"duration_s", progress.duration},
            {"stage", progress.stage},         {"kinetic_energy_J", progress.kinetic_energy},
            {"largest_drift", progress.drift}, {"blocks", progress.blocks},
            {"fallen", progress.fallen},       {"collapsed", progress.collapsed},
            {"axis", progress.axis},           {"top_velocity_m_s", progress.top_velocity}};
}

RunProgress parse_progress_run(const nlohmann::json& json) {
    RunProgress progress;
    json.at("time_s").get_to(progress.time);
    json.at("duration_s").get_to(progress.duration);
    json.at("stage").get_to(progress.stage);
    json.at("kinetic_energy_J").get_to(progress.kinetic_energy);
    json.at("largest_drift").get_to(progress.drift);
    json.at("blocks").get_to(progress.blocks);
    json.at("fallen").get_to(progress.fallen);
    json.at("collapsed").get_to(progress.collapsed);
    json.at("axis").get_to(progress.axis);
    json.at("top_velocity_m_s").get_to(progress.top_velocity);
    return progress;
}

nlohmann::json to_json(const ProgressState& state) {
    nlohmann::json json{{"schema", kProgressSchema},
                        {"name", state.name},
                        {"phase", state.prepares ? "preparing" : "running"},
                        {"fraction", state.fraction},
                        {"wall_s", state.wall_time}};
    if (state.left) json["left_s"] = *state.left;
    if (state.least_left) json["least_left_s"] = *state.least_left;
    if (state.run) json["run"] = to_json(*state.run);
    return json;
}

ProgressFile::ProgressFile(const std::filesystem::path& directory, std::string name, std::chrono::seconds interval)
    : file_(directory / kProgressName), interval_(interval), next_(start_ + interval) {
    state_.name = std::move(name);
}

void ProgressFile::listen_to(RunObserver& observer) {
    observer.on_preparation_spare = also(std::move(observer.on_preparation_spare), [this](double part) { report_preparation_spare(part); });
    observer.on_preparation = also(std::move(observer.on_preparation), [this](double fraction) { report_preparation(fraction); });
    observer.on_progress = also(std::move(observer.on_progress), [this](double fraction) { report_progress(fraction); });
    observer.on_sample =
        also(std::move(observer.on_sample), [this](const RunResult& run, const TimePlan& plan) { report_sample(run, plan); });
}

ProgressFile::~ProgressFile() { detail::remove_with_leftovers(file_); }

void ProgressFile::report(bool prepares, double fraction) {
    const Clock::time_point now = Clock::now();
    fraction = prepares ? joined_.after_preparing(fraction) : joined_.after_running(fraction);
    if (!first_fraction_) {
        first_fraction_ = fraction;
        first_reported_ = now;
    }
    state_.prepares = prepares;
    state_.fraction = fraction;
    const double done = fraction - *first_fraction_;
    const double taken = std::chrono::duration<double>(now - first_reported_).count();
    const auto time_to = [&](double end) {
        return done > 0.0 ? std::optional(taken * std::max(0.0, end - fraction) / done) : std::nullopt;
    };
    state_.left = time_to(1.0);
    state_.least_left = spare_ > 0.0 ? time_to(1.0 - spare_) : std::nullopt;
    if (is_due()) write();
}

void ProgressFile::report_sample(const RunResult& run, const TimePlan& plan) {
    // ahead of the time, since samples and progress come in turns
    const Clock::time_point now = Clock::now();
    if (now < next_ - interval_ / 2 || now < observed_ + interval_ / 20) return;
    state_.run = observe_run(run, plan);
    observed_ = now;
}

void ProgressFile::write() {
    state_.wall_time = std::chrono::duration<double>(Clock::now() - start_).count();
    try {
        records::write_file_atomically(file_, to_json(state_).dump(2) + "\n");
    } catch (const records::WriteError&) {
        // whoever looks on sees the state before; the run is not the worse for it
    }
    next_ = Clock::now() + interval_;
}

std::optional<ProgressState> read_progress_file(const std::filesystem::path& directory) {
    std::ifstream stream = scaling::open_regular_file(directory / kProgressName);
    try {
        const nlohmann::json json = nlohmann::json::parse(stream);
        if (json.at("schema") != kProgressSchema) return std::nullopt;
        return parse_progress_state(json);
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

}  // namespace musim::lsdem
