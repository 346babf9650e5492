#include "lsdem/response/field_animation.hpp"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <system_error>

#include "lsdem/plot/render_svg.hpp"
#include "lsdem/response/run_program.hpp"
#include "records/error.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// Pixels of a film for each of the picture: some 1,100 lines for a tower alone.
constexpr double kFilmScale = 1.5;

/// Pictures that are drawn before they are written, so that few are in memory.
constexpr std::size_t kBatch = 32;

std::vector<FieldView> take_all(const StoredRun& run, const AnimationSettings& settings) {
    std::vector<FieldView> views(settings.frames.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < views.size(); ++i) {
        jobs.emplace_back([&, i] { views[i] = {settings.frames[i], take_picture(run, settings.frames[i], settings.camera)}; });
    }
    scaling::run_side_by_side(jobs, settings.threads);
    return views;
}

/// H.264 wants even sides; a film of few colours wants them chosen from its own.
std::vector<std::string> list_encoding(const std::string& extension) {
    if (extension == ".gif") return {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-f", "gif"};
    return {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-f", "mp4"};
}

}  // namespace

double add_animation_frames(ResultFolder& folder, const StoredRun& run, const AnimationSettings& settings) {
    if (!detail::can_render_svg()) {
        throw records::WriteError(
            fmt::format("{}: musim was built without PNG (librsvg was not found), and films are made of them; draw "
                        "single times as SVG",
                        fmt::sprintf(kAnimationFrames, 1)));
    }
    const std::vector<FieldView> views = take_all(run, settings);
    FieldPicture picture = settings.picture;
    if (!(picture.limit > 0.0)) picture.limit = find_field_limit(run, views, picture.side, picture.component);
    for (std::size_t first = 0; first < views.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, views.size() - first);
        std::vector<std::string> images(count);
        std::vector<std::function<void()>> jobs;
        for (std::size_t i = 0; i < count; ++i) {
            jobs.emplace_back([&, i] { images[i] = detail::render_png(make_field_svg(run, {views[first + i]}, picture), kFilmScale); });
        }
        scaling::run_side_by_side(jobs, settings.threads);
        for (std::size_t i = 0; i < count; ++i) folder.add_text(fmt::sprintf(kAnimationFrames, first + i + 1), images[i]);
        if (settings.on_progress) settings.on_progress(static_cast<double>(first + count) / static_cast<double>(views.size()));
    }
    return picture.limit;
}

bool can_write_film() { return detail::has_program("ffmpeg"); }

void write_film(const fs::path& pictures, const fs::path& file, double rate) {
    const fs::path unfinished = file.parent_path() / ("." + file.filename().string() + ".unfinished");
    if (!can_write_film()) {
        throw records::WriteError(fmt::format(
            "{}: there is no ffmpeg to make a film with; install it (apt-get install ffmpeg), or take the pictures alone", file.string()));
    }
    std::vector<std::string> command{
        "ffmpeg", "-y", "-loglevel", "error", "-framerate", fmt::format("{:.6g}", rate), "-i", (pictures / kAnimationFrames).string()};
    for (const std::string& word : list_encoding(file.extension().string())) command.push_back(word);
    command.push_back(unfinished.string());
    const std::optional<int> status = detail::run_program(command);
    std::error_code error;
    if (status == 0) fs::rename(unfinished, file, error);
    if (status == 0 && !error) return;
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw records::WriteError(fmt::format("{}: ffmpeg could not make it ({}); take the pictures alone, and try it by hand", file.string(),
                                          error    ? error.message()
                                          : status ? fmt::format("exit status {}", *status)
                                                   : "it could not be started"));
}

}  // namespace musim::lsdem
