#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/lsdem/field_options.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/plot/picture_file.hpp"
#include "lsdem/response/field_animation.hpp"
#include "lsdem/response/response.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::cli {
namespace {

struct FieldCommand {
    std::string directory;
    std::string out;
    FieldOptions look;
    std::vector<Number> times;  ///< [s]
    std::string limit;          ///< a velocity with its unit
    std::vector<std::string> formats;
    std::vector<Number> window;  ///< of the animation [s]
    std::string film;            ///< "", "png", "mp4", "gif"
    Number rate{25.0};           ///< [1/s]
    int threads = 0;
    bool json = false;
};

/// Times that are drawn when none are asked for.
constexpr std::size_t kUsualTimes = 6;

std::vector<double> choose_times(const lsdem::StoredRun& run, const FieldCommand& options) {
    std::vector<double> times(options.times.begin(), options.times.end());
    if (!times.empty()) return times;
    const double first = run.frames.time.front(), last = run.frames.time.back();
    const std::size_t count = std::min(kUsualTimes, run.frames.time.size());
    for (std::size_t i = 1; i <= count; ++i) times.push_back(first + (last - first) * static_cast<double>(i) / static_cast<double>(count));
    return times;
}

/// End of the colours [m/s]; 0: at the largest velocity that is seen.
double read_limit(const std::string& text) {
    if (text.empty()) return 0.0;
    const double limit = read_option("--limit", [&] { return scaling::parse_si(text, scaling::dimension_of<scaling::Velocity>()); });
    if (limit > 0.0) return limit;
    throw CLI::ValidationError("--limit", fmt::format("{}: colours end at a velocity above zero; give one, e.g. \"5 cm/s\"", text));
}

lsdem::FieldPicture make_picture(const FieldCommand& options, lsdem::CameraSide side) {
    return {.side = side, .component = options.look.shown(), .limit = read_limit(options.limit), .name = options.directory};
}

/// Pictures that were made, and what is printed about them.
struct Drawn {
    nlohmann::json json;
    std::vector<std::string> pictures;
};

Drawn draw_times(lsdem::ResultFolder& folder, const lsdem::StoredRun& run, const FieldCommand& options,
                 const lsdem::CameraSettings& camera) {
    const std::vector<lsdem::FieldView> views = lsdem::take_views(run, choose_times(run, options), camera);
    lsdem::FieldPicture picture = make_picture(options, camera.side);
    if (!(picture.limit > 0.0)) picture.limit = lsdem::find_field_limit(run, views, picture.side, picture.component);
    const std::string svg = lsdem::make_field_svg(run, views, picture);
    Drawn drawn{.json = {{"limit_m_s", picture.limit}}, .pictures = {}};
    for (const std::string& format : options.formats) {
        drawn.pictures.push_back("field." + format);
        folder.add_text(drawn.pictures.back(), lsdem::make_picture_bytes(svg, format));
    }
    nlohmann::json fields = nlohmann::json::array();
    for (const lsdem::FieldView& view : views) {
        nlohmann::json& field = fields.emplace_back(nlohmann::json{{"time_s", view.image.time}});
        if (!options.look.csv) continue;
        const std::string name = fmt::format("field_{:.6g}s.csv", view.image.time);
        folder.add_text(name, lsdem::make_field_csv(run, view.frame, view.image, camera.side));
        field["grid"] = name;
    }
    drawn.json["fields"] = fields;
    return drawn;
}

/// The frames within the window, or all.
std::vector<std::size_t> choose_frames(const lsdem::StoredRun& run, const FieldCommand& options) {
    if (options.window.empty()) {
        std::vector<std::size_t> all(run.frames.time.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        return all;
    }
    const std::size_t first = lsdem::find_frame(run, options.window[0]), last = lsdem::find_frame(run, options.window[1]);
    std::vector<std::size_t> frames;
    for (std::size_t i = first; i <= last; ++i) frames.push_back(i);
    if (frames.empty()) throw CLI::ValidationError("--window", "it ends before it begins; give FROM TO in seconds");
    return frames;
}

/// A folder for the pictures that a film is made of, which goes when the film is there, or cannot be made.
class FilmPictures {
  public:
    explicit FilmPictures(const std::filesystem::path& out) : folder_(out / ".film") { remove(); }
    ~FilmPictures() { remove(); }
    FilmPictures(const FilmPictures&) = delete;
    FilmPictures& operator=(const FilmPictures&) = delete;

    const std::filesystem::path& path() const { return folder_; }

  private:
    void remove() const noexcept {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    std::filesystem::path folder_;
};

/// Draws a picture for each frame into a folder.
Drawn draw_frames(lsdem::ResultFolder& folder, const lsdem::StoredRun& run, const FieldCommand& options,
                  const lsdem::CameraSettings& camera) {
    ProgressLine progress(options.directory);
    const lsdem::AnimationSettings settings{.frames = choose_frames(run, options),
                                            .camera = camera,
                                            .picture = make_picture(options, camera.side),
                                            .threads = options.threads,
                                            .on_progress = [&](double fraction) { progress.update(fraction); }};
    const double limit = lsdem::add_animation_frames(folder, run, settings);
    folder.commit();
    return {.json = {{"limit_m_s", limit}, {"frames", settings.frames.size()}}, .pictures = {}};
}

Drawn draw_film(lsdem::ResultFolder& folder, const lsdem::StoredRun& run, const FieldCommand& options,
                const lsdem::CameraSettings& camera) {
    if (options.film == "png") {
        Drawn drawn = draw_frames(folder, run, options, camera);
        drawn.json["frame_names"] = lsdem::kAnimationFrames;
        drawn.pictures.emplace_back(lsdem::kAnimationFrames);
        return drawn;
    }
    if (!lsdem::can_write_film()) {
        throw std::runtime_error("--film " + options.film +
                                 ": there is no ffmpeg to make a film with; install it (apt-get install ffmpeg), or take --film png");
    }
    const FilmPictures pictures(options.out);
    lsdem::ResultFolder frames(pictures.path());
    Drawn drawn = draw_frames(frames, run, options, camera);
    const std::string film = "field." + options.film;
    lsdem::write_film(pictures.path(), std::filesystem::path(options.out) / film, options.rate);
    drawn.json["film"] = film;
    drawn.pictures.push_back(film);
    return drawn;
}

int run_field(FieldCommand options) {
    if (options.formats.empty()) {
        options.formats = lsdem::can_write_png() ? std::vector<std::string>{"svg", "png"} : std::vector<std::string>{"svg"};
    }
    for (const std::string& format : options.formats) lsdem::require_picture_name("field." + format);
    read_limit(options.limit);  // a bad one is refused before anything is read
    const lsdem::StoredRun run = lsdem::read_run(options.directory);
    lsdem::require_frames(run);
    const lsdem::CameraSettings camera = options.look.camera(lsdem::find_strongest_axis(run.history));
    lsdem::ResultFolder folder(options.out);
    Drawn drawn = options.film.empty() ? draw_times(folder, run, options, camera) : draw_film(folder, run, options, camera);
    folder.commit();
    drawn.json["pictures"] = drawn.pictures;
    if (options.json) {
        print_json(drawn.json);
    } else {
        print("Colours end at {}\n",
              scaling::format_si(drawn.json["limit_m_s"].get<double>(), scaling::dimension_of<scaling::Velocity>(), 3));
        for (const std::string& picture : drawn.pictures) print("  {}/{}\n", options.out, picture);
    }
    return kDone;
}

}  // namespace

void add_field_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<FieldCommand>();
    CLI::App* command = app.add_subcommand("field", "The velocity field as a camera in front sees it: pictures at times, or a film");
    command->add_option("directory", options->directory, "Directory of results with frames, as `musim run -o` writes it")
        ->required()
        ->type_name("DIR");
    command->add_option("-o,--out", options->out, "Directory for the pictures or the film")->required()->type_name("OUT");
    CLI::Option* at = command->add_option("--at", options->times, "Times that are drawn beside each other [s] (default: six, evenly)");
    at->type_name("TIME");
    CLI::Option* csv = options->look.add_to(*command);
    command->add_option("--limit", options->limit, "Velocity at which colours end (default: the largest that is seen)")
        ->type_name("VELOCITY");
    CLI::Option* format = command->add_option("--format", options->formats, "Kinds of picture (default: svg and png)")
                              ->delimiter(',')
                              ->check(one_of({"svg", "png", "pdf"}));
    CLI::Option* film =
        command->add_option("--film", options->film, "All frames: a picture each (png), or a film alone (mp4, gif), which needs ffmpeg");
    film->check(one_of({"png", "mp4", "gif"}))->excludes(at)->excludes(format)->excludes(csv);
    command->add_option("--window", options->window, "Part of the run that is filmed [s]")->expected(2)->type_name("FROM TO")->needs(film);
    add_positive_option(*command, "--rate", options->rate, "Pictures of the film a second")->default_str("25")->needs(film);
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim field out/tower -o out/tower/field --at 0.4 0.5 0.6\n"
        "  musim field out/tower -o out/tower/field --component up --limit \"5 cm/s\" --format pdf\n"
        "  musim field out/tower -o out/tower/film --film mp4 --window 0.2 1.2\n"
        "Blocks are boxes in the colour of their velocity to the right, upward, or of its magnitude, relative to the fixed axes of the\n"
        "scene, not to the base. A run has frames when its scene asks for them:\n"
        "\"output\": {\"frame_rate\": \"100 Hz\"}.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_field(*options); }); }; });
}

}  // namespace musim::cli
