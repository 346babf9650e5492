#pragma once

#include <cstddef>

#include "records/design/candidate.hpp"

namespace musim::records::detail {

/// Where a candidate's material and law stand in the design: the same places in the design read again, which may have other values there.
struct Place {
    std::size_t material = 0, law = 0;

    Place(const Design& design, const Candidate& candidate) {
        while (design.materials[material].name != candidate.material.name) ++material;
        while (!(design.laws[law] == candidate.law)) ++law;
    }
};

}  // namespace musim::records::detail
