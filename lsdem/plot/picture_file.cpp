#include "lsdem/plot/picture_file.hpp"

#include "lsdem/plot/render_svg.hpp"
#include "records/atomic_file.hpp"

namespace musim::lsdem {
namespace {

/// 300 dots per inch for 120 SVG pixels per inch: a picture of 864 px is 7.2 inches wide then.
constexpr double kPngScale = 300.0 / 120.0;
/// Points in an SVG pixel: 72 and 96 of them are an inch.
constexpr double kPdfScale = 72.0 / 96.0;

}  // namespace

bool can_write_png() { return detail::can_render_svg(); }

void require_picture_name(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".svg") return;
    if (extension != ".png" && extension != ".pdf") {
        throw records::WriteError(path.string() + ": the extension implies no kind of picture; name it .svg, .png or .pdf");
    }
    if (!can_write_png()) {
        throw records::WriteError(path.string() + ": musim was built without PNG and PDF (librsvg was not found); write .svg");
    }
}

std::string make_picture_bytes(const std::string& svg, const std::string& kind) {
    require_picture_name("picture." + kind);
    if (kind == "png") return detail::render_png(svg, kPngScale);
    if (kind == "pdf") return detail::render_pdf(svg, kPdfScale);
    return svg;
}

void write_picture(const std::filesystem::path& path, const std::string& svg) {
    require_picture_name(path);
    records::write_file_atomically(path, make_picture_bytes(svg, path.extension().string().substr(1)));
}

}  // namespace musim::lsdem
