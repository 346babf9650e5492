#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "scaling/laws/scale_law.hpp"
#include "scaling/laws/similitude.hpp"
#include "tests/benches/similitude_scenes.hpp"

namespace musim::lsdem {

/// Scales by which a similar twin is made of a prototype: by one similitude, or with heights that scale apart from all other lengths.
struct TwinScales {
    scaling::Similitude similitude;  ///< its length is that of widths
    double heights = 1.0;            ///< λ of heights over λ of widths [-]; angles scale by 1/heights
};

/// The scales that a law (scaling/laws/) gives for these factors. Its lengths are l, or else widths b; heights over
/// widths are scaled by 1/tan_alpha, 1 in a law without that quantity. Throws scaling::SimilitudeError as solve_law() and make_similitude()
/// do.
TwinScales make_twin_scales(const std::string& law, const std::vector<scaling::GivenFactor>& given);

/// Group that is set wrong in a model on purpose.
enum class BrokenGroup {
    none,
    friction,   ///< μ
    gravity,    ///< g
    amplitude,  ///< acceleration of the base, its times kept
    duration,   ///< times of the base motion, its accelerations kept
    stiffness,  ///< of all contacts
    density,    ///< of the blocks, contacts as they were
    height,     ///< of the blocks, widths and contacts as they were
};

std::string_view to_string(BrokenGroup group);

/// A quantity of the model over what the law asks for.
struct Break {
    BrokenGroup group = BrokenGroup::none;
    double factor = 1.0;

    /// The factor, where it is this group that is broken; 1 else.
    double of(BrokenGroup which) const { return which == group ? factor : 1.0; }
    /// Are the model's frequencies others than the prototype's, both in units of the base motion?
    bool shifts_frequencies() const;
};

/// The similar twin of a prototype, with one quantity wrong.
Scene make_model_scene(BenchScene scene, const TwinScales& scales, const Break& broken);

}  // namespace musim::lsdem
