#include "records/detail/transform.hpp"

#include <fftw3.h>

#include <functional>
#include <mutex>

namespace musim::records::detail {
namespace {

/// Makes a plan, runs it, and destroys it; only the running is safe beside other threads.
void run(const std::function<fftw_plan()>& make) {
    static std::mutex planning;
    const fftw_plan plan = [&] {
        const std::lock_guard lock(planning);
        return make();
    }();
    fftw_execute(plan);
    const std::lock_guard lock(planning);
    fftw_destroy_plan(plan);
}

fftw_complex* as_fftw(std::complex<double>* values) {
    return reinterpret_cast<fftw_complex*>(values);
}  // the same layout, by both standards

}  // namespace

Transform::Transform(std::span<const double> samples) : size_(samples.size()), spectrum_(samples.size() / 2 + 1) {
    std::vector<double> in(samples.begin(), samples.end());
    run([&] { return fftw_plan_dft_r2c_1d(static_cast<int>(size_), in.data(), as_fftw(spectrum_.data()), FFTW_ESTIMATE); });
}

std::vector<double> Transform::back() const {
    std::vector<std::complex<double>> in = spectrum_;
    std::vector<double> samples(size_);
    run([&] { return fftw_plan_dft_c2r_1d(static_cast<int>(size_), as_fftw(in.data()), samples.data(), FFTW_ESTIMATE); });
    for (double& sample : samples) sample /= static_cast<double>(size_);
    return samples;
}

}  // namespace musim::records::detail
