#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/direction.hpp"
#include "records/headers/header_checks.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

/// A labelled line of the header; institutes write labels with different blanks, commas and brackets.
struct AsaField {
    std::size_t line = 0;
    std::string_view label = {};
    std::string_view text = {};
};

// letters and digits alone, in capitals: "ACEL. MAX.(Gal), C1-C6" → "ACELMAXGALC1C6"
std::string plain_label(std::string_view label) {
    std::string plain;
    for (const char letter : label) {
        const char lower = to_lower(letter);
        if (is_digit(letter)) plain += letter;
        if (lower >= 'a' && lower <= 'z') plain += static_cast<char>(lower - 'a' + 'A');
    }
    return plain;
}

/// The header of one file: the lines before `end`.
struct AsaHeader {
    const TextFile& file;
    std::size_t end;

    /// The first field of this plain label; nothing when absent or empty.
    std::optional<AsaField> find(std::string_view plain) const {
        for (std::size_t index = 0; index < end; ++index) {
            const std::string_view line = file.line(index);
            const std::size_t colon = line.find(':');
            if (colon == std::string_view::npos || plain_label(line.substr(0, colon)) != plain) continue;
            const std::string_view text = trim(line.substr(colon + 1));
            if (text.empty()) return std::nullopt;
            return AsaField{index, trim(line.substr(0, colon)), text};
        }
        return std::nullopt;
    }
    std::string_view text(std::string_view plain) const { return find(plain).value_or(AsaField{}).text; }
    /// The same for a field that must be there; `label` is as the format's description spells it.
    AsaField require(std::string_view label) const {
        if (const std::optional<AsaField> field = find(plain_label(label))) return *field;
        file.fail(fmt::format("header has no '{}' (missing or empty)", label), "fetch the record again");
    }
};

// the samples stand below the second rule after "DATOS DE ACELERACION:"
std::size_t find_asa_samples(const TextFile& file) {
    std::size_t index = 0;
    while (index < file.size() && !file.line(index).starts_with("DATOS DE ACELERACION")) ++index;
    std::size_t rules = 0;
    while (index < file.size() && rules < 2) rules += file.line(index++).starts_with("---------+") ? 1U : 0U;
    if (rules < 2) file.fail("no samples (no 'DATOS DE ACELERACION' with its column titles)", "fetch the record again");
    return index;
}

/// One text a channel, of a field for the first six channels and one for the next six.
struct ChannelTexts {
    AsaField field;
    std::vector<std::string_view> texts;
};

// "/0.47/-1.19/1.22" → one text a channel
ChannelTexts read_asa_channels(const AsaHeader& header, std::string_view name, std::string_view unit, std::size_t channels) {
    constexpr std::size_t kChannelsOfField = 6;
    ChannelTexts found{header.require(fmt::format("{}, C1-C6{}", name, unit)), {}};
    const auto append = [&](std::string_view text) {
        for (std::string_view one = take_token(text, "/"); !one.empty(); one = take_token(text, "/")) found.texts.push_back(trim(one));
    };
    append(found.field.text);
    if (channels > kChannelsOfField) append(header.text(plain_label(fmt::format("{}, C7-C12{}", name, unit))));
    if (found.texts.size() != channels) {
        header.file.fail(found.field.line, fmt::format("{} names {} channels ({} needed)", found.field.label, found.texts.size(), channels),
                         "split or correct the file");
    }
    return found;
}

// the value that all channels share
AsaField read_common(const AsaHeader& header, std::string_view name, std::string_view unit, std::size_t channels) {
    const ChannelTexts found = read_asa_channels(header, name, unit, channels);
    for (const std::string_view text : found.texts) {
        if (text != found.texts.front())
            header.file.fail(found.field.line, fmt::format("{} differs between channels", found.field.label), "split the file");
    }
    return {found.field.line, found.field.label, found.texts.front()};
}

// "04 de ABRIL del 2010" → "2010/4/04"; dates of numbers as they are
std::string numeric_date(std::string_view text) {
    constexpr std::array<std::string_view, 12> kMonths{"ENE", "FEB", "MAR", "ABR", "MAY", "JUN", "JUL", "AGO", "SEP", "OCT", "NOV", "DIC"};
    std::string_view day;
    std::size_t month = 0;
    std::string_view rest = text;
    for (std::string_view word = take_token(rest, " \t,/-"); !word.empty(); word = take_token(rest, " \t,/-")) {
        if (is_digit(word.front()) && month > 0) return fmt::format("{}/{}/{}", word, month, day);
        if (is_digit(word.front())) day = word;
        for (std::size_t i = 0; i < kMonths.size(); ++i)
            if (!day.empty() && find_ignoring_case(word, kMonths.at(i)) == 0) month = i + 1;
    }
    return std::string(text);
}

