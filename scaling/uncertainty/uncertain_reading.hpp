#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scaling/error.hpp"
#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling {

/// The uncertain values of a file and of those that it names. Their reader asks here what to take for each, so that the same files read
/// again with one value moved show what it does to any result, through whatever is made of it on the way.
class UncertainReading {
  public:
    /// `source` is the name of the file in front of places; inputs are named without it.
    explicit UncertainReading(std::string source) : source_(std::move(source)) {}

    /// The value to take at a place: its own, or where it was moved to. The same value read twice at one place is one input; others of that
    /// name get a number.
    double take(const std::string& place, const Uncertain& quantity, const RationalDimension& dimension = {});

    /// In the order in which they were read first.
    const std::vector<UncertainInput>& inputs() const { return inputs_; }

    /// For reading once more, with one input times a factor.
    UncertainReading move(std::size_t input, double factor) const;

    /// For reading once more, with all inputs at drawn values, in their order.
    UncertainReading draw(std::span<const double> values) const;

    /// Whether inputs are away from their values: what compares values with each other was settled when they were read as they are.
    bool is_moved() const { return factor_ != 1.0 || !drawn_.empty(); }

    /// The only input that is; null where all are drawn, or none is moved.
    const UncertainInput* moved_input() const { return factor_ == 1.0 ? nullptr : &inputs_[moved_]; }

    /// An error for drawn values that cannot be.
    SimilitudeError refuse_draw(const std::string& why) const;

  private:
    std::string source_;
    std::vector<UncertainInput> inputs_;
    std::size_t moved_ = 0;
    double factor_ = 1.0;
    std::vector<double> drawn_;
};

/// `read(reading)` with each input of a reading moved, below and above in turn.
template <class Read>
auto read_moved(const UncertainReading& reading, const Read& read) {
    struct Moved {
        decltype(read(std::declval<UncertainReading&>())) below, above;
    };
    std::vector<Moved> moved;
    for (std::size_t i = 0; i < reading.inputs().size(); ++i) {
        UncertainReading below = reading.move(i, 1.0 / kMove), above = reading.move(i, kMove);
        moved.push_back({read(below), read(above)});
    }
    return moved;
}

/// `read(reading)` with all inputs of a reading drawn. From any thread, if `read` is. What it throws becomes a SimilitudeError
/// `SOURCE: a sample of the uncertain values is refused (why); what to do`.
template <class Read>
auto read_drawn(const UncertainReading& reading, std::span<const double> values, const Read& read) {
    UncertainReading drawn = reading.draw(values);
    try {
        return read(drawn);
    } catch (const std::runtime_error& error) {
        throw reading.refuse_draw(error.what());
    }
}

}  // namespace musim::scaling
