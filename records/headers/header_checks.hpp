#pragma once

#include <span>
#include <string_view>

#include "records/headers/direction.hpp"
#include "records/headers/text_file.hpp"
#include "scaling/units.hpp"

/// Checks that what a header says of its samples is true of them.
namespace musim::records::detail {

/// Throws ReadError on line `index` unless `count` samples last the `length` [s] that line `stated_on` gives, to 1 % and two steps: lengths
/// are rounded to whole seconds or count one sample less. A length of zero or less is unknown and fits.
void check_record_length(const TextFile& file, std::size_t index, std::size_t count, scaling::Time dt, double length,
                         std::size_t stated_on);

/// A peak as the header states it, and how far the samples may be from it, both in a unit worth `si`.
struct StatedPeak {
    double value = 0.0;
    double tolerance = 0.0;
    double si = 1.0;
    std::string_view unit = {};
};

/// Throws ReadError on line `index` unless the largest of the samples (SI) has the magnitude stated. Signs are not compared: networks print
/// peaks without, or of the opposite direction.
void check_peak(const TextFile& file, std::size_t index, std::span<const double> samples, const StatedPeak& stated);

/// Throws ReadError on line `index`, where `stored` stands as azimuth [deg], when the title on line `titled_on` names another: a damaged
/// header would shake the wrong axis. 0 and -999 stand for unknown.
void check_azimuth(const TextFile& file, std::size_t index, double stored, const Direction& direction, std::size_t titled_on);

/// Index of the sample farthest from `level`, the first of several; 0 when there is none.
std::size_t find_peak(std::span<const double> samples, double level = 0.0);

/// The sample farthest from `level`, minus that level, with its sign; 0 when there is none.
double signed_peak(std::span<const double> samples, double level = 0.0);

/// Half of what one unit of a printed number's last digit is worth: 0.005 of "-41.60", 5 of "1.20E3", 0.5 of "-1017.".
double half_last_digit(std::string_view number);

/// A peak of the samples, and by how much their printing rounded it, in the header's unit.
struct MeasuredPeak {
    double value = 0.0;
    double rounding = 0.0;
};

/// Throws ReadError unless the measured peak is the one that line `index` prints, to one unit of its last digit and the rounding of the
/// samples.
void check_stated_peak(const TextFile& file, std::size_t index, std::string_view name, std::string_view printed,
                       const MeasuredPeak& measured);

}  // namespace musim::records::detail
