#pragma once

#include <filesystem>
#include <vector>

#include "lsdem/run/use_record.hpp"
#include "tests/benches/accuracy_setting.hpp"

namespace musim::lsdem {

/// Motion of the top of the mini-tower in one part of the earthquake: velocity along x, relative to the base, mean of the top course, at
/// even times [m/s]; short when the run diverged.
using TopVelocity = std::vector<double>;

/// All parts.
struct TopMotion {
    std::vector<TopVelocity> parts;
    AccuracyOutcome cost;  ///< its error is unused
};

/// Root mean square difference of two motions over the root mean square of `reference`, over all parts, up to 0.24 s of the prototype's
/// time in each; infinite when one diverged [-].
double compare_tops(const TopMotion& motion, const TopMotion& reference);

/// Root mean square, over the parts, of the difference of the peaks over that of `reference`; infinite when one diverged [-].
double compare_peaks(const TopMotion& motion, const TopMotion& reference);

/// Courses of the papers' tower.
inline constexpr int kMiniTowerCourses = 38;

/// A tower as high as the papers' (38 courses of wood at 1:107) but narrow: a wall in running bond, three blocks long, that starts at rest
/// under its weight and is shaken along its length by the strongest parts of an earthquake, each on its own. For settings without a closed
/// form, against a run with fine ones.
class MiniTower {
  public:
    /// `record`: file of the earthquake at prototype scale, brought to 1:107 by the mu law; empty: the built-in synthetic one.
    /// `components`: along x; none: the strongest horizontal one. `courses`: 38, fewer for a quick look.
    /// Throws records::ReadError, records::ProcessingError, SceneError.
    MiniTower(const std::filesystem::path& record, const AxisComponents& components, int courses = kMiniTowerCourses);

    /// Runs 0.4 s of the prototype's time around each of the highest peaks of acceleration, 0.15 s of them before it. With `copy` every
    /// block starts one unit in the last place off, see make_moved_copy.
    TopMotion run(const AccuracySetting& setting, bool copy = false) const;

    const std::string& description() const { return description_; }  ///< of the earthquake

  private:
    int courses_;
    std::string description_;
    std::vector<BaseComponent> motions_;
    double duration_ = 0.0;  ///< [s]
};

}  // namespace musim::lsdem
