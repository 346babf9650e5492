#include "lsdem/scene/detail/wall_courses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lsdem/scene/detail/json_text.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::Length;

/// Places that differ by less are the same: those of a scaled scene are off by rounding [cells].
constexpr double kSame = 1e-9;

/// Least length of a block that is cut, as a part of a whole one [-].
constexpr double kLeastBlock = 0.25;

std::string write_wall_length(double meters) { return scaling::format_quantity(Length::from_value(meters), 4); }

/// Part of a course, from joint to joint [cells].
struct Span {
    double from = 0.0, to = 0.0;
    bool is_lintel = false;

    double length() const { return to - from; }
};

/// Measures of a wall [m].
struct WallMeasures {
    explicit WallMeasures(const Wall& wall)
        : leaf(wall.block[0].value()),
          block(wall.block[1].value()),
          height(wall.block[2].value()),
          pitch(wall.pitch.value_or(default_pitch(wall.block)).value()),
          joint(2.0 * pitch - block),
          thickness(wall.leaves ? 2.0 * leaf + wall.leaves->gap.value() : leaf),
          bearing(wall.lintel && wall.lintel->bearing ? wall.lintel->bearing->value() : block - pitch) {}

    /// Cells that a wall at right angles takes at a corner.
    double corner() const { return (thickness + joint) / pitch; }
    /// Length of the block that fills a span; whole and half ones are what they are [m].
    double length_of(const Span& span) const {
        if (span.length() == 2.0) return block;
        return span.length() == 1.0 ? block - pitch : span.length() * pitch - joint;
    }
    bool is_sliver(const Span& span) const { return length_of(span) < (kLeastBlock - kSame) * block; }
    bool is_nothing(const Span& span) const { return length_of(span) <= kSame * block; }

    double leaf, block, height;
    double pitch, joint;
    double thickness;  ///< of both leaves and what is between them
    double bearing;    ///< of a lintel on each side: as given, else a half block
};

/// A place in cells, on the border of one if it is that but for rounding.
double snap(double cells) {
    const double whole = std::round(cells);
    return std::abs(cells - whole) < kSame ? whole : cells;
}

/// The opening in a course, and its lintel in the one above, in cells from the middle of the wall.
struct OpeningSpans {
    Span hole, lintel;
    int first = 1, last = 1;  ///< courses of the hole
    bool has_lintel = false;

    /// Span that it takes of a course, if any.
    std::optional<Span> find(int course) const {
        if (course >= first && course <= last) return hole;
        if (has_lintel && course == last + 1) return lintel;
        return std::nullopt;
    }
};

/// Lays one wall.
class WallLayer {
  public:
    WallLayer(const Wall& wall, const JsonPlace& place)
        : wall_(wall), returns_(wall.returns.value_or(WallReturns{})), place_(place), measures_(wall) {
        for (std::size_t k = 0; k < wall.openings.size(); ++k) openings_.push_back(make_spans(wall.openings[k]));
        for (std::size_t k = 0; k < openings_.size(); ++k) check_opening(k);
        check_returns();
    }

    std::vector<WallBox> lay() {
        for (int course = 1; course <= wall_.layers; ++course) {
            const std::vector<Span> spans = make_course(course);
            const bool is_header = wall_.leaves && wall_.leaves->headers_every > 0 && course % wall_.leaves->headers_every == 0;
            for (const double across : leaf_places(is_header)) {
                for (const Span& span : spans) add_box(span, course, across, is_header);
                if (!spans.empty() && across <= 0.0) boxes_.back().is_line = true;
            }
            if (returns_.left > 0) add_return(course, -1, returns_.left, is_header);
            if (returns_.right > 0) add_return(course, 1, returns_.right, is_header);
        }
        return std::move(boxes_);
    }

  private:
    /// Middles of the leaves across the wall [m].
    std::vector<double> leaf_places(bool is_header) const {
        if (!wall_.leaves || is_header) return {0.0};
        const double apart = 0.5 * (measures_.leaf + wall_.leaves->gap.value());
        return {-apart, apart};
    }

