#pragma once

namespace musim::scaling::detail {

/// One function object with the calls of several, for std::visit.
template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace musim::scaling::detail
