#include "lsdem/report/report_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "lsdem/report/json_parts.hpp"
#include "lsdem/report/record_figure.hpp"
#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/run/watched_folder.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair.hpp"
#include "records/error.hpp"
#include "scaling/error.hpp"
#include "scaling/json_text.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// JSON of a file; null when it is none.
nlohmann::json read_json(const fs::path& file) {
    try {
        return scaling::parse_json_text(scaling::read_regular_file(file).value_or(""));
    } catch (const scaling::ParseError&) {
        return nullptr;
    }
}

std::string describe_material(const BlockMaterial& material) {
    return fmt::format("{}, k_n {}, k_s {}, μ {:.4g}, e {:.4g}", scaling::format_quantity(material.density, 4),
                       scaling::format_quantity(material.normal_stiffness, 4), scaling::format_quantity(material.shear_stiffness, 4),
                       material.friction, material.restitution);
}

void take_scene(ReportedRun& reported) {
    try {
        const Scene scene = parse_scene(reported.run.scene);
        reported.scene_name = scene.name;
        reported.material = describe_material(scene.material);
    } catch (const std::runtime_error&) {
        // the scene of another version; what it made is shown all the same
    }
}

/// A reading in progress.
class Reader {
  public:
    ReportContent content;

    explicit Reader(const RecordReader& read_record) : read_record_(read_record) {}

    /// Does what may fail, and remarks why it does; did it succeed?
    template <class Error = ResultError, class Attempt>
    bool attempt(const Attempt& job, const std::string& about = "") {
        try {
            job();
            return true;
        } catch (const Error& error) {
            content.remarks.push_back(about + error.what());
            return false;
        }
    }

    /// JSON that a command has written to be read back; empty, with a remark, when it is damaged.
    nlohmann::json read_object(const fs::path& file) {
        nlohmann::json object = nlohmann::json::object();
        attempt([&] { object = read_checked_json(file); });
        return object;
    }

    void add_run(const fs::path& folder, const std::string& label) {
        ReportedRun reported{.label = label, .folder = folder};
        if (!attempt<std::runtime_error>([&] { reported.run = read_run(folder, Reading::what_there_is); })) return;
        content.remarks.insert(content.remarks.end(), reported.run.gaps.begin(), reported.run.gaps.end());
        if (reported.run.is_status_known) reported.summary = read_object(folder / "summary.json");
        attempt<std::runtime_error>([&] { reported.response = measure_response(reported.run); },
                                    label + ": no speeds, rotations and damage: ");
        take_scene(reported);
        if (reported.run.frames.time.empty()) {
            content.remarks.push_back(
                fmt::format("{}: the run has kept no frames, so blocks are shown at its start and end only; \"output\": "
                            "{{\"frame_rate\": \"100 Hz\"}} in its scene keeps them",
                            label));
        }
        content.runs.push_back(std::move(reported));
    }

    /// Model of a pair. Its scale stands in its summary; without it the model's curves would be drawn at the prototype's.
    void add_model(const fs::path& folder, const std::string& label) {
        const std::size_t before = content.runs.size();
        add_run(folder, label);
        if (content.runs.size() == before || content.runs.back().run.is_status_known) return;
        content.runs.pop_back();
        content.remarks.push_back(fmt::format("{}: left out, its scale is not known without summary.json", label));
    }

    void add_pair(const fs::path& folder) {
        content.kind = ReportKind::pair;
        content.summary = read_object(folder / "pair.json");
        add_run(folder / "prototype", "prototype");
        for (const nlohmann::json& model : find_list(content.summary, "pairs")) {
            const std::string label = find_text(model, "label");
            if (!label.empty()) add_model(folder / name_folder(label), label);
        }
        // the largest first: the prototype, then models as they get smaller
        std::stable_sort(content.runs.begin(), content.runs.end(),
                         [](const ReportedRun& a, const ReportedRun& b) { return a.run.similitude.length() > b.run.similitude.length(); });
    }

