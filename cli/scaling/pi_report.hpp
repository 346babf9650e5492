#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scaling/pi/pi_express.hpp"
#include "scaling/text_table.hpp"
#include "scaling/uncertainty/uncertain_groups.hpp"

namespace musim::cli {

/// A product that the user gave, over the groups.
struct ExpressedProduct {
    std::string text;
    std::vector<scaling::Rational> exponents;  ///< one per quantity
    std::vector<scaling::Rational> powers;     ///< one per group
};

/// What `musim pi` has to say.
struct PiReport {
    nlohmann::json problem;  ///< as the file has it
    std::vector<scaling::PiQuantity> quantities;
    scaling::PiBasis basis;
    std::optional<scaling::PiBases> all;
    std::vector<ExpressedProduct> expressed;
    scaling::SampledGroups samples = {};
};

/// The basis of the report, then all others if they are wanted.
std::vector<scaling::PiBasis> list_bases(const PiReport& report);

/// One JSON object: "problem" (which parse_pi_problem() reads back from it), "rank", "groups", "unused", and "repeating", "remarks",
/// "bases", "complete", "expressed". A group has "exponents" (of the quantities it holds), "name" (as recognised, else "Pi_1", ...),
/// "product", "latex", "known" (the names one by one) and, where its quantities have values, "value", and "uncertainty" of it where some
/// are uncertain, with "monte_carlo" if samples were drawn; "uncertainty" of the whole has the inputs. Powers of an expressed product are
/// texts such as "-1/2".
nlohmann::json to_json(const PiReport& report);

/// Groups with names and values, and remarks, uncertainties where there are some: lines of text, tables in Markdown, an align environment
/// of amsmath in LaTeX with one group a line and remarks as comments.
std::string make_pi_report(const PiReport& report, scaling::ReportStyle style);

}  // namespace musim::cli
