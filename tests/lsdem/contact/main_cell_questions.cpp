#include "tests/lsdem/contact/main_cell_questions.hpp"

#include <cstddef>

#include "lsdem/contact/lane_pairs.hpp"

namespace musim::lsdem::tests {

void ask_main_cells(const detail::BoxMeeting* pairs, const MainCellQuestion* questions, MainCellAnswer* answers) {
    using Lane = detail::Lane<detail::Wide<4>>;
    using All = detail::LanePairs<detail::Wide<4>>;
    using Real = Lane::Real;
    using Vector = Lane::Vector;
    All::Overlaps overlaps;
    All::find([pairs](std::size_t i) MUSIM_WIDE_LAMBDA -> const detail::BoxMeeting& { return pairs[i]; }, All::kGroups, overlaps);
    for (std::size_t g = 0; g < All::kGroups; ++g) {
        const auto& found = overlaps[g];
        const std::size_t first = g * All::kStep;
        detail::MainCells<detail::Wide<4>> cells{found.cells, {}, {}, {}, {}};
        const Lane::Step::Geometry geometry = Lane::make_geometry(found, Vector{}, cells);
        const auto vector = [&](Vector3 MainCellQuestion::*of) MUSIM_WIDE_LAMBDA {
            const auto f =
                detail::gather_fields<Real, 3>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return (questions[first + i].*of).data(); });
            return Vector{f[0], f[1], f[2]};
        };
        // at, slope and about lie behind each other
        static_assert(sizeof(AffinePressure) == 7 * sizeof(double));
        const auto p = detail::gather_fields<Real, 7>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return &questions[first + i].dashpot.at; });
        const Lane::Step::Pressure dashpot{p[0], {p[1], p[2], p[3]}, {p[4], p[5], p[6]}};
        const Real stiffness = detail::gather_lanes<Real>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return questions[first + i].stiffness; });
        const Lane::Step::PressureSum pull = cells.find_pull(dashpot, stiffness);
        const Vector normal = vector(&MainCellQuestion::normal), about = vector(&MainCellQuestion::about);
        const Real reach = cells.find_reach(normal, about), least = cells.least_reach(normal, geometry);
        const Lane::Mask may_pull = cells.may_pull(geometry, dashpot, stiffness);
        for (std::size_t i = 0; i < All::kStep; ++i)
            answers[first + i] = {{pull.sum[i], Lane::pick(pull.at, i)}, reach[i], least[i], may_pull[i] != 0};
    }
}

}  // namespace musim::lsdem::tests