    void add_sequence(const fs::path& folder) {
        content.kind = ReportKind::sequence;
        content.summary = read_object(folder / "sequence.json");
        for (const nlohmann::json& stage : find_list(content.summary, "stages")) {
            const std::string name = find_text(stage, "folder");
            if (!name.empty()) add_run(folder / name, name);
        }
    }

    void add_ensemble(const fs::path& folder, const std::string& label) {
        content.kind = ReportKind::ensemble;
        ReportedEnsemble ensemble{.label = label, .folder = folder, .summary = read_object(folder / "ensemble.json")};
        attempt([&] { ensemble.bands = read_bands(folder); }, label + ": no bands: ");
        for (const nlohmann::json& member : find_list(ensemble.summary, "members")) {
            const fs::path results = folder / "members" / find_text(member, "name");
            if (find_text(member, "status", "failed") == "failed") continue;
            if (!fs::exists(results / "summary.json")) {
                content.remarks.push_back(fmt::format("{}: the results are gone; run the ensemble again", results.string()));
            } else if (content.runs.empty()) {
                add_run(results, results.filename().string());
            }
        }
        if (content.runs.empty()) {
            content.remarks.push_back(fmt::format("{}: no member has results; run the ensemble again", folder.string()));
        }
        content.ensembles.push_back(std::move(ensemble));
    }

    /// One pair or sequence has a report to itself; ensembles stand beside each other.
    bool has_room(const fs::path& folder, ReportKind kind) {
        if (content.runs.empty() && content.kind == ReportKind::nothing) return true;
        if (kind == ReportKind::ensemble && content.kind == kind) return true;
        content.remarks.push_back(fmt::format(
            "{}: left out: a pair, a sequence or ensembles have a page to themselves; make another report of it", folder.string()));
        return false;
    }

    void add_specimen(const fs::path& file) {
        attempt([&] { content.specimens.push_back({.label = file.stem().string(), .specimen = read_specimen(file)}); });
    }

    void add_document(const fs::path& file) {
        nlohmann::json document = read_json(file);
        if (document.is_object() && document.contains("checksum") && !agrees_with_checksum(document)) {
            content.remarks.push_back(fmt::format("{}: is damaged (its checksum does not match); make it again", file.string()));
        } else if (document.is_object()) {
            content.documents.push_back({.label = file.filename().string(), .json = std::move(document)});
        } else {
            content.remarks.push_back(fmt::format(
                "{}: holds no JSON object (it is damaged, or of another program); give JSON that musim has written", file.string()));
        }
    }

    void add_record(const fs::path& file) {
        attempt<records::ReadError>([&] {
            records::GroundMotion motion = read_record_(file);
            motion.source = file.filename().string();
            content.records.push_back({.label = motion.source, .motion = std::move(motion)});
        });
    }

    /// A file of a folder of results stands for the folder.
    void add_file(const fs::path& file) {
        const std::string name = file.filename().string();
        for (const char* part : {"result.h5", "result.xdmf", "summary.json", "pair.json", "sequence.json", "ensemble.json"}) {
            if (name == part) return add_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
        }
        if (file.extension() == ".h5") return add_specimen(file);
        if (file.extension() == ".json") return add_document(file);
        add_record(file);
    }

    void add(const fs::path& place) {
        if (fs::is_regular_file(place)) return add_file(place);
        add_folder(place);
    }

  private:
    void add_folder(const fs::path& folder) {
        const std::string label = folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
        const bool unfinished = note_unfinished(folder);
        if (!attempt([&] { require_complete(folder); })) return;
        if (fs::exists(folder / "pair.json")) return has_room(folder, ReportKind::pair) ? add_pair(folder) : void();
        if (fs::exists(folder / "sequence.json")) return has_room(folder, ReportKind::sequence) ? add_sequence(folder) : void();
        if (fs::exists(folder / "ensemble.json")) return has_room(folder, ReportKind::ensemble) ? add_ensemble(folder, label) : void();
        if (fs::exists(folder / "summary.json") || fs::exists(folder / "result.h5")) {
            const bool alone = content.kind != ReportKind::nothing;
            return alone && !has_room(folder, ReportKind::run) ? void() : add_run(folder, label);
        }
        if (!fs::exists(folder)) {
            content.remarks.push_back(fmt::format("{}: there is no such folder or file; give a directory of results", folder.string()));
            return;
        }
        const std::vector<fs::path> specimens = find_specimens(folder);
        for (const fs::path& specimen : specimens) add_specimen(specimen);
        if (specimens.empty() && !unfinished) {
            content.remarks.push_back(
                fmt::format("{}: there are no results of a run, pair, sequence or ensemble and no specimens here; give a folder that "
                            "has some",
                            folder.string()));
        }
    }

