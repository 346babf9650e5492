#include "scaling/detail/edit_distance.hpp"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace musim::scaling::detail {

namespace {

bool are_same_letter(char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
    // row i: distances of the first i letters of a from the beginnings of b
    std::vector<int> before_last, last, row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = 2 * static_cast<int>(j);
    for (std::size_t i = 0; i < a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = last[0] + 2;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const int substitution = a[i] == b[j] ? 0 : are_same_letter(a[i], b[j]) ? 1 : 2;
            row[j + 1] = std::min({last[j] + substitution, row[j] + 2, last[j + 1] + 2});
            const bool is_swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
            if (is_swapped) row[j + 1] = std::min(row[j + 1], before_last[j - 1] + 2);
        }
    }
    return row[b.size()];
}

}  // namespace musim::scaling::detail
