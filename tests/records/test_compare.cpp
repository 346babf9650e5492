#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "records/compare.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("equal histories have no misfit") {
    const std::vector<double> history{1.0, -2.0, 3.0};
    CHECK(compute_misfit(history, history).max_relative == 0.0);
    CHECK(compute_misfit(history, history).rms_relative == 0.0);
}

TEST_CASE("misfits are relative to the largest value and to the rms of the reference") {
    const Misfit misfit = compute_misfit(std::vector<double>{3.0, -4.0}, std::vector<double>{3.0, -3.0});
    CHECK(misfit.max_relative == 0.25);
    CHECK(misfit.rms_relative == relative(0.2, 1e-15));  // 1/5
}

TEST_CASE("a constant factor is its own misfit") {
    std::vector<double> reference;
    std::vector<double> other;
    for (int i = 0; i < 100; ++i) {
        reference.push_back(std::sin(0.3 * i));
        other.push_back(1.01 * reference.back());
    }
    CHECK(compute_misfit(reference, other).max_relative == doctest::Approx(0.01));
    CHECK(compute_misfit(reference, other).rms_relative == doctest::Approx(0.01));
}

TEST_CASE("misfits do not depend on the unit, however small the values") {
    const std::vector<double> reference{1e-200, 3e-200};
    const std::vector<double> other{1e-200, 2e-200};
    CHECK(compute_misfit(reference, other).rms_relative == doctest::Approx(1.0 / std::sqrt(10.0)));
}

TEST_CASE("nothing against nothing agrees, something against nothing does not, and neither does what is not finite") {
    const std::vector<double> zero{0.0, 0.0};
    CHECK(compute_misfit(zero, zero).rms_relative == 0.0);
    CHECK(std::isinf(compute_misfit(zero, std::vector<double>{0.0, 1.0}).max_relative));
    CHECK(std::isinf(compute_misfit(std::vector<double>{1.0, 1.0}, std::vector<double>{1.0, kNan}).rms_relative));
}

TEST_CASE("histories that do not match are refused") {
    CHECK_THROWS_AS(compute_misfit(std::vector<double>{1.0}, std::vector<double>{1.0, 2.0}), ProcessingError);
    CHECK_THROWS_AS(compute_misfit(std::vector<double>{}, std::vector<double>{}), ProcessingError);
    const TimeSeries slow(SampleQuantity::velocity, {}, 0.1 * scaling::si::seconds, {1.0});
    const TimeSeries fast(SampleQuantity::velocity, {}, 0.2 * scaling::si::seconds, {1.0});
    const TimeSeries other(SampleQuantity::acceleration, {}, 0.1 * scaling::si::seconds, {1.0});
    CHECK_THROWS_AS(compute_misfit(slow, fast), ProcessingError);
    CHECK_THROWS_AS(compute_misfit(slow, other), ProcessingError);
    CHECK(compute_misfit(slow, slow).max_relative == 0.0);
}

}  // namespace
}  // namespace musim::records
