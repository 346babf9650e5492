#include "lsdem/run/joined_progress.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "lsdem/run/shared_progress.hpp"

using namespace musim::lsdem;

TEST_CASE("several preparations with their runs are one scale that never falls") {
    JoinedProgress progress;
    progress.begin_part(0.25);
    CHECK(progress.after_preparing(0.5) == doctest::Approx(0.125));
    CHECK(progress.after_running(0.5) == doctest::Approx(0.1875));
    // half of the runs, which are half of a quarter
    CHECK(progress.of_all(0.5) == doctest::Approx(0.0625));
    CHECK(progress.after_running(1.0) == doctest::Approx(0.25));
    progress.begin_part(0.75);
    CHECK(progress.after_preparing(0.0) == doctest::Approx(0.25));
    // what was prepared before the first part counts no more
    CHECK(progress.after_running(0.5) == doctest::Approx(0.625));
    CHECK(progress.after_running(0.4) == doctest::Approx(0.625));
}

TEST_CASE("a job of twice the work is twice of the progress") {
    double given = 0.0;
    const std::function<void(double)> report = [&](double part) { given = part; };
    detail::SharedProgress progress({1.0, 2.0, 0.0}, report);
    progress.update(1, 1.0);
    CHECK(given == doctest::Approx(2.0 / 3.0));
    progress.update(2, 1.0);
    CHECK(given == doctest::Approx(2.0 / 3.0));
}
