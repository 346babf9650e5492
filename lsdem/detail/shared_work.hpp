#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace musim::lsdem::detail {

/// Items in a row, [first, last).
struct Share {
    std::size_t first = 0, last = 0;
};

/// Work in shares, one for each thread, taken piece by piece: a thread that is done with its own goes on with what others have left. Who
/// does what then depends on how fast they are, so only items whose results lie apart may be shared.
class SharedWork {
  public:
    /// Not while threads take pieces.
    void set(std::vector<Share> shares) {
        shares_ = std::move(shares);
        next_ = std::vector<Next>(shares_.size());
        std::size_t items = 0;
        for (const Share& share : shares_) items += share.last - share.first;
        piece_ = std::max<std::size_t>(1, items / (kPieces * std::max<std::size_t>(1, shares_.size())));
    }

    /// All is to be done, again. Not while threads take pieces.
    void begin() {
        for (std::size_t i = 0; i < shares_.size(); ++i) next_[i].item.store(shares_[i].first, std::memory_order_relaxed);
    }

    /// The next piece for a thread, its own first; false when all are taken.
    bool take(std::size_t thread, Share& piece) {
        for (std::size_t i = 0; i < shares_.size(); ++i) {
            const std::size_t of = (thread + i) % shares_.size();
            const std::size_t last = shares_[of].last;
            if (next_[of].item.load(std::memory_order_relaxed) >= last) continue;
            const std::size_t first = next_[of].item.fetch_add(piece_, std::memory_order_relaxed);
            if (first >= last) continue;
            piece = {first, std::min(first + piece_, last)};
            return true;
        }
        return false;
    }

  private:
    /// Pieces of a share: a thread waits for a part of one at most. Affects speed only.
    static constexpr std::size_t kPieces = 16;
    /// Each on a cache line of its own, as every thread writes to its own most of the time.
    struct alignas(64) Next {
        std::atomic<std::size_t> item{0};
    };

    std::vector<Share> shares_;
    std::vector<Next> next_;
    std::size_t piece_ = 1;
};

}  // namespace musim::lsdem::detail
