#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scaling/detail/law_inputs.hpp"

namespace musim::scaling::detail {

/// value · Π (x_i/value of x_i)^power_i.
struct Term {
    double value = 0.0;
    Powers powers;

    /// At ln(x_i/value of x_i).
    double sample(const std::vector<double>& logs) const;
};

/// A product, or a difference of two.
struct Row {
    std::string name;
    Term plus;
    std::optional<Term> minus;

    double sample(const std::vector<double>& logs) const { return plus.sample(logs) - (minus ? minus->sample(logs) : 0.0); }
};

/// What is asked of a law, a row each. Positions are those of all().
class LawRows {
  public:
    /// Both must outlive this.
    LawRows(const SolvedLaw& solved, const LawInputs& inputs) : solved_(solved), inputs_(inputs) {}

    /// Nothing while the factor is open.
    std::optional<std::size_t> add_factor(const std::string& name, const ScaleFactor& factor);

    std::size_t add(Row row);

    /// δ of a product with what is solved of motion at its value; nothing where there is none of it, or where δ is open.
    std::optional<std::size_t> add_shaken(const ScaleProduct& product, const ScaleFactor& delta);

    /// A factor that is settled.
    Term make_term(const ScaleFactor& factor) const { return {*factor.value, inputs_.of_factors(factor.exponents)}; }

    /// A factor times a value of the prototype.
    Term times_value(const Term& term, std::size_t quantity) const;

    const std::vector<Row>& all() const { return rows_; }

  private:
    const SolvedLaw& solved_;
    const LawInputs& inputs_;
    std::vector<Row> rows_;
};

}  // namespace musim::scaling::detail
