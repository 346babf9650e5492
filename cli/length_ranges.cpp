#include "cli/length_ranges.hpp"

#include "records/shake_table/table_check.hpp"

namespace musim::cli {

std::string describe_ranges(const std::vector<scaling::LengthRange>& ranges) {
    std::string text;
    for (const scaling::LengthRange& range : ranges) {
        if (!text.empty()) text += ", ";
        const bool is_open_below = range.smallest == records::kSmallestScale, is_open_above = range.largest == 1.0;
        if (is_open_below && is_open_above) {
            text += "all";
        } else if (is_open_below) {
            text += "up to " + scaling::describe_scale(range.largest);
        } else if (is_open_above) {
            text += "from " + scaling::describe_scale(range.smallest);
        } else {
            text += scaling::describe_scale(range.smallest) + " ... " + scaling::describe_scale(range.largest);
        }
    }
    return text.empty() ? "none" : text;
}

}  // namespace musim::cli
