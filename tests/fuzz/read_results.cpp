#include <fuzzer/FuzzedDataProvider.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/version.hpp"
#include "lsdem/archive.hpp"
#include "lsdem/motion/state_fields.hpp"
#include "lsdem/report/report.hpp"
#include "lsdem/response/response.hpp"
#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "lsdem/run/watched_folder.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_ensembles.hpp"
#include "lsdem/study/trace_file.hpp"
#include "scaling/error.hpp"
#include "scaling/json_text.hpp"
#include "tests/fuzz/choose_reader.hpp"
#include "tests/fuzz/edit_hdf5.hpp"
#include "tests/support/temporary_folder.hpp"

/// Files that musim writes and reads back, damaged behind their checksums: the input is stamped with the checksum that it should have, so
/// that what reads the content sees it. Any content is results, or a std::runtime_error of one short line. The environment's
/// MUSIM_READER names the kind of file, MUSIM_EXAMPLES a folder with whole results: run, pair, sequence, ensemble (of which a copy gets
/// the input), killed (with a checkpoint), specimen.h5 and scene.json, of which it is.
namespace {

using namespace musim;
namespace fs = std::filesystem;

const fs::path& examples() {
    static const fs::path folder = [] {
        const char* const named = std::getenv("MUSIM_EXAMPLES");
        if (named == nullptr) {
            std::fprintf(stderr, "MUSIM_EXAMPLES is not set; name the folder with results that scripts/fuzz makes\n");
            std::exit(2);
        }
        return fs::path(named);
    }();
    return folder;
}

/// A copy of whole results, of which one file is the input.
class Copy {
  public:
    explicit Copy(const std::string& name) { fs::copy(examples() / name, folder_.path(), fs::copy_options::recursive); }

    const fs::path& path() const { return folder_.path(); }
    fs::path write(const std::string& name, std::string_view bytes) const { return folder_.write(name, bytes); }

