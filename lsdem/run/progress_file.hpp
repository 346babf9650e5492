#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/joined_progress.hpp"
#include "lsdem/run/simulate.hpp"

namespace musim::lsdem {

/// Where a run stands while it goes on, for whoever looks on.
struct RunProgress {
    double time = 0.0;                 ///< of the model, since the start of the run [s]
    double duration = 0.0;             ///< planned [s]
    std::size_t stage = 1;             ///< of a sequence, from 1
    double kinetic_energy = 0.0;       ///< now, of all blocks [J]
    double drift = 0.0;                ///< largest now, see find_drift [-]
    std::size_t blocks = 0;            ///< in all
    std::size_t fallen = 0;            ///< of them
    bool collapsed = false;            ///< kCollapsedFraction of them have
    int axis = 0;                      ///< along which the base has moved most: 0, 1, 2 for x, y, z
    std::vector<double> top_velocity;  ///< of the highest spine block along that axis, see thin_extremes [m/s]

    bool operator==(const RunProgress&) const = default;
};

/// Number of values of a history that are shown.
inline constexpr std::size_t kProgressPoints = 40;

/// The last sample of a run that goes on by this plan. A run without samples or spine has no drift and no velocity.
RunProgress observe_run(const RunResult& run, const TimePlan& plan);

/// Values of largest magnitude in `count` equal parts of a history, or all its values if it is shorter.
std::vector<double> thin_extremes(const std::vector<double>& history, std::size_t count);

nlohmann::json to_json(const RunProgress& progress);
/// Throws nlohmann::json::exception for anything else than to_json() makes.
RunProgress parse_progress_run(const nlohmann::json& json);

/// Report of a run that goes on, in its folder.
struct ProgressState {
    std::string name;            ///< of the scene
    bool prepares = false;       ///< its specimen is being prepared; nothing moves yet
    double fraction = 0.0;       ///< done of preparation and run together, 0 to 1
    double wall_time = 0.0;      ///< since it began, or was resumed [s]
    std::optional<double> left;  ///< wall time that both will still take if work goes on as up to now; at most, where it is a range [s]
    std::optional<double> least_left;  ///< likewise at least; nothing where it is no range [s]
    std::optional<RunProgress> run;    ///< at its last sample
};

/// {"schema", "name", "phase": "preparing" or "running", "fraction", "wall_s", "left_s", "least_left_s", "run"}; the last three only when
/// known. It is for watching alone: nothing that is computed depends on it, so it carries no checksum.
nlohmann::json to_json(const ProgressState& state);

/// The name of that file in a folder of results.
inline constexpr const char* kProgressName = "progress.json";

/// Wall time between two states: often enough to follow a run, and each waits for the disk.
inline constexpr std::chrono::seconds kProgressInterval{2};

/// Keeps a file in a folder of results by which others follow a run. It is written for the first time after an interval of wall time, whole
/// each time, and goes with the object; one that cannot be written is left out. A kill leaves the last one behind.
class ProgressFile {
  public:
    ProgressFile(const std::filesystem::path& directory, std::string name, std::chrono::seconds interval = kProgressInterval);
    ~ProgressFile();
    ProgressFile(const ProgressFile&) = delete;
    ProgressFile& operator=(const ProgressFile&) = delete;

    void report_preparation(double fraction) { report(true, fraction); }
    void report_progress(double fraction) { report(false, fraction); }
    void report_spare(double part) { spare_ = joined_.of_all(part); }
    void report_preparation_spare(double part) { spare_ = joined_.of_whole_part(part); }
    void report_sample(const RunResult& run, const TimePlan& plan);

    /// Follows what is observed from now on, besides who does already. Outlives it.
    void listen_to(RunObserver& observer);

  private:
    using Clock = std::chrono::steady_clock;

    void report(bool prepares, double fraction);
    bool is_due() const { return Clock::now() >= next_; }
    void write();

    std::filesystem::path file_;
    ProgressState state_;
    Clock::duration interval_;
    Clock::time_point start_ = Clock::now(), next_, observed_{};
    JoinedProgress joined_;
    std::optional<double> first_fraction_;
    Clock::time_point first_reported_;
    double spare_ = 0.0;
};

/// State that the file in a folder holds; nothing when there is none, or none that this program wrote.
std::optional<ProgressState> read_progress_file(const std::filesystem::path& directory);

}  // namespace musim::lsdem
