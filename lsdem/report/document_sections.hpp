#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_section.hpp"

namespace musim::lsdem {

/// What musim scale, pi, design, record and others printed with --json: everything in it, as tables.
ReportSection make_document_section(const ReportedDocument& document, std::size_t number);

/// How distorted the document's model is; that the document was read, if it has none.
std::string make_document_verdict(const ReportedDocument& document);

/// Any JSON as tables: an object's plain values under `caption`, lists of objects with a column per key, what is inside below under
/// captions of its own.
std::string to_html(const nlohmann::json& json, const std::string& caption);

}  // namespace musim::lsdem
