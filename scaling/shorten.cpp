#include "scaling/shorten.hpp"

#include <algorithm>
#include <cctype>

namespace musim::scaling {
namespace {

/// True for bytes that go on with a letter of UTF-8, which a cut must not part.
bool continues_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

std::string make_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char letter) { return std::iscntrl(static_cast<unsigned char>(letter)) != 0; }, ' ');
    return text;
}

std::string shorten(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    constexpr std::string_view kGap = "...";
    std::size_t end = 2 * (most - kGap.size()) / 3, start = text.size() - (most - kGap.size() - end);
    while (end > 0 && continues_letter(text[end])) --end;
    while (start < text.size() && continues_letter(text[start])) ++start;
    return std::string(text.substr(0, end)).append(kGap).append(text.substr(start));
}

}  // namespace musim::scaling