    static std::vector<fs::path> find_specimens(const fs::path& folder) {
        std::vector<fs::path> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() == ".h5" && entry.path().filename().string().starts_with("specimen-")) {
                found.push_back(entry.path());
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    /// Is anybody at work there, or was?
    bool note_unfinished(const fs::path& folder) {
        const WatchedFolder watched = look_into(folder);
        if (watched.state == FolderState::working) {
            content.remarks.push_back(fmt::format("{}: a musim works here now; what is shown is older", folder.string()));
        }
        if (watched.state != FolderState::killed) return watched.state == FolderState::working;
        std::string text = fmt::format("{}: a run was killed here before it had results", folder.string());
        for (const WatchedRun& run : watched.runs) text += fmt::format(", at {:.0f} %", 100.0 * run.state.fraction);
        content.remarks.push_back(text + "; it can be resumed");
        return true;
    }

    const RecordReader& read_record_;
};

/// Title of inputs that were not run.
std::string make_title_without_runs(const ReportContent& content) {
    const std::size_t many = content.specimens.size() + content.records.size() + content.documents.size();
    if (many == 0) return "nothing";
    const std::string first = !content.specimens.empty() ? content.specimens.front().label
                              : !content.records.empty() ? make_title(content.records.front().motion)
                                                         : content.documents.front().label;
    return many == 1 ? first : fmt::format("{} and {} more", first, many - 1);
}

std::string make_title(const ReportContent& content) {
    std::string name = content.runs.empty() || content.runs.front().scene_name.empty() ? "a run" : content.runs.front().scene_name;
    switch (content.kind) {
        case ReportKind::pair:
            return name + ": prototype and models";
        case ReportKind::sequence:
            return name + ": one motion after another";
        case ReportKind::ensemble:
            return content.ensembles.size() == 1 ? name + ": ensemble" : fmt::format("{} ensembles", content.ensembles.size());
        case ReportKind::runs:
            return fmt::format("{} and {} more", name, content.runs.size() - 1);
        case ReportKind::nothing:
            return make_title_without_runs(content);
        case ReportKind::run:
            break;
    }
    return name;
}

/// Runs of the same name in different folders are distinguished by their whole paths.
void distinguish(std::vector<ReportedRun>& runs) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string label = runs[i].label;
        for (std::size_t j = i + 1; j < runs.size(); ++j) {
            if (runs[j].label != label) continue;
            runs[i].label = runs[i].folder.string();
            runs[j].label = runs[j].folder.string();
        }
    }
}

}  // namespace

ReportContent read_content(const std::vector<fs::path>& places, const RecordReader& read_record) {
    Reader reader(read_record);
    for (const fs::path& place : places) reader.add(place);
    ReportContent& content = reader.content;
    if (content.runs.empty() && content.specimens.empty() && content.records.empty() && content.documents.empty() &&
        content.ensembles.empty() && content.summary.is_null()) {
        throw ResultError(content.remarks.empty() ? "there is nothing to report on; give a directory of results" : content.remarks.front());
    }
    if (content.kind == ReportKind::nothing && !content.runs.empty()) {
        content.kind = content.runs.size() == 1 ? ReportKind::run : ReportKind::runs;
    }
    distinguish(content.runs);
    content.title = make_title(content);
    return std::move(content);
}

}  // namespace musim::lsdem
