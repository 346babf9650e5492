#include "records/formats/detail/rotation_title.hpp"

#include <algorithm>
#include <string_view>

namespace musim::records::detail {
namespace {

// lists of words in small letters, between blanks
constexpr std::string_view kRateWords =
    " gyro gyros gyroscope gyrox gyroy gyroz gyr gyrx gyry gyrz omega omegax omegay omegaz drehrate angrate rotrate ";
constexpr std::string_view kAngularWords = " angular rotation rotations rotational ";
constexpr std::string_view kAngleWords = " angle angles winkel angulo ";
constexpr std::string_view kAxisWords = " roll pitch yaw ";
constexpr std::string_view kUncertainWords = " rx ry rz rotx roty rotz rot theta thetax thetay thetaz tilt tiltx tilty tiltz ";
constexpr std::string_view kRates = " rate rates ";
constexpr std::string_view kBearings = " latitude longitude lat lon gps heading bearing course azimuth compass wind ";

}  // namespace

bool has_word(const std::vector<std::string>& words, std::string_view list) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return !word.empty() && list.find(' ' + word + ' ') != std::string_view::npos; });
}

RotationWords read_rotation_words(const std::vector<std::string>& words, std::optional<SampleQuantity> other) {
    const bool is_rate = has_word(words, kRateWords), is_angular = has_word(words, kAngularWords) || has_word(words, kAxisWords);
    const bool is_angle = has_word(words, kAngleWords);
    RotationWords found{.is_bearing = has_word(words, kBearings)};
    found.is_certain = is_rate || is_angular;
    // "acc_rot" is an acceleration in turned axes
    found.is_rotation = found.is_certain || (!other && (is_angle || has_word(words, kUncertainWords)));
    if (!found.is_rotation) return found;
    if (is_angle) {
        found.quantity = SampleQuantity::angle;
    } else if (other == SampleQuantity::acceleration) {
        found.quantity = SampleQuantity::angular_acceleration;
    } else if (is_rate || other == SampleQuantity::velocity || has_word(words, kRates)) {
        found.quantity = SampleQuantity::angular_velocity;
    }
    return found;
}

}  // namespace musim::records::detail
