#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/report.hpp"
#include "cli/version.hpp"
#include "lsdem/export/exported_blocks.hpp"
#include "lsdem/export/gltf.hpp"
#include "lsdem/export/mesh_files.hpp"
#include "lsdem/export/sensor_streams.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "records/atomic_file.hpp"

namespace musim::cli {
namespace {

struct ExportCommand {
    std::string source;
    std::string out;
    std::string format;        ///< empty: that of the name
    std::optional<Number> at;  ///< [s]
    std::optional<std::string> sensor;
    bool json = false;
};

/// Kind of file: what was asked for, or what the name ends in.
std::string find_format(const ExportCommand& options) {
    if (!options.format.empty()) return options.format;
    std::string extension = std::filesystem::path(options.out).extension().string();
    for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    for (const char* known : {"glb", "gltf", "obj", "stl", "mseed"}) {
        if (extension == std::string(".") + known) return known;
    }
    throw CLI::ValidationError(
        "--out", fmt::format("{}: its name ends in none of .glb, .gltf, .obj, .stl, .mseed; name it so, or give --format", options.out));
}

lsdem::ExportedBlocks read_blocks(const ExportCommand& options) {
    if (std::filesystem::is_directory(options.source)) {
        return lsdem::list_blocks(lsdem::read_run(options.source), options.at ? std::optional<double>(*options.at) : std::nullopt);
    }
    if (options.at) {
        throw CLI::ValidationError("--at",
                                   fmt::format("{}: a scene has no times; give the directory of a run, or leave --at out", options.source));
    }
    const lsdem::Scene scene = lsdem::read_scene(options.source);
    note_reading(scene);
    return lsdem::list_blocks(lsdem::make_upright_specimen(scene), scene.name);
}

std::string make_bytes(const lsdem::ExportedBlocks& exported, const std::string& format) {
    if (format == "obj") return lsdem::make_obj(exported);
    if (format == "stl") return lsdem::make_stl(exported);
    return lsdem::make_gltf(exported, format == "glb" ? lsdem::GltfForm::binary : lsdem::GltfForm::embedded, kVersion);
}

/// Readings of sensors instead of blocks.
int export_sensors(const ExportCommand& options) {
    if (options.at) throw CLI::ValidationError("--at", "miniSEED has the whole histories of the sensors; leave it out");
    if (!std::filesystem::is_directory(options.source)) {
        throw CLI::ValidationError("RESULT_OR_SCENE",
                                   fmt::format("{}: only a run has readings of sensors; give its directory", options.source));
    }
    const std::size_t streams = lsdem::write_sensor_streams(options.out, lsdem::read_run(options.source), options.sensor);
    if (options.json) {
        print_json({{"file", options.out}, {"format", "mseed"}, {"streams", streams}});
    } else {
        print("{}: {} streams\n", options.out, streams);
    }
    return kDone;
}

int run_export(const ExportCommand& options) {
    const std::string format = find_format(options);
    if (format == "mseed") return export_sensors(options);
    if (options.sensor) throw CLI::ValidationError("--sensor", "only miniSEED has sensors; name the file so, or leave it out");
    refuse_overwriting({options.source}, {options.out});
    lsdem::ExportedBlocks exported = read_blocks(options);
    const bool moves = options.at == std::nullopt && (format == "glb" || format == "gltf");
    if (!moves) exported.frames = {};
    const std::string bytes = make_bytes(exported, format);
    records::write_file_atomically(options.out, bytes);

    const std::size_t frames = exported.frames.time.size();
    const double duration = frames > 0 ? exported.frames.time.back() - exported.frames.time.front() : 0.0;
    if (options.json) {
        print_json({{"file", options.out},
                    {"format", format},
                    {"blocks", exported.blocks.size()},
                    {"frames", frames},
                    {"duration_s", duration},
                    {"prototype_time_over_time", 1.0 / exported.similitude.time()},
                    {"bytes", bytes.size()}});
        return kDone;
    }
    print("{}: {} blocks", options.out, exported.blocks.size());
    if (frames > 0) print(", {} frames over {:.6g} s", frames, duration);
    print("\n");
    if (moves && frames == 0 && std::filesystem::is_directory(options.source)) {
        note("{}: the run has kept no frames, so nothing moves; give its scene \"output\": {{\"frame_rate\": \"100 Hz\"}}\n",
             options.source);
    }
    return kDone;
}

}  // namespace

void add_export_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<ExportCommand>();
    CLI::App* command =
        app.add_subcommand("export", "Blocks and their motion for Blender and CAD viewers: glTF, OBJ, STL; sensors as miniSEED");
    command->add_option("source", options->source, "Directory of results, as `musim run -o` writes it, or a scene file")
        ->required()
        ->type_name("RESULT_OR_SCENE");
    command
        ->add_option("-o,--out", options->out,
                     "File to write: .glb or .gltf with the motion, .obj or .stl of one instant, .mseed of sensors")
        ->required()
        ->type_name("FILE");
    command->add_option("--format", options->format, "Kind of file (default: by its name)")
        ->check(one_of({"glb", "gltf", "obj", "stl", "mseed"}));
    command->add_option("--at", options->at, "Of a run: the blocks at this time, without motion [s] (default: from the start, with motion)")
        ->type_name("TIME");
    command->add_option("--sensor", options->sensor, "As miniSEED: this sensor alone (default: all, one station each)")->type_name("NAME");
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim export out/arch -o arch.glb\n"
        "  musim export arch.json -o arch.glb\n"
        "  musim export out/arch -o fallen.obj --at 12.5\n"
        "  musim export out/arch -o a1.mseed --sensor A1\n"
        "glTF 2.0, in metres: one node a block, named as in results, one mesh a shape, the frames of the run as an animation in its own "
        "time\n"
        "(asset.extras has the prototype's); the root node turns z up into y up. OBJ and STL are in metres with z up. A run has frames "
        "when\n"
        "its scene asks for them: \"output\": {\"frame_rate\": \"100 Hz\"}.");
    command->callback([&action, options] { action = [options] { return run_export(*options); }; });
}

}  // namespace musim::cli
