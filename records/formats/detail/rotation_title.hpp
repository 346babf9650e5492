#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/sample_unit.hpp"

/// Words by which titles of columns speak of rotations.
namespace musim::records::detail {

/// Words of a title about a rotation; `other` says which quantity words of translations name in it.
struct RotationWords {
    bool is_rotation = false;                     ///< "roll", "rx", "gyro x", "angular velocity"
    bool is_certain = false;                      ///< not "rx", "tilt" and the like, which may stand for something else
    bool is_bearing = false;                      ///< an angle on a map or of a compass: "latitude", "heading"; no motion
    std::optional<SampleQuantity> quantity = {};  ///< angle, its rate or acceleration, where the words say which
};

/// Is one of a title's words in a list of words, each between blanks?
bool has_word(const std::vector<std::string>& words, std::string_view list);

/// Meaning of a title's words, in small letters.
RotationWords read_rotation_words(const std::vector<std::string>& words, std::optional<SampleQuantity> other);

}  // namespace musim::records::detail
