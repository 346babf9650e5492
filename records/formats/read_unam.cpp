#include <fmt/format.h>

#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

constexpr std::string_view kOrientation = "ORIENTACION C1-C6 (rumbo;orientacion)";
constexpr std::string_view kInterval = "INTERVALO DE MUESTREO, C1-C6 (s)";
constexpr std::string_view kUnamCount = "NUM. TOTAL DE MUESTRAS, C1-C6";
constexpr std::string_view kUnamPeaks = "ACEL. MAX.(Gal), C1-C6";
constexpr std::string_view kFirstSample = "HORA DE LA PRIMERA MUESTRA (GMT)";

// the samples stand below the second rule after "DATOS DE ACELERACION:"
std::size_t find_samples(const TextFile& file) {
    std::size_t index = 0;
    while (index < file.size() && !file.line(index).starts_with("DATOS DE ACELERACION")) ++index;
    std::size_t rules = 0;
    while (index < file.size() && rules < 2) rules += file.line(index++).starts_with("---------+") ? 1U : 0U;
    if (rules < 2) file.fail("no samples (no 'DATOS DE ACELERACION' with its column titles)", "fetch the record again");
    return index;
}

// "/0.47/-1.19/1.22" → one text a channel
std::vector<std::string_view> read_channels(const TextFile& file, const HeaderField& field, std::string_view name, std::size_t channels) {
    std::vector<std::string_view> texts;
    std::string_view rest = field.text;
    for (std::string_view text = take_token(rest, "/"); !text.empty(); text = take_token(rest, "/")) texts.push_back(trim(text));
    if (texts.size() != channels) {
        file.fail(field.line,
                  fmt::format("{} names {} channels ({} needed; more than six are not supported)", name, texts.size(), channels),
                  "split or correct the file");
    }
    return texts;
}

// the value that all channels share
std::string_view read_common(const TextFile& file, const HeaderField& field, std::string_view name, std::size_t channels) {
    const std::vector<std::string_view> texts = read_channels(file, field, name, channels);
    for (const std::string_view text : texts) {
        if (text != texts.front()) file.fail(field.line, fmt::format("{} differs between channels", name), "split the file");
    }
    return texts.front();
}

// the header dates the earthquake but not the first sample: the day that brings both within twelve hours
std::optional<UtcTime> find_first_sample(const TextFile& file, const HeaderFields& header) {
    const std::optional<HeaderField> clock = header.find(kFirstSample);
    const std::string_view date = header.text("FECHA DEL SISMO [GMT]");
    const std::optional<UtcTime> origin = parse_date_time(fmt::format("{} {}", date, header.text("HORA EPICENTRO (GMT)")));
    if (!clock || !origin) return std::nullopt;
    std::optional<UtcTime> first = parse_date_time(fmt::format("{} {}", date, clock->text));
    if (!first) file.fail(clock->line, fmt::format("{} is {} (no time)", kFirstSample, quoted(clock->text)), "correct the header");
    if (*first - *origin > std::chrono::hours(12)) *first -= std::chrono::days(1);
    if (*first - *origin < -std::chrono::hours(12)) *first += std::chrono::days(1);
    return first;
}

// some files hold a few rows more than announced, all repeating the last one; true when they were dropped
bool drop_repeated_rows(NumberTable& table, std::size_t count) {
    if (count == 0 || table.rows() <= count) return false;
    for (const std::vector<double>& column : table.columns) {
        for (std::size_t row = count; row < table.rows(); ++row) {
            if (column[row] != column[count - 1]) return false;
        }
    }
    for (std::vector<double>& column : table.columns) column.resize(count);
    table.lines.resize(count);
    return true;
}

std::size_t read_number_of_samples(const TextFile& file, const HeaderFields& header, std::size_t channels) {
    const HeaderField field = header.require(kUnamCount);
    const std::string_view text = read_common(file, field, kUnamCount, channels);
    const std::optional<std::size_t> count = parse_count(text);
    if (!count || *count == 0) {
        file.fail(field.line, fmt::format("{} is {} (must be a positive integer)", kUnamCount, quoted(text)), "correct the header");
    }
    return *count;
}

scaling::Time read_time_step(const TextFile& file, const HeaderFields& header, std::size_t channels) {
    const HeaderField field = header.require(kInterval);
    const std::string_view text = read_common(file, field, kInterval, channels);
    const std::optional<double> step = parse_real(text);
    if (!step) file.fail(field.line, fmt::format("{} is {} (no number)", kInterval, quoted(text)), "correct the header");
    return checked_dt(file, field.line, *step);
}

}  // namespace

GroundMotion parse_unam(const TextFile& file, const ReadOptions& options) {
    const std::size_t samples_line = find_samples(file);
    const HeaderFields header(file, samples_line);
    const std::size_t channels = header.require_count("NUMERO DE CANALES");
    const std::vector<std::string_view> names = read_channels(file, header.require(kOrientation), kOrientation, channels);
    const SampleUnit unit = header.require_acceleration("UNIDADES DE LOS DATOS");
    const scaling::Time dt = read_time_step(file, header, channels);
    refuse_contradictions(file, options, unit, dt);

    const std::size_t count = read_number_of_samples(file, header, channels);
    NumberTable table = read_table(file, samples_line, std::vector<double>(channels, unit.si));
    const std::size_t rows = table.rows();
    const bool is_shortened = drop_repeated_rows(table, count);
    check_rows(file, table, {count, std::string(kUnamCount)});

    GroundMotion motion{.source = file.path().string(), .format = "UNAM"};
    const HeaderField peaks = header.require(kUnamPeaks);
    const std::vector<std::string_view> printed = read_channels(file, peaks, kUnamPeaks, channels);
    for (std::size_t i = 0; i < channels; ++i) {
        std::vector<double>& samples = table.columns[i];
        check_stated_peak(file, peaks.line, fmt::format("peak of channel {}", names[i]), printed[i], signed_peak(samples) / unit.si);
        motion.components.push_back({.name = std::string(names[i]),
                                     .azimuth_deg = parse_bearing(names[i]),
                                     .series = {unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)}});
    }
    motion.event = fmt::format("{} {} GMT", header.text("FECHA DEL SISMO [GMT]"), header.text("HORA EPICENTRO (GMT)"));
    motion.station = fmt::format("{}, {}", header.text("CLAVE DE LA ESTACION"), header.text("NOMBRE DE LA ESTACION"));
    motion.time_zero = find_first_sample(file, header);
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, unit {}{}", motion.format, file.path().filename().string(), unit.name,
                                         is_shortened ? fmt::format(", last row repeated {} times left out", rows - count) : ""));
    return motion;
}

}  // namespace musim::records::detail
