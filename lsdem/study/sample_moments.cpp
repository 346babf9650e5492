#include "lsdem/study/sample_moments.hpp"

#include <limits>
#include <stdexcept>

namespace musim::lsdem {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void SampleMoments::add(const Eigen::ArrayXd& values) {
    if (values.size() != mean_.size()) throw std::invalid_argument("sample moments: a member has another number of values");
    ++count_;
    const Eigen::ArrayXd before = values - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (values - mean_);
}

Eigen::ArrayXd SampleMoments::mean() const { return count_ > 0 ? mean_ : Eigen::ArrayXd::Constant(mean_.size(), kNothing); }

Eigen::ArrayXd SampleMoments::sd() const {
    if (count_ < 2) return Eigen::ArrayXd::Constant(mean_.size(), kNothing);
    return (squares_ / static_cast<double>(count_ - 1)).sqrt();
}

SampleMoments moments_of(const std::vector<double>& sample) {
    SampleMoments moments(1);
    for (const double value : sample) moments.add(Eigen::ArrayXd::Constant(1, value));
    return moments;
}

}  // namespace musim::lsdem
