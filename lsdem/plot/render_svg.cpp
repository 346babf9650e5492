#include "lsdem/plot/render_svg.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace musim::lsdem::detail {
namespace {

/// Owners of what the C libraries hand out.
struct Release {
    void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
    void operator()(GError* error) const { g_error_free(error); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
template <class Type>
using Owner = std::unique_ptr<Type, Release>;

[[noreturn]] void fail(const std::string& reason) { throw std::runtime_error("picture cannot be rendered (" + reason + ")"); }

/// Throws what a function of librsvg reported.
[[noreturn]] void fail(GError* error) {
    const Owner<GError> owned(error);
    fail(error != nullptr ? error->message : "librsvg says no more");
}

struct Document {
    Owner<RsvgHandle> handle;
    double width = 0.0, height = 0.0;  ///< [px]
};

Document open_document(const std::string& svg) {
    GError* error = nullptr;
    Document document;
    document.handle.reset(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
    if (!document.handle) fail(error);
    if (rsvg_handle_get_intrinsic_size_in_pixels(document.handle.get(), &document.width, &document.height) == FALSE) {
        fail("it has no size in pixels");
    }
    return document;
}

void draw(const Document& document, cairo_surface_t* surface, double width, double height) {
    const Owner<cairo_t> context(cairo_create(surface));
    const RsvgRectangle viewport{0.0, 0.0, width, height};
    GError* error = nullptr;
    if (rsvg_handle_render_document(document.handle.get(), context.get(), &viewport, &error) == FALSE) fail(error);
    cairo_show_page(context.get());
    if (const cairo_status_t status = cairo_status(context.get()); status != CAIRO_STATUS_SUCCESS) fail(cairo_status_to_string(status));
}

/// Takes what cairo writes; `closure` is the std::string.
cairo_status_t append(void* closure, const unsigned char* bytes, unsigned int count) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

bool can_render_svg() { return true; }

std::string render_png(const std::string& svg, double scale) {
    const Document document = open_document(svg);
    const double width = std::ceil(scale * document.width), height = std::ceil(scale * document.height);
    const Owner<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)));
    draw(document, surface.get(), width, height);
    std::string bytes;
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
    if (status != CAIRO_STATUS_SUCCESS) fail(cairo_status_to_string(status));
    return bytes;
}

std::string render_pdf(const std::string& svg, double scale) {
    const Document document = open_document(svg);
    const double width = scale * document.width, height = scale * document.height;
    std::string bytes;
    const Owner<cairo_surface_t> surface(cairo_pdf_surface_create_for_stream(append, &bytes, width, height));
    // a date would make two equal pictures differ
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    draw(document, surface.get(), width, height);
    cairo_surface_finish(surface.get());
    if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS) {
        fail(cairo_status_to_string(status));
    }
    return bytes;
}

}  // namespace musim::lsdem::detail
