#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>

#include "records/atomic_file.hpp"
#include "records/detail/text.hpp"
#include "records/formats/write_record.hpp"
#include "records/headers/own_titles.hpp"

namespace musim::records {
namespace {

constexpr double kUnknown = -999.0;
constexpr std::size_t kHeaderValues = 100;

/// Name of a quantity in COSMOS, and the code of its unit.
struct CosmosUnit {
    std::string_view name;  ///< of the quantity
    std::string_view unit;
    int unit_code;
    double per_si;
};

constexpr std::array<CosmosUnit, 3> kUnits{
    {{"acceleration", "cm/sec2", 4, 100.0}, {"velocity", "cm/sec", 5, 100.0}, {"displacement", "cm", 6, 100.0}}};

const CosmosUnit& cosmos_unit(SampleQuantity quantity) { return kUnits.at(static_cast<std::size_t>(quantity)); }

/// The first sample's date and time of day.
struct Calendar {
    std::chrono::year_month_day date;
    int day_of_year;
    std::chrono::hh_mm_ss<std::chrono::microseconds> time;

    double seconds() const { return static_cast<double>(time.seconds().count()) + 1e-6 * static_cast<double>(time.subseconds().count()); }
};

std::optional<Calendar> first_sample(const GroundMotion& motion, const TimeSeries& series) {
    if (!motion.time_zero) return std::nullopt;
    const std::optional<UtcTime> instant = find_instant(*motion.time_zero, series.start());
    if (!instant) return std::nullopt;
    const auto day = std::chrono::floor<std::chrono::days>(*instant);
    const std::chrono::year_month_day date(day);
    const auto new_year = std::chrono::sys_days(date.year() / std::chrono::January / 1);
    return Calendar{date, static_cast<int>((day - new_year).count()) + 1, std::chrono::hh_mm_ss(*instant - day)};
}

// 15 letters with six decimals; unknown when they do not hold the number to four digits
std::string real_field(double value) {
    constexpr std::size_t kWidth = 15;
    std::string text = fmt::format("{:15.6f}", value);
    const bool is_held =
        text.size() == kWidth && text.front() == ' ' && std::abs(*detail::parse_real(detail::trim(text)) - value) <= 1e-4 * std::abs(value);
    return is_held ? text : fmt::format("{:15.6f}", kUnknown);
}

void require_time_step(const std::filesystem::path& path, const Component& component) {
    const double step = 1e3 * component.series.dt().value();  // [ms], as the header holds it
    const double held = std::round(1e6 * step) * 1e-6;
    constexpr double kLargest = 1e7;  // [ms]; the field has 15 letters
    if (step < kLargest && std::abs(held - step) * static_cast<double>(component.series.size()) <= 0.01 * step) return;
    throw WriteError(fmt::format("{}: time step {} s of '{}' cannot be held (COSMOS counts whole nanoseconds); write CSV or AT2",
                                 path.string(), component.series.dt().value(), component.name));
}

// direction of the sensor: whole degrees, 400 for up, unknown otherwise
int azimuth_code(const Component& component) {
    constexpr int kUp = 400;
    if (component.azimuth_deg && std::abs(*component.azimuth_deg) <= 360.0) return static_cast<int>(std::lround(*component.azimuth_deg));
    return detail::equal_ignoring_case(component.name, "up") ? kUp : static_cast<int>(kUnknown);
}

std::string direction_words(const Component& component) {
    if (const int azimuth = azimuth_code(component); component.azimuth_deg && azimuth >= 0) return fmt::format("{} deg", azimuth);
    return detail::printable(component.name);
}

std::string text_lines(const GroundMotion& motion, const Component& component, std::size_t ordinal) {
    const TimeSeries& series = component.series;
    const CosmosUnit& unit = cosmos_unit(series.quantity());
    const bool is_corrected = !motion.integration_corner;
    const auto station = detail::split_station(motion.station, "UNKN");
    const auto calendar = first_sample(motion, series);

    std::string text = fmt::format("{:<26}(Format v01.20 with 13 text lines)\n",
                                   fmt::format("{} {}", is_corrected ? "Corrected" : "Uncorrected", unit.name));
    text += detail::printable(motion.event) + "\nHypocenter: unknown\nOrigin: unknown\n";
    text += fmt::format("Statn No: -999 Code:{}-{}  musim {}\n", station.network, station.station, station.name);
    text += "Coords: unknown  Site geology: unknown\nRecorder: unknown  Sensor: unknown\n";
    text += "Rcrd start time: ";
    if (calendar) {
        text += fmt::format("{}/{:02}/{:02}, {:02}:{:02}:{:06.3f} UTC", static_cast<int>(calendar->date.year()),
                            static_cast<unsigned>(calendar->date.month()), static_cast<unsigned>(calendar->date.day()),
                            calendar->time.hours().count(), calendar->time.minutes().count(), calendar->seconds());
    } else {
        text += "unknown";
    }
    text += fmt::format("\nSta Chan {:3}: {} (Rcrdr Chan {:3})\n", ordinal, direction_words(component), ordinal);
    text += fmt::format("Raw record length = {:.3f} sec\nProcessed: musim\n{}\n", series.duration().value(),
                        is_corrected ? "Record filtered: see its source" : "Record not filtered.");
    return text + "Values used when parameter or data value is unknown/unspecified:   -999, -999.0\n";
}

std::string integer_header(const GroundMotion& motion, const Component& component, std::size_t ordinal) {
    const TimeSeries& series = component.series;
    std::array<int, kHeaderValues + 1> values{};  // counted from 1, as the format's description does
    values.fill(static_cast<int>(kUnknown));
    values[1] = motion.integration_corner ? 1 : 2;         // stage: V1 or V2
    values[2] = static_cast<int>(series.quantity()) + 1;   // physical parameter
    values[3] = cosmos_unit(series.quantity()).unit_code;  // unit
    values[4] = 120;                                       // format version times 100
    if (const auto calendar = first_sample(motion, series)) {
        values[40] = static_cast<int>(calendar->date.year());
        values[41] = calendar->day_of_year;
        values[42] = static_cast<int>(static_cast<unsigned>(calendar->date.month()));
        values[43] = static_cast<int>(static_cast<unsigned>(calendar->date.day()));
        values[44] = static_cast<int>(calendar->time.hours().count());
        values[45] = static_cast<int>(calendar->time.minutes().count());
    }
    values[50] = static_cast<int>(ordinal);  // station channel
    values[54] = azimuth_code(component);

    std::string text = fmt::format("{:4} Integer-header values follow on  10 lines, Format= (10I8)\n", kHeaderValues);
    for (std::size_t i = 1; i <= kHeaderValues; ++i) text += fmt::format("{:8}{}", values.at(i), i % 10 == 0 ? "\n" : "");
    return text;
}

std::string real_header(const GroundMotion& motion, const TimeSeries& series) {
    const double per_si = cosmos_unit(series.quantity()).per_si;
    const std::span<const double> samples = series.samples();
    const auto peak = std::max_element(samples.begin(), samples.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });

