#pragma once

namespace musim::scaling {

/// A factor this near to one is one [-]: some twenty products and roots of doubles, 1e-16 each, stay far below; a real distortion far
/// above.
inline constexpr double kFactorRounding = 1e-12;

}  // namespace musim::scaling
