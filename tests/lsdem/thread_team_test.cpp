#include "lsdem/thread_team.hpp"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <thread>

using namespace musim::lsdem;

TEST_CASE("every member of a team runs once and has finished when run returns") {
    for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        ThreadTeam team(threads);
        CHECK(team.size() == threads);
        std::array<int, 4> calls{};
        for (int round = 0; round < 200; ++round) {
            team.run([&](int index) { ++calls[static_cast<std::size_t>(index)]; });
            for (int i = 0; i < threads; ++i) REQUIRE(calls[static_cast<std::size_t>(i)] == round + 1);
        }
    }
}

TEST_CASE("a team whose members have gone to sleep wakes up") {
    ThreadTeam team(3);
    std::array<int, 3> calls{};
    for (int round = 1; round <= 3; ++round) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        team.run([&](int index) { ++calls[static_cast<std::size_t>(index)]; });
        CHECK(calls == std::array<int, 3>{round, round, round});
    }
}
