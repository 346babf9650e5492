#pragma once

#include <functional>
#include <map>
#include <utility>

namespace musim::scaling {

/// A function of a number whose values are kept: asked for the same number again, it is not called. For one thread.
template <class Value>
class Memoized {
  public:
    explicit Memoized(std::function<Value(double)> function) : function_(std::move(function)) {}

    const Value& operator()(double at) const {
        const auto place = values_.find(at);
        return place != values_.end() ? place->second : values_.emplace(at, function_(at)).first->second;
    }

  private:
    std::function<Value(double)> function_;
    mutable std::map<double, Value> values_;
};

}  // namespace musim::scaling
