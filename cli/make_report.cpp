#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/version.hpp"
#include "lsdem/report/report.hpp"
#include "lsdem/study/picture_file.hpp"
#include "lsdem/study/write_results.hpp"
#include "records/atomic_file.hpp"

namespace musim::cli {
namespace {

namespace reports = lsdem::report;
namespace study = lsdem::study;

struct ReportOptions {
    std::vector<std::string> folders;
    std::string out = "report.html";
    std::string figures;
    std::vector<std::string> formats{"svg"};
    bool json = false;
};

/// Every plot as files of its own, its data beside it; their names.
std::vector<std::string> write_figures(const std::vector<reports::ReportSection>& sections, const ReportOptions& options) {
    study::ResultFolder folder(options.figures);
    std::vector<std::string> names;
    for (const reports::ReportSection& section : sections) {
        for (const reports::ReportFigure& figure : section.figures) {
            for (const std::string& format : options.formats) {
                names.push_back(figure.name + "." + format);
                folder.add_text(names.back(), study::make_picture_bytes(figure.svg, format));
            }
            if (figure.csv.empty()) continue;
            names.push_back(figure.name + ".csv");
            folder.add_text(names.back(), figure.csv);
        }
    }
    folder.commit();
    return names;
}

int run_report(const ReportOptions& options) {
    for (const std::string& format : options.formats) study::require_picture_name("figure." + format);
    const reports::ReportContent content = reports::read_content({options.folders.begin(), options.folders.end()});
    const std::vector<reports::ReportSection> sections = reports::make_sections(content);
    const std::string page = reports::make_page(content, sections, kVersion);
    records::write_file_atomically(options.out, page);
    std::vector<std::string> figures;
    if (!options.figures.empty()) figures = write_figures(sections, options);
    if (options.json) {
        nlohmann::json titles = nlohmann::json::array();
        for (const reports::ReportSection& section : sections) titles.push_back(section.title);
        print_json({{"report", options.out},
                    {"bytes", page.size()},
                    {"runs", content.runs.size()},
                    {"sections", titles},
                    {"remarks", content.remarks},
                    {"figures", figures}});
        return kDone;
    }
    print("{}: {} runs, {:.3g} MB\n", options.out, content.runs.size(), 1e-6 * static_cast<double>(page.size()));
    for (const std::string& remark : content.remarks) note("musim: note: {}\n", remark);
    if (!figures.empty()) print("{} files in {}\n", figures.size(), options.figures);
    return kDone;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<ReportOptions>();
    CLI::App* command = app.add_subcommand("report", "Everything that was run, on one page for a browser, without network");
    command->add_option("directory", options->folders, "Directories of `musim run`, `pair`, `sequence` or `ensemble` (-o)")
        ->required()
        ->type_name("DIR");
    command->add_option("-o,--out", options->out, "The page")->capture_default_str()->type_name("FILE.html");
    CLI::Option* figures =
        command->add_option("--figures", options->figures, "Directory for every plot as a file of its own, with its data as CSV")
            ->type_name("OUT");
    command->add_option("--format", options->formats, "Kinds of these files")
        ->delimiter(',')
        ->default_str("svg")
        ->check(CLI::IsMember({"svg", "pdf", "png"}))
        ->needs(figures);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim report out/tower -o tower.html\n"
        "  musim report out/pair -o pair.html --figures out/figures --format pdf,svg\n"
        "  musim report out/wood out/concrete -o both.html\n"
        "Verdict first, then what was run, scales and groups, the blocks in 3D (with frames: \"output\": {\"frame_rate\": \"100 Hz\"} in "
        "the\n"
        "scene), motion of the spine, speeds, profiles, energies. What is missing is told, and the rest shown.");
    command->callback([&action, options] { action = [options] { return run_report(*options); }; });
}

}  // namespace musim::cli
