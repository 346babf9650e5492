#include "scaling/pi/pi_express.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scaling/detail/dimension_names.hpp"
#include "scaling/detail/integer_matrix.hpp"
#include "scaling/detail/text_cursor.hpp"
#include "scaling/pi/pi_text.hpp"

namespace musim::scaling {

namespace {

using Exponents = std::vector<Rational>;

/// Longest text that is read [characters]; a bound keeps nested brackets shallow.
constexpr std::size_t kLongestGroup = 1000;

bool is_digit(char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; }

/// Recursive descent over `product := factor {[* / blank] factor}`, `factor := (1 | name | [sqrt] "(" product ")") [^ power]`.
class GroupReader : private detail::TextCursor {
  public:
    GroupReader(std::string_view text, const std::vector<PiQuantity>& quantities)
        : TextCursor(text), text_(text), quantities_(quantities) {}

    Exponents read() {
        if (text_.size() > kLongestGroup) throw PiError("the group is too long; shorten it");
        Exponents product = read_product();
        if (!rest_.empty()) fail("a closing bracket without an opening one");
        return product;
    }

  private:
    [[noreturn]] void fail(std::string_view why) const {
        throw PiError(fmt::format("\"{}\": {}; write a product such as \"v^2/(g*l)\"", text_, why));
    }

    Exponents read_product() {
        Exponents product(quantities_.size());
        bool divide = false;
        skip_blanks();
        while (true) {
            const Exponents factor = read_factor();
            for (std::size_t i = 0; i < product.size(); ++i) product[i] = divide ? product[i] - factor[i] : product[i] + factor[i];
            skip_blanks();
            if (at_end()) return product;
            divide = skip("/");
            if (!divide) skip("*");
            skip_blanks();
        }
    }

    Exponents read_factor() {
        Exponents factor(quantities_.size());
        Rational power = 1;
        const std::size_t name = find_name();
        if (name > 0) {
            factor[find_quantity(quantities_, rest_.substr(0, name))] = 1;
            rest_.remove_prefix(name);
        } else {
            if (skip("sqrt")) {
                skip_blanks();
                power = {1, 2};
                if (!rest_.starts_with('(')) fail("sqrt needs brackets");
            }
            if (skip("(")) {
                factor = read_product();
                if (!skip(")")) fail("a closing bracket is missing");
            } else {
                skip_one();
            }
        }
        skip_blanks();
        if (skip("^") || skip("**")) power = power * read_power();
        for (Rational& exponent : factor) exponent = exponent * power;
        return factor;
    }

    /// Length of the longest name of a quantity at the front; names may hold blanks.
    std::size_t find_name() const {
        std::size_t longest = 0;
        for (const PiQuantity& quantity : quantities_) {
            const std::string& name = quantity.name;
            if (name.size() <= longest || !rest_.starts_with(name)) continue;
            const std::string_view behind = rest_.substr(name.size());
            if (behind.empty() || std::string_view(" \t*/^()").find(behind.front()) != std::string_view::npos) longest = name.size();
        }
        return longest;
    }

    void skip_one() {
        if (rest_.empty()) fail("a factor is missing at the end");
        const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t*/^()"));
        if (word == "1") {
            rest_.remove_prefix(1);
        } else if (word.empty()) {
            fail(fmt::format("unexpected \"{}\"", rest_));
        } else if (is_digit(word.front())) {
            fail(fmt::format("the number {} has no place in a product of powers", word));
        } else {
            find_quantity(quantities_, word);
        }
    }

    std::int64_t read_digits() {
        if (!at_digit()) fail("a power must be a number or a fraction such as ^(1/2)");
        std::int64_t number = 0;
        for (; at_digit(); rest_.remove_prefix(1)) {
            number = 10 * number + (rest_.front() - '0');
            if (number > 1'000'000) fail("the power is too large");
        }
        return number;
    }

    /// 2, -2, 0.5, (1/2), (-1/2).
    Rational read_power() {
        skip_blanks();
        const bool bracketed = skip("(");
        const bool negative = skip("-");
        Rational power = read_digits();
        if (skip(".")) {
            const std::size_t before = rest_.size();
            const std::int64_t decimals = read_digits();
            std::int64_t size = 1;
            for (std::size_t i = rest_.size(); i < before; ++i) {
                size *= 10;
                if (size > 1'000'000) fail("a power has too many digits");
            }
            power = power + Rational(decimals, size);
        }
        if (bracketed && skip("/")) {
            const std::int64_t denominator = read_digits();
            if (denominator == 0) fail("a power is divided by zero");
            power = power / denominator;
        }
        if (bracketed && !skip(")")) fail("a closing bracket is missing");
        return negative ? -power : power;
    }

    std::string_view text_;
    const std::vector<PiQuantity>& quantities_;
};

}  // namespace

std::vector<Rational> parse_group(std::string_view text, const std::vector<PiQuantity>& quantities) {
    return GroupReader(text, quantities).read();
}

std::vector<Rational> express(const std::vector<Rational>& wanted, const std::vector<PiGroup>& groups,
                              const std::vector<PiQuantity>& quantities) {
    const RationalDimension dimension = dimension_of_product(wanted, quantities);
    if (!dimension.is_dimensionless()) {
        throw PiError(fmt::format("{} is not dimensionless: it is {}; correct its exponents", format_group(wanted, quantities),
                                  detail::describe(dimension)));
    }

    // one row per quantity, one column per group, the wanted product (times its denominators) last
    const detail::Integer common = detail::common_denominator(wanted);
    detail::IntegerMatrix matrix;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        detail::IntegerRow row;
        for (const PiGroup& group : groups) row.emplace_back(group[i]);
        row.emplace_back(common / wanted[i].denominator() * wanted[i].numerator());
        matrix.push_back(std::move(row));
    }
    const detail::Echelon echelon = detail::eliminate(std::move(matrix), groups.size() + 1);
    if (echelon.is_pivot(groups.size())) {
        throw PiError(fmt::format("{} is no product of the groups; add one that holds what they lack", format_group(wanted, quantities)));
    }
    const detail::IntegerRow dependence = echelon.kernel_vector(groups.size());
    std::vector<Rational> powers;
    for (std::size_t k = 0; k < groups.size(); ++k) powers.push_back(detail::make_rational(-dependence[k], dependence.back() * common));
    return powers;
}

}  // namespace musim::scaling