    OpeningSpans make_spans(const WallOpening& opening) const {
        const double left = -wall_.blocks_per_layer, p = measures_.pitch, joint = measures_.joint, bearing = measures_.bearing;
        const double from = opening.from.value(), to = from + opening.width.value();
        OpeningSpans spans;
        spans.hole = {snap(left + (from + joint) / p), snap(left + to / p)};
        spans.lintel = {snap(left + (from - bearing) / p), snap(left + (to + bearing + joint) / p), true};
        spans.first = opening.sill + 1;
        spans.last = opening.sill + opening.courses;
        spans.has_lintel = spans.last < wall_.layers;
        return spans;
    }

    /// From where to where the wall itself goes in a course: at a corner its return runs through in even ones.
    Span find_run(int course) const {
        const double end = wall_.blocks_per_layer, corner = course % 2 == 0 ? measures_.corner() : 0.0;
        return {snap(returns_.left > 0 ? -end + corner : -end), snap(returns_.right > 0 ? end - corner : end)};
    }

    void check_opening(std::size_t k) const {
        const JsonPlace here = place_.at("openings").at(k);
        const OpeningSpans& spans = openings_[k];
        if (spans.last > wall_.layers) {
            fail(here.at("courses"), fmt::format("{} courses above a sill of {} reach beyond the {} of the wall; make it lower",
                                                 wall_.openings[k].courses, wall_.openings[k].sill, wall_.layers));
        }
        for (int course = spans.first; course <= spans.last + (spans.has_lintel ? 1 : 0); ++course) {
            const Span run = find_run(course), taken = *spans.find(course);
            if (taken.from < run.from - kSame || taken.to > run.to + kSame) {
                fail(here,
                     fmt::format("{} reaches beyond the wall in course {} (which goes from {} to {} there); move it or make it shorter",
                                 taken.is_lintel ? "its lintel" : "it", course, write_wall_length(from_left(run.from)),
                                 write_wall_length(from_left(run.to) - measures_.joint)));
            }
            for (std::size_t other = 0; other < k; ++other) {
                const std::optional<Span> there = openings_[other].find(course);
                if (!there || there->to <= taken.from + kSame || taken.to <= there->from + kSame) continue;
                fail(here, fmt::format("it meets opening {} in course {}{}; move them apart", other, course,
                                       taken.is_lintel || there->is_lintel ? " (lintels count with their bearing)" : ""));
            }
        }
    }

    /// That something is left between corners, and of a return behind one.
    void check_returns() const {
        const auto check = [&](double left, const JsonPlace& here) {
            if (2.0 * kLeastBlock <= left + kSame) return;
            fail(here,
                 fmt::format("too short for a corner (which takes {} of a length); add blocks", write_wall_length(measures_.thickness)));
        };
        const auto& [left, right] = returns_;
        if (left > 0 || right > 0) check(find_run(2).length(), place_.at("blocks_per_layer"));
        if (left > 0) check(2.0 * left - measures_.corner(), place_.at("returns").at("left"));
        if (right > 0) check(2.0 * right - measures_.corner(), place_.at("returns").at("right"));
    }

    /// Length from the left end of the wall to a joint [m].
    double from_left(double cells) const { return (cells + wall_.blocks_per_layer) * measures_.pitch; }

    /// Blocks of a course in running bond over `cells` cells, whole ones first, or a half one.
    static std::vector<Span> make_bond(double from, int cells, bool whole_first) {
        std::vector<Span> spans;
        for (int cell = whole_first ? 0 : -1; cell < cells; cell += 2)
            spans.push_back({from + std::max(cell, 0), from + std::min(cell + 2, cells)});
        return spans;
    }

