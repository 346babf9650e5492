#include "scaling/laws/named_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

namespace musim::scaling {

namespace {

/// Whether a name means a role: one of its names, with a digit or _ behind for an index.
bool names_role(const GroupRole& role, std::string_view name) {
    return std::any_of(role.names.begin(), role.names.end(), [name](std::string_view hint) {
        if (!name.starts_with(hint)) return false;
        const std::string_view index = name.substr(hint.size());
        return index.empty() || index.front() == '_' || std::isdigit(static_cast<unsigned char>(index.front())) != 0;
    });
}

/// An assignment of a group's quantities to the roles of a named group.
struct Match {
    std::vector<std::size_t> quantities;  ///< one per role
    Rational power;                       ///< group = named group^power
    int told_by_name = 0;
    int unsure = 0;
};

/// Tries all assignments and keeps the one with most roles recognized by names.
class Matcher {
  public:
    Matcher(const NamedGroup& named, const std::vector<std::size_t>& held, const std::vector<Rational>& exponents,
            const std::vector<PiQuantity>& quantities)
        : named_(named), held_(held), exponents_(exponents), quantities_(quantities) {}

    std::optional<Match> run() {
        if (named_.roles.size() == held_.size()) assign({});
        return best_;
    }

  private:
    void assign(const Match& match) {
        if (match.quantities.size() == held_.size()) {
            if (!best_ || match.unsure < best_->unsure || (match.unsure == best_->unsure && match.told_by_name > best_->told_by_name)) {
                best_ = match;
            }
            return;
        }
        const GroupRole& role = named_.roles[match.quantities.size()];
        for (const std::size_t j : held_) {
            if (std::find(match.quantities.begin(), match.quantities.end(), j) != match.quantities.end()) continue;
            if (quantities_[j].dimension != role.dimension) continue;
            const Rational power = exponents_[j] / role.exponent;
            if (!match.quantities.empty() && power != match.power) continue;
            const bool is_named = names_role(role, quantities_[j].name);
            if (!is_named && (role.check == RoleCheck::named || (role.check == RoleCheck::hinted && has_namesake(role)))) continue;
            Match longer = match;
            longer.quantities.push_back(j);
            longer.power = power;
            longer.told_by_name += is_named ? 1 : 0;
            longer.unsure += role.check == RoleCheck::hinted && !is_named ? 1 : 0;
            assign(longer);
        }
    }

    /// Whether a quantity of the problem has the role's dimension and name; no other may stand for it then.
    bool has_namesake(const GroupRole& role) const {
        return std::any_of(quantities_.begin(), quantities_.end(),
                           [&](const PiQuantity& q) { return q.dimension == role.dimension && names_role(role, q.name); });
    }

    const NamedGroup& named_;
    const std::vector<std::size_t>& held_;
    const std::vector<Rational>& exponents_;
    const std::vector<PiQuantity>& quantities_;
    std::optional<Match> best_;
};

RecognisedGroup describe(const NamedGroup& named, const Match& match, const std::vector<PiQuantity>& quantities) {
    RecognisedGroup result;
    result.formula = named.formula;
    const bool inverse = match.power.numerator() < 0;
    const Rational size = inverse ? -match.power : match.power;
    const std::string power = power_text(size);
    // of a group whose name is a formula, such as E/(rho*g*l)
    const bool brackets = (inverse || !power.empty()) && named.name.find_first_of("/*^") != std::string::npos;
    result.name = fmt::format("{}{}{}{}{}", inverse ? "1/" : "", brackets ? "(" : "", named.name, brackets ? ")" : "", power);
    std::vector<std::string> stand_ins;
    for (std::size_t k = 0; k < named.roles.size(); ++k) {
        const GroupRole& role = named.roles[k];
        const std::string& name = quantities[match.quantities[k]].name;
        if (role.check == RoleCheck::hinted && !names_role(role, name)) stand_ins.push_back(fmt::format("{} as {}", name, role.symbol));
    }
    result.as = fmt::format("{}", fmt::join(stand_ins, ", "));
    return result;
}

}  // namespace

std::vector<RecognisedGroup> recognise(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities) {
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (exponents[i] != 0) held.push_back(i);
    }
    if (held.empty()) return {};

    // the surest: fewest stand-ins, then most roles recognized by names; the table's order for what is sure
    std::vector<RecognisedGroup> found;
    std::optional<Match> best;
    for (const NamedGroup& named : named_groups()) {
        const std::optional<Match> match = Matcher(named, held, exponents, quantities).run();
        if (!match) continue;
        const auto rank = [](const Match& m) { return std::pair(m.unsure, -m.told_by_name); };
        if (best && (rank(*match) > rank(*best) || (rank(*match) == rank(*best) && best->unsure == 0))) continue;
        if (!best || rank(*match) < rank(*best)) found.clear();
        best = match;
        found.push_back(describe(named, *match, quantities));
    }
    return found;
}

std::vector<RecognisedGroup> recognise(const PiGroup& group, const std::vector<PiQuantity>& quantities) {
    return recognise(std::vector<Rational>(group.begin(), group.end()), quantities);
}

std::string recognised_text(const std::vector<RecognisedGroup>& names) {
    std::vector<std::string> texts;
    texts.reserve(names.size());
    for (const RecognisedGroup& name : names) texts.push_back(name.text());
    return fmt::format("{}", fmt::join(texts, " or "));
}

}  // namespace musim::scaling
