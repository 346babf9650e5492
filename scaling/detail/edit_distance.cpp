#include "scaling/detail/edit_distance.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace musim::scaling::detail {

int edit_distance(std::string_view a, std::string_view b) {
    std::vector<int> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = 2 * static_cast<int>(j);
    for (const char letter : a) {
        int diagonal = row[0];
        row[0] += 2;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const bool same_letter = std::tolower(static_cast<unsigned char>(letter)) == std::tolower(static_cast<unsigned char>(b[j]));
            const int substitution = letter == b[j] ? 0 : same_letter ? 1 : 2;
            const int best = std::min({diagonal + substitution, row[j] + 2, row[j + 1] + 2});
            diagonal = row[j + 1];
            row[j + 1] = best;
        }
    }
    return row[b.size()];
}

}  // namespace musim::scaling::detail
