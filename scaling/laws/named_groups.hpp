#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling {

/// Check by which a quantity earns a role in a named group.
enum class RoleCheck {
    dimension,  ///< by its dimension: any length is a length
    hinted,     ///< by its name; another name will do where no quantity has this one, but is said to stand for the role
    named,      ///< by its name only: nothing else distinguishes a friction coefficient from another plain number
};

/// A quantity of a named group.
struct GroupRole {
    std::string_view symbol;
    RationalDimension dimension;
    Rational exponent;
    RoleCheck check = RoleCheck::dimension;
    std::vector<std::string_view> names;  ///< that mean this role, as they stand or with a digit or _ behind
};

/// A dimensionless group that has a name.
struct NamedGroup {
    std::string_view name;
    std::string_view formula;
    std::vector<GroupRole> roles;
};

/// All groups that are known by name, the structural ones in the square-root form of groups.hpp (classical Froude and Cauchy numbers are
/// their squares). docs/theory/dimensional_analysis.md lists them with their sources.
const std::vector<NamedGroup>& named_groups();

/// A group under the name people know.
struct RecognisedGroup {
    std::string name;     ///< "Froude", "1/Froude^2", "Mach^(1/2)"
    std::string formula;  ///< of the named group: "v/sqrt(g*l)"
    std::string as;       ///< "a as g" where a quantity stands for a role that its name does not give; else empty

    /// "1/Froude^2 with a as g".
    std::string text() const { return as.empty() ? name : name + " with " + as; }
};

/// Names that fit a group, whatever its power. Every quantity must have the dimension and the exponent, up to one common power, of a role.
/// One name when all roles are sure; the name with most roles recognized by names wins. Several, all with `as`, when none is sure and they
/// are equally good. Empty when nothing fits.
std::vector<RecognisedGroup> recognise(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities);
std::vector<RecognisedGroup> recognise(const PiGroup& group, const std::vector<PiQuantity>& quantities);

/// "Froude^2", "Cauchy^2 with p as E or 1/Euler ...": all of them in one line; empty for none.
std::string recognised_text(const std::vector<RecognisedGroup>& names);

}  // namespace musim::scaling
