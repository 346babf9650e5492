#pragma once

#include <optional>

#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// A specimen before it runs.
struct LaidSpecimen {
    Specimen specimen;              ///< without settling: its runs start as it is
    std::optional<Rest> rest = {};  ///< how it came to rest; nothing when it was not to
};

/// Lays the specimen of a scene and lets it come to rest, when the scene asks for that. To let every image of it come to rest again would
/// be a choice on rounding: they start from it unchanged. With settings.checkpoint it is kept in that file once it is laid, and found there
/// again, or laid on from where it was. Throws as make_specimen and read_checkpoint do.
LaidSpecimen lay_specimen(const Scene& scene, RunSettings settings = {});

}  // namespace musim::lsdem
