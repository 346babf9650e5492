#include "lsdem/detail/shared_work.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

#include "lsdem/thread_team.hpp"

using namespace musim::lsdem;
using detail::Share;
using detail::SharedWork;

TEST_CASE("shared work is done once each round, whoever does it") {
    constexpr std::size_t kItems = 1003;
    for (const std::size_t threads : {1U, 2U, 4U}) {
        CAPTURE(threads);
        ThreadTeam team(static_cast<int>(threads));
        // shares as unequal as can be: the first thread has all but one item for each of the others
        std::vector<Share> shares{{0, kItems - (threads - 1)}};
        while (shares.size() < threads) shares.push_back({shares.back().last, shares.back().last + 1});
        SharedWork work;
        work.set(shares);
        std::vector<int> done(kItems, 0);
        for (int round = 1; round <= 50; ++round) {
            work.begin();
            team.run([&](int thread) {
                Share piece;
                while (work.take(static_cast<std::size_t>(thread), piece))
                    for (std::size_t i = piece.first; i < piece.last; ++i) ++done[i];
            });
            for (const int times : done) REQUIRE(times == round);
        }
    }
}

TEST_CASE("a thread does its own share first, then what others have left") {
    SharedWork work;
    work.set({{0, 40}, {40, 80}});
    work.begin();
    std::vector<int> order;
    Share piece;
    while (work.take(1, piece))
        for (std::size_t i = piece.first; i < piece.last; ++i) order.push_back(static_cast<int>(i));
    REQUIRE(order.size() == 80);
    CHECK(order.front() == 40);
    CHECK(order[39] == 79);
    CHECK(order[40] == 0);
    CHECK_FALSE(work.take(0, piece));
}

TEST_CASE("work that is not there is not taken") {
    SharedWork work;
    Share piece;
    CHECK_FALSE(work.take(0, piece));
    work.set({{0, 0}, {0, 0}});
    work.begin();
    CHECK_FALSE(work.take(0, piece));
    CHECK_FALSE(work.take(1, piece));
}
