#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"

/// A second scene beside a first: the same structure, perhaps with an error in it, or another one. See docs/theory/comparison.md, "Two
/// scenes".
namespace musim::lsdem {

/// A block is the same one, at the same place, when no edge and no coordinate of its centre differs by more than this part of the cube root
/// of its volume [-]: far more than any error that is looked for, and less than any other block or place. Decides how a pair is judged.
inline constexpr double kSameBlock = 0.1;

/// Heights count as drawn anew when those of more than half of the blocks change otherwise than all together, by more than the larger of
/// these: a part of the height, less than workshops make; and a part of the scatter of the heights themselves [-]. Likewise.
inline constexpr double kDrawnHeight = 1e-5, kDrawnScatter = 0.1;

/// Why the blocks of a second specimen, as drawn, are not those of the first: "block 3 is at another place"; nothing when they are, one by
/// one in the order of both.
std::optional<std::string> find_other_blocks(const Specimen& first, const Specimen& second);

/// The same of scenes, which also differ where heights are drawn from another seed. Throws as make_upright_specimen.
std::optional<std::string> find_other_structure(const Scene& first, const Scene& second);

/// A key in which two scenes differ.
struct SceneDifference {
    std::string key;            ///< "/material/friction"
    std::string first, second;  ///< the values, in SI units, as JSON; empty: the key is not there
};

/// Keys of two scenes that differ by more than rounding of units and fractions (kFactorRounding). Names, output and duration are left out:
/// a pair takes the first scene's. Files differ when their contents do. Throws records::ReadError for a file that cannot be read.
std::vector<SceneDifference> find_scene_differences(const Scene& first, const Scene& second);

/// A model that is a scene of its own, in words.
struct SecondScene {
    std::string file;                               ///< as messages name it
    std::string way;                                ///< how it is judged, and why, in a sentence that begins with the file
    bool same_structure = false;                    ///< in the same units, and compared as such
    std::vector<SceneDifference> differences = {};  ///< from the prototype's, of the same structure

    /// Is it the prototype's scene, to rounding?
    bool is_prototype() const { return same_structure && differences.empty(); }
    std::string describe_differences() const;  ///< in a sentence
};

}  // namespace musim::lsdem
