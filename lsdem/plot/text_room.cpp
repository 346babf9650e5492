#include "lsdem/plot/text_room.hpp"

#include <array>
#include <sstream>
#include <vector>

namespace musim::lsdem::detail {
namespace {

/// Advance widths of DejaVu Sans from space to ~ [font size/1000], of its table hmtx.
constexpr std::array<int, 95> kAsciiWidths{318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
                                           636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
                                           575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
                                           611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
                                           278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
constexpr int kOtherWidth = 1000;

int find_letter_width(unsigned char first) {
    const int place = first - ' ';
    return place >= 0 && place < static_cast<int>(kAsciiWidths.size()) ? kAsciiWidths[static_cast<std::size_t>(place)] : kOtherWidth;
}

/// Does a byte of UTF-8 go on with the letter before?
bool continues_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Where the letters of `text` begin, and its end.
std::vector<std::size_t> find_letters(const std::string& text) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!continues_letter(text[i])) starts.push_back(i);
    }
    starts.push_back(text.size());
    return starts;
}

}  // namespace

double find_text_width(const std::string& text, double font_size) {
    int width = 0;
    for (const char byte : text) {
        if (!continues_letter(byte)) width += find_letter_width(static_cast<unsigned char>(byte));
    }
    return font_size * width / 1000.0;
}

std::string shorten(const std::string& text, double font_size, double room) {
    if (find_text_width(text, font_size) <= room) return text;
    const std::vector<std::size_t> letters = find_letters(text);
    const std::size_t count = letters.size() - 1;
    // the letters that stay, the odd one in front
    for (std::size_t kept = count - 1; kept > 0; --kept) {
        const std::size_t front = letters[(kept + 1) / 2], back = letters[count - kept / 2];
        std::string shorter = text.substr(0, front) + "…" + text.substr(back);
        if (find_text_width(shorter, font_size) <= room) return shorter;
    }
    return "…";
}

std::vector<std::string> wrap(const std::string& text, double font_size, double room) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const bool fits = !lines.empty() && find_text_width(lines.back() + " " + word, font_size) <= room;
        if (fits) {
            lines.back() += " " + word;
        } else {
            lines.push_back(word);
        }
    }
    return lines;
}

}  // namespace musim::lsdem::detail
