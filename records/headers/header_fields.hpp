#pragma once

#include <optional>
#include <string_view>

#include "records/headers/text_file.hpp"
#include "records/sample_unit.hpp"
#include "records/utc_time.hpp"

namespace musim::records::detail {

/// Date and time as headers write them: "2018/01/24 19:51:43", "20/07/2017 22:30:58.000000 (GMT)", "2018/02/06-23:50:29.000",
/// "20190728_160919.870". A clock `hours_ahead` of UTC shows it; text behind the time is not looked at. Nothing when it cannot be read.
std::optional<UtcTime> parse_date_time(std::string_view text, double hours_ahead = 0.0);

/// Value of a header under one name, and its line.
struct HeaderField {
    std::size_t line = 0;
    std::string_view text = {};
};

/// The first lines of a file as named fields: `NAME value`, `NAME : value` or `#NAME: value`; names in any case, the first of a name
/// counts.
class HeaderFields {
  public:
    /// The fields of the lines before `end`; the file must outlive them.
    HeaderFields(const TextFile& file, std::size_t end) : file_(&file), end_(end) {}

    /// The field called `name`; nothing when it is absent or empty.
    std::optional<HeaderField> find(std::string_view name) const;
    /// Its text; empty when it is absent.
    std::string_view text(std::string_view name) const;

    /// The same for fields that must be there; throw ReadError when they are not, or hold no positive integer or number.
    HeaderField require(std::string_view name) const;
    std::size_t require_count(std::string_view name) const;
    double require_positive(std::string_view name) const;
    /// The unit of acceleration that is the first word, of "gal. DCoffset(corr)" or "Gal (cm/s/s)".
    SampleUnit require_acceleration(std::string_view name) const;

    /// The date and time (see parse_date_time) of a clock `hours_ahead` of UTC; nothing when absent or empty, ReadError when unreadable.
    std::optional<UtcTime> find_time(std::string_view name, double hours_ahead = 0.0) const;

  private:
    const TextFile* file_;
    std::size_t end_;
};

}  // namespace musim::records::detail