// the header dates the earthquake but not the first sample: the day that brings both within twelve hours
std::optional<UtcTime> find_first_sample(const AsaHeader& header) {
    const std::optional<AsaField> clock = header.find("HORADELAPRIMERAMUESTRAGMT");
    const std::string date = numeric_date(header.text("FECHADELSISMOGMT"));
    const std::optional<UtcTime> origin = parse_date_time(fmt::format("{} {}", date, header.text("HORAEPICENTROGMT")));
    if (!clock || !origin) return std::nullopt;
    std::optional<UtcTime> first = parse_date_time(fmt::format("{} {}", date, clock->text));
    if (!first) header.file.fail(clock->line, fmt::format("{} is {} (no time)", clock->label, quoted(clock->text)), "correct the header");
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

std::size_t positive_count(const TextFile& file, const AsaField& field) {
    const std::optional<std::size_t> count = parse_count(field.text);
    if (count && *count > 0) return *count;
    file.fail(field.line, fmt::format("{} is {} (must be a positive integer)", field.label, quoted(field.text)), "correct the header");
}

scaling::Time read_asa_time_step(const AsaHeader& header, std::size_t channels) {
    const AsaField field = read_common(header, "INTERVALO DE MUESTREO", " (s)", channels);
    const std::optional<double> step = parse_real(field.text);
    if (!step) header.file.fail(field.line, fmt::format("{} is {} (no number)", field.label, quoted(field.text)), "correct the header");
    return checked_dt(header.file, field.line, *step);
}

// the first word of "Gal (cm/s/s)"
SampleUnit read_asa_unit(const AsaHeader& header) {
    const AsaField field = header.require("UNIDADES DE LOS DATOS");
    std::string_view rest = field.text;
    const std::optional<SampleUnit> unit = find_sample_unit(take_token(rest));
    if (unit && unit->quantity == SampleQuantity::acceleration) return *unit;
    header.file.fail(field.line, fmt::format("{} is {} (no unit of acceleration)", field.label, quoted(field.text)), "correct the header");
}

// "N90E;", "V;+" → "N90E", "V": bearing and positive direction, which stays in the name when it is the other one
std::string_view name_of_orientation(std::string_view text) {
    if (text.ends_with('+')) text.remove_suffix(1);
    if (text.ends_with(';')) text.remove_suffix(1);
    return trim(text);
}

}  // namespace

GroundMotion parse_asa(const TextFile& file, const ReadOptions& options) {
    const std::size_t samples_line = find_asa_samples(file);
    const AsaHeader header{file, samples_line};
    const std::size_t channels = positive_count(file, header.require("NUMERO DE CANALES"));
    const ChannelTexts orientations = read_asa_channels(header, "ORIENTACION", " (rumbo;orientacion)", channels);
    const SampleUnit unit = read_asa_unit(header);
    const scaling::Time dt = read_asa_time_step(header, channels);
    refuse_contradictions(file, options, unit, dt);

    const AsaField count_field = read_common(header, "NUM. TOTAL DE MUESTRAS", "", channels);
    const std::size_t count = positive_count(file, count_field);
    NumberTable table = read_table(file, samples_line, std::vector<double>(channels, unit.si));
    const std::size_t rows = table.rows();
    const bool is_shortened = drop_repeated_rows(table, count);
    check_rows(file, table, {count, std::string(count_field.label)});

    GroundMotion motion{.source = file.path().string(), .format = "ASA 2.0"};
    const ChannelTexts peaks = read_asa_channels(header, "ACEL. MAX. (Gal)", "", channels);
    for (std::size_t i = 0; i < channels; ++i) {
        const std::string_view name = name_of_orientation(orientations.texts[i]);
        std::vector<double>& samples = table.columns[i];
        const std::string_view largest = text_in_table(file, table, find_peak(samples), i);
        check_stated_peak(file, peaks.field.line, fmt::format("peak of channel {}", name), peaks.texts[i],
                          {signed_peak(samples) / unit.si, half_last_digit(largest)});
        motion.components.push_back({.name = std::string(name),
                                     .azimuth_deg = parse_bearing(name),
                                     .series = {unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)}});
    }
    motion.event = fmt::format("{} {} GMT", header.text("FECHADELSISMOGMT"), header.text("HORAEPICENTROGMT"));
    motion.station = fmt::format("{}, {}", header.text("CLAVEDELAESTACION"), header.text("NOMBREDELAESTACION"));
    motion.time_zero = find_first_sample(header);
    motion.integration_corner = kUncorrectedCornerHz * scaling::si::hertz;
    motion.history.push_back(fmt::format("read {} from {}, unit {}{}", motion.format, file.path().filename().string(), unit.name,
                                         is_shortened ? fmt::format(", last row repeated {} times left out", rows - count) : ""));
    return motion;
}

}  // namespace musim::records::detail
