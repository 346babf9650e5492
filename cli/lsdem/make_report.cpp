#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/version.hpp"
#include "lsdem/plot/picture_file.hpp"
#include "lsdem/report/report.hpp"
#include "lsdem/results/write_results.hpp"
#include "records/atomic_file.hpp"

namespace musim::cli {
namespace {

struct ReportOptions {
    std::vector<std::string> places;
    RecordSourceOptions source;
    std::string out = "report.html";
    std::string figures;
    std::vector<std::string> formats{"svg"};
    bool json = false;
};

/// Every plot as files of its own, its data beside it; their names.
std::vector<std::string> write_figures(const std::vector<lsdem::ReportSection>& sections, const ReportOptions& options) {
    lsdem::ResultFolder folder(options.figures);
    std::vector<std::string> names;
    for (const lsdem::ReportSection& section : sections) {
        for (const lsdem::ReportFigure& figure : section.figures) {
            for (const std::string& format : options.formats) {
                names.push_back(figure.name + "." + format);
                folder.add_text(names.back(), lsdem::make_picture_bytes(figure.svg, format));
            }
            if (figure.csv.empty()) continue;
            names.push_back(figure.name + ".csv");
            folder.add_text(names.back(), figure.csv);
        }
    }
    folder.commit();
    return names;
}

/// "3 runs", "1 specimen, 2 records".
std::string count_contents(const lsdem::ReportContent& content) {
    std::string text;
    const auto add = [&](std::size_t number, const char* name) {
        if (number > 0) text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", number, name, number == 1 ? "" : "s");
    };
    add(content.runs.size(), "run");
    add(content.specimens.size(), "specimen");
    add(content.records.size(), "record");
    add(content.documents.size(), "document");
    return text.empty() ? "no run" : text;
}

int run_report(const ReportOptions& options) {
    if (const std::string kind = find_extension(options.out); can_be_lost(options.out) && kind != "html" && kind != "htm") {
        throw CLI::ValidationError("--out", options.out + ": a page is HTML; name a file that ends in .html");
    }
    refuse_overwriting(options.places, {options.out});
    for (const std::string& format : options.formats) lsdem::require_picture_name("figure." + format);
    const lsdem::ReportContent content =
        lsdem::read_content({options.places.begin(), options.places.end()},
                            [&](const std::filesystem::path& file) { return options.source.load(file.string()); });
    const std::vector<lsdem::ReportSection> sections = lsdem::make_sections(content);
    const std::string page = lsdem::make_page(content, sections, kVersion);
    records::write_file_atomically(options.out, page);
    std::vector<std::string> figures;
    if (!options.figures.empty()) figures = write_figures(sections, options);
    if (options.json) {
        nlohmann::json titles = nlohmann::json::array();
        for (const lsdem::ReportSection& section : sections) titles.push_back(section.title);
        print_json({{"report", options.out},
                    {"bytes", page.size()},
                    {"runs", content.runs.size()},
                    {"specimens", content.specimens.size()},
                    {"records", content.records.size()},
                    {"documents", content.documents.size()},
                    {"sections", titles},
                    {"remarks", content.remarks},
                    {"figures", figures}});
        return kDone;
    }
    print("{}: {}, {:.3g} MB\n", options.out, count_contents(content), 1e-6 * static_cast<double>(page.size()));
    for (const std::string& remark : content.remarks) note("musim: note: {}\n", remark);
    if (!figures.empty()) print("{} files in {}\n", figures.size(), options.figures);
    return kDone;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<ReportOptions>();
    CLI::App* command = app.add_subcommand("report", "Everything that was run, on one page for a browser, without network");
    command
        ->add_option(
            "places", options->places,
            "Directories of `musim run`, `pair`, `sequence`, `ensemble` or `specimen` (-o); files: specimens, records, what a command "
            "printed with --json")
        ->required()
        ->type_name("DIR|FILE");
    command->add_option("-o,--out", options->out, "The page")->capture_default_str()->type_name("FILE.html");
    CLI::Option* figures =
        command->add_option("--figures", options->figures, "Directory for every plot as a file of its own, with its data as CSV")
            ->type_name("OUT");
    command->add_option("--format", options->formats, "Kinds of these files")
        ->delimiter(',')
        ->default_str("svg")
        ->check(one_of({"svg", "pdf", "png"}))
        ->needs(figures);
    options->source.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim report out/tower -o tower.html\n"
        "  musim report out/pair -o pair.html --figures out/figures --format pdf,svg\n"
        "  musim report out/wood out/concrete -o both.html\n"
        "  musim report specimens -o specimens.html\n"
        "  musim scale --length 1/107 --friction 0.63/0.59 --json > scale.json; musim report scale.json CICLC.v1 -o plan.html\n"
        "Verdict first, then the blocks in 3D (with frames: \"output\": {\"frame_rate\": \"100 Hz\"} in the scene), scales and groups,\n"
        "motion of the spine, profiles, speeds, energies, the motion of the base, and what was run. What is missing is named, and\n"
        "the rest shown.");
    command->callback([&action, options] { action = [options] { return run_report(*options); }; });
}

}  // namespace musim::cli
