#pragma once

#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/contact_area.hpp"

namespace musim::lsdem::tests {

/// Questions of friction and dashpots to the main cells of a pair, see MainCells.
struct MainCellQuestion {
    AffinePressure dashpot;
    double stiffness;
    Vector3 normal, about;
};
struct MainCellAnswer {
    PressureMoments pull;
    double reach, least_reach;
    bool may_pull;
    bool operator==(const MainCellAnswer&) const = default;
};
/// Answers of detail::kLanePairs pairs, four side by side.
void ask_main_cells(const detail::BoxMeeting* pairs, const MainCellQuestion* questions, MainCellAnswer* answers);

}  // namespace musim::lsdem::tests
