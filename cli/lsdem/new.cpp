#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/run/use_record.hpp"
#include "lsdem/scene/measured_material.hpp"
#include "lsdem/scene/new_scene.hpp"
#include "records/atomic_file.hpp"
#include "scaling/dimension.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
    lsdem::NewScene wanted;
    std::string material = "wood";
    std::optional<Number> length;
    std::vector<std::string> block;
    RecordMotionOptions record;
    std::string mesh, unit;
    std::string out;
    bool force = false;
};

/// A scene that someone may have worked on is not lost by a command typed again.
void refuse_existing(const NewOptions& options) {
    std::error_code unknown;
    if (options.out.empty() || options.force || !fs::is_regular_file(options.out, unknown)) return;
    throw records::WriteError(options.out + ": there is a file of this name already; name another, or take --force to replace it");
}

std::optional<lsdem::Triple<scaling::Length>> parse_block(const std::vector<std::string>& edges) {
    if (edges.empty()) return std::nullopt;
    lsdem::Triple<scaling::Length> block;
    for (std::size_t i = 0; i < block.size(); ++i) {
        block[i] = read_option("--block", [&] {
            return scaling::Length::from_value(scaling::parse_si_with_unit(edges[i], scaling::dimension_of<scaling::Length>()));
        });
        if (!(block[i].value() > 0.0)) throw CLI::ValidationError("--block", edges[i] + " is not above zero");
    }
    return block;
}

/// The file of a mesh; its unit is read like that of any quantity.
std::optional<lsdem::MeshForm> find_mesh(const NewOptions& options) {
    if (options.wanted.kind != "mesh") {
        if (!options.mesh.empty() || !options.unit.empty()) throw CLI::ValidationError("--mesh", "and --mesh-unit are for the kind mesh");
        return std::nullopt;
    }
    if (options.mesh.empty() || options.unit.empty()) {
        throw CLI::ValidationError("--mesh", "and --mesh-unit are needed: musim new mesh --mesh boulder.stl --mesh-unit mm");
    }
    read_option("--mesh-unit", [&] { return scaling::parse_si_with_unit("1 " + options.unit, scaling::dimension_of<scaling::Length>()); });
    return lsdem::MeshForm{.file = fs::absolute(options.mesh).lexically_normal(), .unit = options.unit, .part = {}};
}

/// Adds to the comments of a scene which commands go on from it.
void name_commands(lsdem::ReadableText& text, const lsdem::Scene& scene, bool has_record) {
    text.comments[""].emplace_back("musim check FILE says what this means and draws it; musim run FILE -o DIR runs it");
    text.comments["/material"].emplace_back("musim calibrate shows how to measure your own");
    if (lsdem::tilts(scene)) {
        text.comments["/tilt"].emplace_back("musim tilt FILE finds the angle at which the structure collapses, and how");
        return;
    }
    text.comments["/base_motion"].emplace_back(has_record ? "musim record info FILE lists the components of a record"
                                                          : "musim new ... --record FILE takes a record instead");
}

int run_new(const NewOptions& options) {
    refuse_overwriting({options.record.record, options.material}, {options.out});
    refuse_existing(options);
    lsdem::NewScene wanted = options.wanted;
    wanted.mesh = find_mesh(options);
    wanted.material = lsdem::find_measured_material(options.material);
    lsdem::Scene scene = lsdem::make_new_scene(wanted);
    if (!options.record.record.empty()) {
        options.record.apply(scene);
        lsdem::scale_record(scene, lsdem::find_scale(wanted));
    }
    lsdem::ReadableText text = lsdem::comment_new_scene(wanted, scene);
    name_commands(text, scene, !options.record.record.empty());
    if (!options.out.empty()) text.folder = fs::absolute(options.out).parent_path();
    const std::string json = lsdem::write_readable_scene(scene, text);
    if (options.out.empty()) {
        print("{}", json);
        return kDone;
    }
    records::write_file_atomically(options.out, json);
    const bool has_blank = options.out.find(' ') != std::string::npos;
    print("{} written: {}\nnext: musim check {} -o preview.svg\n", options.out, scene.name,
          has_blank ? "'" + options.out + "'" : options.out);
    return kDone;
}

}  // namespace

void add_new_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<NewOptions>();
    CLI::App* command = app.add_subcommand("new", "A scene to start from, with comments");
    command
        ->add_option(
            "kind", options->wanted.kind,
            "tower, wall, column, blocks: a portal listed block by block, arch, drums: a column of them, or mesh: a block of a file")
        ->required()
        ->type_name("KIND")
        ->check(one_of(lsdem::new_scene_kinds()));
    command->add_option("-o,--out", options->out, "Scene file to write (default: print it)")->type_name("SCENE.json");
    command
        ->add_option("--material", options->material,
                     "Of the blocks: a preset (`musim calibrate presets`), a material file (musim-material/1), or a scene whose it is")
        ->capture_default_str()
        ->type_name("PRESET|FILE");
    add_positive_option(
        *command, "--length", options->length,
        "Length of the model over that of the prototype, whose blocks are 1.36 x 2.82 x 4.25 m (default: of the material's block, "
        "wood 1/107; with --block H over 4.25 m)");
    command
        ->add_option("--block", options->block,
                     "Edges of your blocks: thin b, wide w, height H, such as \"30 mm\" \"60 mm\" \"90 mm\" (default: the prototype's "
                     "at the model's length, of a material file its own); stiffnesses are fitted to them")
        ->type_name("LENGTH")
        ->expected(3);
    add_whole_option(
        *command, "--layers", options->wanted.layers,
        "Layers of blocks (default: tower 8, wall 6, column 6, each pillar of blocks 2, 50 at most), voussoirs of an arch (7), drums (4)",
        {1, 1000});
    command->add_option("--mesh", options->mesh, "Of mesh: the file of the block, an STL, OBJ or PLY")->type_name("FILE");
    command->add_option("--mesh-unit", options->unit, "Of mesh: unit of the file's coordinates, such as mm")->type_name("UNIT");
    options->record.add_to(*command,
                           "Shake with the strong motion of this record of a prototype, scaled by the mu law, instead of a made one");
    command->add_flag("--force", options->force, "Replace the file of --out");
    command->footer(
        "Examples:\n"
        "  musim new tower -o tower.json\n"
        "  musim new column --layers 4 --record station.v1 --component y=360 -o column.json\n"
        "  musim new wall --material concrete --length 1/25\n"
        "  musim new wall --material granite --block \"0.2 m\" \"0.6 m\" \"0.3 m\"\n"
        "  musim new arch --material granite --block \"0.15 m\" \"0.3 m\" \"0.4 m\" --layers 7 -o arch.json\n"
        "  musim new mesh --mesh boulder.stl --mesh-unit mm --material granite -o boulder.json\n"
        "  musim new tower --block \"30 mm\" \"60 mm\" \"90 mm\" --record station.v1 -o tower.json\n"
        "The scene is complete: `musim check` says what it means, `musim run` runs it. Change it in any editor; its comments say how.");
    command->callback([&action, options] {
        options->wanted.block = parse_block(options->block);
        if (options->length) {
            options->wanted.length = options->length->value;
            note_larger_model(options->length->value);
        }
        action = [options] { return run_new(*options); };
    });
}

}  // namespace musim::cli
