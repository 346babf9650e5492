#pragma once

namespace musim::records::detail {

/// Shortest decimal, of six digits at most, within 1e-8 of a positive `value`, that numbers printed in decimals can mean:
/// 0.00999999999999998 is 0.01. `value` itself when there is none.
double to_short_decimal(double value);

}  // namespace musim::records::detail
