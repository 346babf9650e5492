#include "lsdem/plot/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "lsdem/plot/plot_panel.hpp"
#include "lsdem/plot/svg.hpp"

namespace musim::lsdem {
namespace {

using detail::draw_text;
using detail::kSmallFont;
using detail::kTitleFont;
using detail::PanelPlace;

/// Sizes of the picture [px].
constexpr double kYLabelGap = 60.0, kLeft = kYLabelGap + 20.0, kRight = 16.0, kColumnGap = kLeft + 8.0;
constexpr double kKeyTop = 50.0, kKeyLine = 17.0, kSampleWidth = 26.0, kKeyGap = 18.0;
constexpr double kColumnHeight = 560.0, kXNames = 56.0, kSecondXNames = 40.0, kCommonGap = 14.0, kTitleHeight = 20.0, kCaptionLine = 16.0;

/// A panel with names of its own below it is at least so high: with less, its axis has one number.
constexpr double kLeastHeight = 130.0;

/// Letters of DejaVu Sans Bold are so much wider at most.
constexpr double kBoldest = 1.26;

/// On one line up to `right`: in letters down to the small ones, and shortened where that is not enough.
void draw_title(std::string& svg, const std::string& title, double right) {
    const double room = (right - kLeft) / kBoldest, width = detail::find_text_width(title, kTitleFont);
    const double font = width > room ? std::max(kSmallFont, kTitleFont * room / width) : kTitleFont;
    draw_text(svg, kLeft, 26.0, "start", fmt::format("class=\"title\" style=\"font-size:{:.2f}px\"", font).c_str(),
              detail::shorten(title, font, room));
}

/// Colours of Okabe and Ito, and how often each comes with another dash.
constexpr std::array<const char*, 6> kApartColors{"#0072B2", "#D55E00", "#000000", "#56B4E9", "#009E73", "#CC79A7"};
constexpr std::size_t kApartRounds = 3;
constexpr std::array<const char*, 5> kPale{"#9BD0F2", "#F5B98A", "#C9C9C9", "#8FD6BE", "#E6BCD3"};
constexpr std::array<const char*, 5> kDark{"#003F66", "#8A3A00", "#000000", "#00543D", "#7A2F58"};

/// Six dashes move on by one a round: colours keep theirs to themselves, and the two blues, three places apart, never have the same one.
/// Neighbours differ in width too.
detail::LineStyle find_style_apart(std::size_t index) {
    static constexpr std::array<const char*, 6> kDashes{"", "5 1.5", "1.5 1.2", "8 2 1.5 2", "3 3", "10 4"};
    static constexpr std::array<double, 3> kWidths{1.2, 1.0, 0.8};
    const std::size_t color = index % kApartColors.size(), round = index / kApartColors.size() % kApartRounds;
    return {kApartColors[color], kWidths[index % kWidths.size()], kDashes[(color + round) % kDashes.size()]};
}

detail::LineStyle find_style_in_pairs(std::size_t index) {
    static constexpr std::array<const char*, 5> kDashes{"5 2.5", "1.5 1.5", "9 2.5 1.5 2.5", "3 3", "5 2.5"};
    const std::size_t pair = index / 2 % kPale.size();
    if (index % 2 == 0) return {kPale[pair], 2.6, ""};
    return {kDark[pair], 0.8, kDashes[pair]};
}

/// Draws the key as a table and returns where it ends [px]; the first column is for names, which give way to the numbers.
double draw_key(std::string& svg, const Figure& figure, double right, detail::FindStyle find_style) {
    const std::size_t cells = figure.key_headings.size();
    if (cells == 0) return kKeyTop;
    // the width of a column is that of its longest text, unless there is less room for names
    constexpr double kFirst = kLeft + kSampleWidth + 8.0;
    std::vector<double> widths;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        double widest = detail::find_text_width(figure.key_headings[cell], kSmallFont);
        for (const KeyRow& row : figure.key) widest = std::max(widest, detail::find_text_width(row.cells.at(cell), kSmallFont));
        widths.push_back(widest);
    }
    const double numbers = std::accumulate(widths.begin() + 1, widths.end(), kKeyGap * static_cast<double>(cells - 1));
    widths.front() = std::min(widths.front(), std::max(0.0, right - kFirst - numbers));
    // what room is left stands between the columns
    const double spare = std::max(0.0, right - kFirst - numbers - widths.front()) / static_cast<double>(cells);
    std::vector<double> places{kFirst};
    for (std::size_t cell = 1; cell < cells; ++cell) places.push_back(places.back() + widths[cell - 1] + kKeyGap + spare);

