#include "cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace musim::cli {
namespace {

/// Is a byte of UTF-8 not the second or a later one of its character?
bool starts_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

}  // namespace

bool is_terminal(std::FILE* stream) {
    const char* const kind = std::getenv("TERM");
    return isatty(fileno(stream)) == 1 && !(kind != nullptr && std::string_view(kind) == "dumb");
}

std::size_t count_columns(std::FILE* stream) {
    constexpr std::size_t kUsual = 80;
    winsize size{};
    return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

std::size_t count_characters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

std::string fit(const std::string& text, std::size_t columns) {
    if (count_characters(text) <= columns) return text;
    if (columns == 0) return {};
    std::size_t kept = 0;
    const auto end = std::find_if(text.begin(), text.end(), [&](char c) { return starts_character(c) && ++kept == columns; });
    return std::string(text.begin(), end) + "…";
}

bool wants_colour(std::FILE* stream) {
    const char* const refused = std::getenv("NO_COLOR");
    return is_terminal(stream) && (refused == nullptr || *refused == '\0');
}

std::string in_red(std::string_view text, std::FILE* stream) {
    return wants_colour(stream) ? "\x1b[31m" + std::string(text) + "\x1b[0m" : std::string(text);
}

std::string make_sparkline(const std::vector<double>& values) {
    constexpr std::array<const char*, 8> kBars{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    std::string line;
    for (const double value : values) {
        const double height = largest > 0.0 ? 0.5 * (1.0 + value / largest) : 0.5;
        line += kBars[std::min(static_cast<std::size_t>(height * kBars.size()), kBars.size() - 1)];
    }
    return line;
}

}  // namespace musim::cli