  private:
    tests::TemporaryFolder folder_;
};

/// The text with the checksum of what it says; as it is when that is no JSON object.
std::string stamp_json(const std::string& text) {
    try {
        nlohmann::json object = scaling::parse_json_text(text);
        if (object.is_object()) return lsdem::make_checked_json(std::move(object));
    } catch (const scaling::ParseError&) {
        // no JSON, which readers say
    }
    return text;
}

/// The sealed bytes with the length and the checksum that they should have (write_sealed).
std::string stamp_seal(std::string bytes) {
    constexpr std::size_t kHead = 24, kSum = 8, kLengthAt = 16;
    if (bytes.size() < kHead + kSum) return bytes;
    const std::uint64_t length = bytes.size() - kHead - kSum;
    std::memcpy(bytes.data() + kLengthAt, &length, sizeof length);
    const std::string_view view = bytes;
    const std::uint64_t sum = lsdem::hash_bytes(view.substr(0, kHead)) ^ lsdem::hash_bytes(view.substr(kHead, length));
    std::memcpy(bytes.data() + kHead + length, &sum, sizeof sum);
    return bytes;
}

void require_line(const std::string& message) {
    if (message.find('\n') != std::string::npos) __builtin_trap();
}

/// Check that what `read` throws is one line.
template <class Read>
void allow_refusal(const Read& read) {
    try {
        read();
    } catch (const std::runtime_error& error) {
        require_line(error.what());
    }
}

void report(const fs::path& place) {
    allow_refusal([&] {
        const lsdem::ReportContent content =
            lsdem::read_content({place}, [](const fs::path&) -> records::GroundMotion { throw std::logic_error("no record was named"); });
        for (const std::string& remark : content.remarks) require_line(remark);
        lsdem::make_sections(content);
    });
}

void read_everything(const fs::path& folder) {
    allow_refusal([&] { lsdem::measure_response(lsdem::read_run(folder)); });
    lsdem::look_into(folder);
    report(folder);
}

/// Where a run is stopped that needs not go on.
struct Stop {};

void read_checkpoint(const std::string& bytes) {
    static const Copy copy("killed");
    static const std::string scene_text = lsdem::read_checkpoint(examples() / "killed/checkpoint", cli::kVersion).scene;
    const fs::path file = copy.write("checkpoint", stamp_seal(bytes));
    allow_refusal([&] {
        lsdem::Checkpoint checkpoint = lsdem::read_checkpoint(file, cli::kVersion);
        // another scene may be a large one
        static const lsdem::Scene scene = lsdem::parse_scene(scene_text, "checkpoint");
        lsdem::RunSettings settings;
        settings.observer.on_sample = [](const auto&...) { throw Stop(); };
        settings.observer.on_preparation = [](double) { throw Stop(); };
        try {
            lsdem::resume_scene(scene, std::move(checkpoint), settings);
        } catch (const Stop&) {
            // it goes on
        }
    });
}

/// Up to four places of a text changed as `draw` says: eight bytes replaced, some left out or put in.
std::string edit_bytes(std::string bytes, FuzzedDataProvider& draw) {
    for (int edits = draw.ConsumeIntegralInRange(0, 4); edits > 0; --edits) {
        const std::size_t at = draw.ConsumeIntegralInRange<std::size_t>(0, bytes.size());
        const std::uint64_t word = draw.ConsumeBool() ? draw.ConsumeIntegral<std::uint64_t>() : draw.ConsumeIntegral<std::uint8_t>();
        const std::string text(reinterpret_cast<const char*>(&word), sizeof word);
        switch (draw.ConsumeIntegralInRange(0, 3)) {
            case 0:
                bytes.erase(at, draw.ConsumeIntegral<std::uint8_t>());
                break;
            case 1:
                bytes.insert(at, text);
                break;
            default:
                bytes.replace(at, text.size(), text);
        }
    }
    return bytes;
}

/// The input says how the simulation that a checkpoint holds is changed, which has a seal of its own.
void read_state(const std::string& edits) {
    static const lsdem::Checkpoint whole = lsdem::read_checkpoint(examples() / "killed/checkpoint", cli::kVersion);
    static const lsdem::Scene scene = lsdem::parse_scene(whole.scene, "checkpoint");
    static const lsdem::Specimen specimen = lsdem::make_specimen(scene, {}, &whole);
    static const std::string state = [] {
        std::istringstream in(whole.state);
        return lsdem::read_sealed(in, lsdem::kStateKind);
    }();
    FuzzedDataProvider draw(reinterpret_cast<const std::uint8_t*>(edits.data()), edits.size());
    std::ostringstream sealed;
    lsdem::write_sealed(sealed, lsdem::kStateKind, edit_bytes(state, draw));
    lsdem::Checkpoint checkpoint = whole;
    checkpoint.state = sealed.str();
    lsdem::RunSettings settings;
    settings.observer.on_sample = [](const auto&...) { throw Stop(); };
    allow_refusal([&] {
        try {
            lsdem::resume(specimen, std::move(checkpoint), settings);
        } catch (const Stop&) {
            // it goes on
        }
    });
}

void read_summary(const std::string& text) {
    static const Copy copy("run");
    copy.write("summary.json", stamp_json(text));
    read_everything(copy.path());
}

void read_contents(const std::string& text) {
    static const Copy copy("run");
    copy.write("contents.json", stamp_json(text));
    allow_refusal([&] { lsdem::require_complete(copy.path()); });
    allow_refusal([&] { lsdem::refuse_other_results(copy.path(), {}); });
    lsdem::list_results(copy.path());
    lsdem::look_into(copy.path());
}

template <const char* kFolder, const char* kFile>
void report_with(const std::string& text) {
    static const Copy copy(kFolder);
    copy.write(kFile, stamp_json(text));
    lsdem::look_into(copy.path());
    report(copy.path());
}
constexpr char kPair[] = "pair", kPairFile[] = "pair.json", kSequence[] = "sequence", kSequenceFile[] = "sequence.json",
               kEnsemble[] = "ensemble", kEnsembleFile[] = "ensemble.json";

void read_document(const std::string& text) {
    static const tests::TemporaryFolder folder;
    report(folder.write("printed.json", text));
}

void read_live(const std::string& text) {
    static const tests::TemporaryFolder folder;
    folder.write("progress.json", text);
    lsdem::look_into(folder.path());
}

void read_trace(const std::string& text) {
    static const tests::TemporaryFolder folder;
    lsdem::read_trace(folder.write("trace.json", stamp_json(text)));
}

std::string edit(const fs::path& file, const std::string& edits) {
    FuzzedDataProvider draw(reinterpret_cast<const std::uint8_t*>(edits.data()), edits.size());
    const std::vector<char> bytes = tests::edit_hdf5(file, draw);
    return {bytes.begin(), bytes.end()};
}

/// The input says how the specimen is changed. One that is taken stands in finite places, on quaternions that are rotations.
void read_specimen(const std::string& edits) {
    static const tests::TemporaryFolder folder;
    static const lsdem::Specimen upright = lsdem::make_upright_specimen(lsdem::read_scene(examples() / "scene.json"));
    const fs::path file = folder.write("specimen.h5", edit(examples() / "specimen.h5", edits));
    report(file);
    allow_refusal([&] { lsdem::read_specimen_inputs(file); });
    allow_refusal([&] {
        lsdem::Specimen specimen = upright;
        lsdem::take_places(file, specimen);
        for (const lsdem::Block& block : specimen.model.blocks) {
            if (!block.position.allFinite() || !(std::abs(block.orientation.norm() - 1.0) < 1e-6)) __builtin_trap();
        }
    });
}

/// The input says how the result is changed.
void read_result(const std::string& edits) {
    static const Copy copy("run");
    static const nlohmann::json whole = lsdem::read_checked_json(examples() / "run/summary.json");
    const std::string bytes = edit(examples() / "run/result.h5", edits);
    nlohmann::json summary = whole;
    constexpr std::size_t kHash = 16;
    summary["result_checksum"] = bytes.substr(bytes.size() - kHash - 1, kHash);
    copy.write("result.h5", bytes);
    copy.write("summary.json", lsdem::make_checked_json(std::move(summary)));
    read_everything(copy.path());
}

/// The input says how the bands of an ensemble are changed.
void read_bands(const std::string& edits) {
    static const Copy copy("ensemble");
    copy.write("ensemble.h5", edit(examples() / "ensemble/ensemble.h5", edits));
    allow_refusal([&] { lsdem::read_bands(copy.path()); });
    report(copy.path());
}

struct Reader {
    std::string_view name;
    void (*read)(const std::string& bytes);
};

constexpr Reader kReaders[] = {
    {"checkpoint", read_checkpoint},
    {"state", read_state},
    {"summary", read_summary},
    {"contents", read_contents},
    {"pair", report_with<kPair, kPairFile>},
    {"sequence", report_with<kSequence, kSequenceFile>},
    {"ensemble", report_with<kEnsemble, kEnsembleFile>},
    {"document", read_document},
    {"live", read_live},
    {"trace", read_trace},
    {"specimen", read_specimen},
    {"result", read_result},
    {"bands", read_bands},
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Reader& reader = musim::tests::choose_reader<Reader>(kReaders, "checkpoint");
    reader.read(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
