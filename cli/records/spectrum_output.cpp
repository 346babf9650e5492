#include "cli/records/spectrum_output.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "lsdem/plot/line_plot.hpp"
#include "records/formats/csv_cell.hpp"

namespace musim::cli {
namespace {

const SpectrumColumn* find_column(const SpectrumTable& table, const std::string& key) {
    const auto found =
        std::find_if(table.columns.begin(), table.columns.end(), [&](const SpectrumColumn& column) { return column.key == key; });
    return found == table.columns.end() ? nullptr : &*found;
}

/// Keys of all columns, in the order in which they first occur.
std::vector<std::string> find_keys(const std::vector<SpectrumTable>& tables) {
    std::vector<std::string> keys;
    for (const SpectrumTable& table : tables) {
        for (const SpectrumColumn& column : table.columns) {
            if (std::find(keys.begin(), keys.end(), column.key) == keys.end()) keys.push_back(column.key);
        }
    }
    return keys;
}

std::string percent(double damping) { return fmt::format("{:.4g} %", 100.0 * damping); }

/// Do not all tables have the same `member`?
template <class Member>
bool differ(const std::vector<SpectrumTable>& tables, Member member) {
    return std::any_of(tables.begin(), tables.end(), [&](const SpectrumTable& table) { return table.*member != tables.front().*member; });
}

}  // namespace

nlohmann::json to_json(const std::vector<SpectrumTable>& tables) {
    nlohmann::json object{{"spectra", nlohmann::json::array()}, {"rotd", nlohmann::json::array()}};
    for (const SpectrumTable& table : tables) {
        nlohmann::json spectrum{
            {"file", table.file}, {"component", table.component}, {"damping", table.damping}, {"period_s", table.period}};
        for (const SpectrumColumn& column : table.columns) spectrum[column.key] = column.values;
        object[table.rotated ? "rotd" : "spectra"].push_back(std::move(spectrum));
    }
    return object;
}

void print_table(const SpectrumTable& table) {
    print("{}: {}, damping {}\n{:>12}", table.file, table.component, percent(table.damping), "period [s]");
    for (const SpectrumColumn& column : table.columns) print(" {:>16}", column.title);
    print("\n");
    for (std::size_t i = 0; i < table.period.size(); ++i) {
        print("{:>12.5g}", table.period[i]);
        for (const SpectrumColumn& column : table.columns) print(" {:>16.5g}", column.values[i]);
        print("\n");
    }
}

std::string make_csv(const std::vector<SpectrumTable>& tables) {
    const std::vector<std::string> keys = find_keys(tables);
    std::string text = "file,component,damping,period_s";
    for (const std::string& key : keys) text += "," + key;
    text += "\n";
    for (const SpectrumTable& table : tables) {
        const std::string start = fmt::format("{},{},{}", records::csv_cell(table.file), records::csv_cell(table.component), table.damping);
        std::vector<const SpectrumColumn*> columns;
        columns.reserve(keys.size());
        for (const std::string& key : keys) columns.push_back(find_column(table, key));
        for (std::size_t i = 0; i < table.period.size(); ++i) {
            fmt::format_to(std::back_inserter(text), "{},{}", start, table.period[i]);
            for (const SpectrumColumn* column : columns) text += column != nullptr ? fmt::format(",{}", column->values[i]) : ",";
            text += "\n";
        }
    }
    return text;
}

std::string make_svg(const std::vector<SpectrumTable>& tables) {
    const bool many_files = differ(tables, &SpectrumTable::file), many_dampings = differ(tables, &SpectrumTable::damping);
    lsdem::LinePlot plot{.title = "Pseudo-spectral acceleration",
                         .subtitle = many_dampings ? "" : "damping " + percent(tables.front().damping),
                         .x_label = "period [s]",
                         .y_label = "PSA [g]",
                         .x_logarithmic = true,
                         .y_logarithmic = true};
    for (const SpectrumTable& table : tables) {
        for (const SpectrumColumn& column : table.columns) {
            if (column.curve.empty()) continue;
            std::string label = column.curve;
            if (many_dampings) label += ", " + percent(table.damping);
            // last, because it may be long
            if (many_files && !table.rotated) label += " " + std::filesystem::path(table.file).stem().string();
            plot.series.push_back({.label = label, .x = table.period, .y = column.values});
        }
    }
    return lsdem::make_svg(plot);
}

}  // namespace musim::cli
