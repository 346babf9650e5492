#include "records/detail/fixed_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/parsers.hpp"
#include "records/detail/text.hpp"

namespace musim::records::detail {

std::vector<double> read_fixed_columns(const TextFile& file, std::size_t first, std::size_t count, const FixedColumns& columns, double si) {
    const auto& [per_line, width] = columns;
    std::vector<double> samples;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t index = first + i / per_line;
        const std::size_t column = i % per_line;
        const std::string_view line = file.line(index);
        if (line.size() <= column * width) {
            file.fail(std::min(index, file.size() - 1), fmt::format("sample {} of {} is missing (file is truncated)", i + 1, count),
                      "fetch the record again");
        }
        const std::string_view text = trim(line.substr(column * width, width));
        if (text.find('.') == std::string_view::npos) {
            file.fail(index, fmt::format("sample {} is {} (no decimal point in its column)", i + 1, quoted(text)),
                      "check the header's Fortran format or fetch the record again");
        }
        samples.push_back(checked_sample(file, index, text, i + 1, si));

        const bool ends_line = column + 1 == per_line || i + 1 == count;
        if (ends_line && line.size() > (column + 1) * width) {
            file.fail(index, fmt::format("line goes on after sample {} (more values than the header's {})", i + 1, count),
                      "correct the number of points");
        }
    }
    return samples;
}

}  // namespace musim::records::detail