    double y = kKeyTop + 4.0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        draw_text(svg, places[cell], y, "start", "class=\"small\" fill=\"#555\"", figure.key_headings[cell]);
    }
    for (const KeyRow& row : figure.key) {
        y += kKeyLine;
        detail::draw_sample(svg, kLeft + 0.5 * kSampleWidth, y - 4.0, {}, find_style(static_cast<std::size_t>(row.style)));
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const std::string text = cell == 0 ? detail::shorten(row.cells[cell], kSmallFont, widths.front()) : row.cells[cell];
            draw_text(svg, places[cell], y, "start", "class=\"small\"", text);
        }
    }
    return y + 8.0;
}

/// Height of all columns: what the one with most panels needs.
double find_column_height(const Figure& figure) {
    double height = kColumnHeight;
    for (const FigureColumn& column : figure.columns) {
        if (!column.common_x) height = std::max(height, static_cast<double>(column.panels.size()) * (kLeastHeight + kXNames));
    }
    return height;
}

/// Draws the panels of a column between `top` and `top` + `column_height`; `number` counts the figure's panels for their letters.
void draw_column(std::string& svg, const FigureColumn& column, double left, double top, double column_height, detail::FindStyle find_style,
                 int& number) {
    if (column.panels.empty()) return;
    const double above = !column.second_x.empty() ? kSecondXNames : 0.0;
    const auto count = static_cast<double>(column.panels.size());
    const double gap = column.common_x ? kCommonGap : kXNames + above;
    const double height = (column_height - above - kXNames - (count - 1.0) * gap) / count;

    detail::DataRange common{.logarithmic = column.panels.front().x_logarithmic};
    for (const LinePlot& panel : column.panels) detail::add_abscissas(common, panel);
    for (std::size_t i = 0; i < column.panels.size(); ++i) {
        const LinePlot& panel = column.panels[i];
        const double y = top + above + static_cast<double>(i) * (height + gap);
        PanelPlace place{.frame = {.left = left, .top = y, .width = column.width, .height = height, .y_label_gap = kYLabelGap},
                         .x_range = common,
                         .x_named = !column.common_x || i + 1 == column.panels.size(),
                         .headroom = kTitleHeight};
        if (!column.common_x) {
            place.x_range = {.logarithmic = panel.x_logarithmic};
            detail::add_abscissas(place.x_range, panel);
        }
        place.x_range.widen(0.0);
        if (i < column.second_x.size()) place.second_x = column.second_x[i];
        detail::draw_panel(svg, panel, place, detail::find_styles(panel, find_style));
        const std::string letter = std::string("(") + static_cast<char>('a' + number++ % 26) + ")";
        const std::string title = panel.title.empty() ? letter : letter + " " + panel.title;
        draw_text(svg, left + 7.0, y + 15.0, "start", "class=\"small\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"", title);
    }
}

}  // namespace

std::size_t count_styles(CurveStyles styles) {
    return styles == CurveStyles::pairs ? 2 * kPale.size() : kApartColors.size() * kApartRounds;
}

std::string make_svg(const Figure& figure) {
    const detail::FindStyle find_style = figure.styles == CurveStyles::pairs ? find_style_in_pairs : find_style_apart;
    double right = kLeft - kColumnGap;
    for (const FigureColumn& column : figure.columns) right += kColumnGap + column.width;

    std::string content;
    draw_title(content, figure.title, right);
    const double top = draw_key(content, figure, right, find_style) + 8.0;
    const double column_height = find_column_height(figure);
    double left = kLeft;
    int number = 0;
    for (const FigureColumn& column : figure.columns) {
        draw_column(content, column, left, top, column_height, find_style, number);
        left += column.width + kColumnGap;
    }
    double y = top + column_height;
    for (const std::string& text : figure.caption) {
        for (const std::string& line : detail::wrap(text, kSmallFont, right - kLeft)) {
            y += kCaptionLine;
            draw_text(content, kLeft, y, "start", "class=\"small\"", line);
        }
    }
    return detail::open_svg(right + kRight, y + kCaptionLine, figure.title) + content + "</svg>\n";
}

}  // namespace musim::lsdem
