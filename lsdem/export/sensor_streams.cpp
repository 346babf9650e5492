#include "lsdem/export/sensor_streams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "lsdem/results/result_error.hpp"
#include "records/formats/write_record.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem {
namespace {

/// Instrument and orientation of each channel of a kind of sensor.
std::vector<const char*> find_codes(SensorKind kind) {
    switch (kind) {
        case SensorKind::acceleration:
            return {"N1", "N2", "N3"};
        case SensorKind::velocity:
            return {"H1", "H2", "H3"};
        case SensorKind::displacement:
            return {"Y1", "Y2", "Y3"};
        case SensorKind::rotation:
        case SensorKind::angular_velocity:
            return {"J1", "J2", "J3"};
        case SensorKind::joint:
            break;
    }
    return {"BZ", "B1", "B2", "EZ", "E1", "E2"};
}

/// Station code of a sensor, the `number`-th from 1, that is none of those taken.
std::string find_station(const std::string& name, std::size_t number, const std::vector<std::string>& taken) {
    std::string code;
    for (const char letter : name) {
        const auto byte = static_cast<unsigned char>(letter);
        if (byte < 0x80 && std::isalnum(byte) != 0 && code.size() < 5) code += static_cast<char>(std::toupper(byte));
    }
    const auto is_taken = [&] { return code.empty() || std::find(taken.begin(), taken.end(), code) != taken.end(); };
    for (; is_taken(); ++number) code = fmt::format("S{}", number);
    return code;
}

}  // namespace

std::size_t write_sensor_streams(const std::filesystem::path& file, const StoredRun& run, const std::optional<std::string>& name) {
    const std::string place = run.directory.string();
    if (run.sensors.empty())
        throw ResultError(fmt::format("{}: the run has no sensors; give its scene \"sensors\", and run it again", place));
    std::vector<records::SeedStream> streams;
    std::vector<std::string> stations, names;
    bool is_known = false;
    for (std::size_t s = 0; s < run.sensors.size(); ++s) {
        const SensorHistory& sensor = run.sensors[s];
        names.push_back(sensor.name);
        stations.push_back(find_station(sensor.name, s + 1, stations));
        if (name && *name != sensor.name) continue;
        is_known = true;
        if (sensor.values.empty()) continue;
        const std::vector<const char*> codes = find_codes(sensor.kind);
        for (std::size_t c = 0; c < codes.size(); ++c) {
            streams.push_back({stations.back(), codes[c], scaling::Time::from_value(sensor.interval), sensor.column(c)});
        }
    }
    if (!is_known) throw ResultError(fmt::format("{}: there is no sensor \"{}\"; {}", place, *name, scaling::suggest_name(*name, names)));
    if (streams.empty()) throw ResultError(fmt::format("{}: its sensors read nothing; see the warnings of the run", place));
    records::write_miniseed(file, streams);
    return streams.size();
}

}  // namespace musim::lsdem