    std::vector<Span> make_course(int course) const {
        const double left = -wall_.blocks_per_layer;
        std::vector<Span> spans = make_bond(left, 2 * wall_.blocks_per_layer, course % 2 == 1), lintels;
        const Span run = find_run(course);
        cut(spans, {left - 1.0, run.from});
        cut(spans, {run.to, -left + 1.0});
        for (const OpeningSpans& opening : openings_) {
            const std::optional<Span> taken = opening.find(course);
            if (!taken) continue;
            cut(spans, *taken);
            if (taken->is_lintel) lintels.push_back(*taken);
        }
        join_slivers(spans, course);
        spans.insert(spans.end(), lintels.begin(), lintels.end());
        std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.from < b.from; });
        return spans;
    }

    /// Takes `hole` out of the blocks of a course.
    static void cut(std::vector<Span>& spans, const Span& hole) {
        std::vector<Span> left;
        for (const Span& span : spans) {
            if (span.to <= hole.from || span.from >= hole.to) {
                left.push_back(span);
                continue;
            }
            if (span.from < hole.from) left.push_back({span.from, hole.from});
            if (span.to > hole.to) left.push_back({hole.to, span.to});
        }
        spans = std::move(left);
    }

    /// Leaves out what has no length, and lengthens a block by the sliver beside it.
    void join_slivers(std::vector<Span>& spans, int course) const {
        std::erase_if(spans, [&](const Span& span) { return measures_.is_nothing(span); });
        for (std::size_t k = 0; k < spans.size();) {
            if (!measures_.is_sliver(spans[k])) {
                ++k;
            } else if (k > 0 && spans[k - 1].to == spans[k].from) {
                spans[k - 1].to = spans[k].to;
                spans.erase(spans.begin() + static_cast<std::ptrdiff_t>(k));
            } else if (k + 1 < spans.size() && spans[k].to == spans[k + 1].from) {
                spans[k + 1].from = spans[k].from;
                spans.erase(spans.begin() + static_cast<std::ptrdiff_t>(k));
            } else {
                fail(place_.at("openings"),
                     fmt::format("in course {} a piece of {} is left by itself (less than a quarter of a block, {}); move an opening, or "
                                 "change the \"bearing\" of the lintels",
                                 course, write_wall_length(measures_.length_of(spans[k])),
                                 write_wall_length(kLeastBlock * measures_.block)));
            }
        }
    }

    /// A return at the left (−1) or the right end (+1), towards +y. Its courses begin with a whole block where it runs through.
    void add_return(int course, int side, int blocks, bool is_header) {
        const bool runs_through = course % 2 == 0;
        std::vector<Span> spans = make_bond(0.0, 2 * blocks, runs_through);
        if (!runs_through) cut(spans, {-1.0, snap(measures_.corner())});
        join_slivers(spans, course);
        const double end = wall_.blocks_per_layer * measures_.pitch - 0.5 * (measures_.joint + measures_.thickness);
        const double begin = -0.5 * (measures_.thickness + measures_.joint);
        for (const double across : leaf_places(is_header)) {
            for (const Span& span : spans) {
                WallBox box = make_box(span, course, is_header);
                box.along_x = false;
                box.position.x() = side * (end - across);
                box.position.y() = begin + 0.5 * (span.from + span.to) * measures_.pitch;
                boxes_.push_back(box);
            }
        }
    }

    void add_box(const Span& span, int course, double across, bool is_header) {
        WallBox box = make_box(span, course, is_header);
        box.position.x() = 0.5 * (span.from + span.to) * measures_.pitch;
        box.position.y() = across;
        boxes_.push_back(box);
    }

    WallBox make_box(const Span& span, int course, bool is_header) const {
        WallBox box;
        box.size = {is_header ? measures_.thickness : measures_.leaf, measures_.length_of(span), measures_.height};
        box.position.z() = measures_.height * (course - 0.5);
        box.course = course;
        box.is_lintel = span.is_lintel;
        return box;
    }

    const Wall& wall_;
    WallReturns returns_;
    JsonPlace place_;
    WallMeasures measures_;
    std::vector<OpeningSpans> openings_;
    std::vector<WallBox> boxes_;
};

}  // namespace

std::vector<WallBox> lay_wall(const Wall& wall, const JsonPlace& place) { return WallLayer(wall, place).lay(); }

}  // namespace musim::lsdem::detail
