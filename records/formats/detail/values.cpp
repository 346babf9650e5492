#include "records/formats/detail/values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"

namespace musim::records::detail {

std::vector<double> read_values(const TextFile& file, std::size_t begin, std::size_t end, const AnnouncedCount& announced, double si) {
    constexpr std::size_t kReservedAtMost = 1U << 20U;  // values; a damaged count must not claim the memory
    constexpr std::string_view kSeparators = " \t,";
    std::vector<double> values;
    values.reserve(std::min(announced.count, kReservedAtMost));
    for (std::size_t index = begin; index < end; ++index) {
        std::string_view rest = file.line(index);
        for (std::string_view token = take_token(rest, kSeparators); !token.empty(); token = take_token(rest, kSeparators)) {
            const double sample = checked_sample(file, index, token, values.size() + 1, si);
            if (values.size() == announced.count) {
                file.fail(index, fmt::format("more values than {} = {} (header and data disagree)", announced.name, announced.count),
                          fmt::format("correct {} or fetch the record again", announced.name));
            }
            values.push_back(sample);
        }
    }
    if (values.size() < announced.count) {
        file.fail(std::max<std::size_t>(end, 1) - 1,
                  fmt::format("{} values for {} = {} (file is truncated)", values.size(), announced.name, announced.count),
                  fmt::format("fetch the record again or correct {}", announced.name));
    }
    return values;
}

}  // namespace musim::records::detail
