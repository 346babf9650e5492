#pragma once

#include <Eigen/Core>
#include <vector>

namespace musim::lsdem {

/// Mean and standard deviation of several quantities over a sample, one member at a time (Welford's sums: no cancellation where the scatter
/// is far below the mean). The order of the members changes the last bits; whoever wants the same bits keeps it.
class SampleMoments {
  public:
    explicit SampleMoments(Eigen::Index quantities) : mean_(Eigen::ArrayXd::Zero(quantities)), squares_(mean_) {}

    /// One member's values; as many as there are quantities.
    void add(const Eigen::ArrayXd& values);

    int count() const { return count_; }
    /// Means; NaN without members.
    Eigen::ArrayXd mean() const;
    /// Standard deviations of the population that the members are drawn from: √(Σ (x − mean)²/(n − 1)); NaN with fewer than two members.
    Eigen::ArrayXd sd() const;

  private:
    int count_ = 0;
    Eigen::ArrayXd mean_;     ///< so far
    Eigen::ArrayXd squares_;  ///< Σ (x − mean)²
};

/// Moments of a sample of one quantity.
SampleMoments moments_of(const std::vector<double>& sample);

}  // namespace musim::lsdem
