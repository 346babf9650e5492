#pragma once

#include <string>

namespace musim::records {

/// A cell of a CSV file; quoted where a comma, a quote or a line end would part it [RFC 4180].
std::string csv_cell(const std::string& text);

}  // namespace musim::records
