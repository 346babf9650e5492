#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/ground_motion.hpp"

/// Parts that all records made of numbers have in common.
namespace musim::records::detail {

/// Throws ProcessingError, naming the kind of record and the setting, unless all values are positive and finite.
void require_positive(std::string_view kind, std::initializer_list<std::pair<std::string_view, double>> settings);

/// Throws ProcessingError unless there are `fewest` to 10^8 steps.
void require_steps(std::string_view kind, double steps, double fewest);

/// Throws ProcessingError when fewer than eight samples fall on a period of the frequency [Hz], both positive. The trapezoid velocity of a
/// sine sampled so is short by (2π/8)²/12 = 5 %, at twice as many samples by 1.3 %.
void require_sampled(std::string_view kind, double frequency, double dt);

/// One acceleration component "1" from time zero; `made` is the line of its history.
GroundMotion make_record(std::string event, std::string made, scaling::Time dt, std::vector<double> samples);

}  // namespace musim::records::detail