    std::array<double, kHeaderValues + 1> values{};  // counted from 1
    values.fill(kUnknown);
    if (const auto calendar = first_sample(motion, series)) values[30] = calendar->seconds();
    values[62] = 1e3 * series.dt().value();  // [ms]
    values[63] = static_cast<double>(series.size()) * series.dt().value();
    values[64] = *peak * per_si;
    values[65] = static_cast<double>(peak - samples.begin()) * series.dt().value();

    std::string text = fmt::format("{:4} Real-header values follow on  20 lines, Format= (5F15.6)\n", kHeaderValues);
    for (std::size_t i = 1; i <= kHeaderValues; ++i) text += real_field(values.at(i)) + (i % 5 == 0 ? "\n" : "");
    return text;
}

std::string data_block(const GroundMotion& motion, const TimeSeries& series, std::size_t ordinal) {
    const CosmosUnit& unit = cosmos_unit(series.quantity());
    const std::optional<scaling::Frequency>& corner = motion.integration_corner;
    std::string comments = "| Written by musim\n";
    if (corner) comments += fmt::format("| {}= {} HZ\n", detail::kCornerTitle, corner->value());
    if (series.start().value() != 0.0) comments += fmt::format("| {}= {} SEC\n", detail::kStartTitle, series.start().value());
    std::string text = fmt::format("{:4} Comment line(s) follow, each starting with a \"|\":\n{}",
                                   std::count(comments.begin(), comments.end(), '\n'), comments);
    text += fmt::format("{:8} {} pts, approx {:4.0f} secs, units={}({:02}),Format=(3E25.16)\n", series.size(), unit.name,
                        static_cast<double>(series.size()) * series.dt().value(), unit.unit, unit.unit_code);
    constexpr std::size_t kPerLine = 3;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const bool ends_line = i % kPerLine == kPerLine - 1 || i + 1 == series.size();
        fmt::format_to(std::back_inserter(text), "{:25.16E}{}", series.samples()[i] * unit.per_si, ends_line ? "\n" : "");
    }
    return text + fmt::format("End-of-data for Chan {:3} {}\n", ordinal, unit.name);
}

}  // namespace

void write_cosmos(const std::filesystem::path& path, const GroundMotion& motion) {
    if (motion.components.empty()) throw WriteError(fmt::format("{}: record has no components; nothing to write", path.string()));
    std::string text;
    std::size_t ordinal = 1;
    for (const Component& component : motion.components) {
        refuse_rotation(path, component, "COSMOS files");
        require_time_step(path, component);
        text += text_lines(motion, component, ordinal) + integer_header(motion, component, ordinal) +
                real_header(motion, component.series) + data_block(motion, component.series, ordinal);
        ++ordinal;
    }
    write_file_atomically(path, text);
}

}  // namespace musim::records
