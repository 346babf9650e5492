#include "records/detail/integration_corner.hpp"

#include <fmt/format.h>

#include "records/detail/text.hpp"

namespace musim::records::detail {

std::optional<scaling::Frequency> find_integration_corner(const TextFile& file, std::size_t index) {
    const std::string_view line = file.line(index);
    const std::size_t found = find_ignoring_case(line, kCornerTitle);
    if (found == std::string_view::npos) return std::nullopt;
    std::string_view rest = line.substr(found + kCornerTitle.size());
    const std::string_view number = take_token(rest, " \t=");
    const std::optional<double> hertz = parse_real(number);
    if (!hertz || !(*hertz > 0.0)) {
        file.fail(index, fmt::format("integration corner {} is no positive number", quoted(number)), "write it in Hz, or remove it");
    }
    return *hertz * scaling::si::hertz;
}

}  // namespace musim::records::detail
