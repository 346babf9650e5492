#pragma once

#include <vector>

namespace musim::lsdem {

/// Energy an interface has dissipated [J].
struct PairWork {
    double friction = 0.0, damping = 0.0;

    PairWork& operator+=(const PairWork& other) {
        friction += other.friction;
        damping += other.damping;
        return *this;
    }
    double total() const { return friction + damping; }  ///< [J]
};

/// Energy dissipated since the start, by interface [J]: of every block, in the interfaces that it leads, which are those with the blocks
/// on top of it (the lower block leads from the first touch on; of two at one height, the one listed first); and between the blocks and
/// the ground. Friction and dashpots only: the sums over all entries are Energy::friction_loss and Energy::damping_loss, to rounding.
struct Losses {
    std::vector<PairWork> block;  ///< as many as blocks
    PairWork ground;

    PairWork total() const {
        PairWork sum = ground;
        for (const PairWork& work : block) sum += work;
        return sum;
    }
};

}  // namespace musim::lsdem
