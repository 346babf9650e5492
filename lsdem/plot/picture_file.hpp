#pragma once

#include <filesystem>
#include <string>

namespace musim::lsdem {

/// Can pictures be written as PNG and PDF? Only when musim was built with librsvg.
bool can_write_png();

/// Throws records::WriteError unless the extension names a kind of picture that write_picture() can write: asked before anything is
/// computed.
void require_picture_name(const std::filesystem::path& path);

/// An SVG document as the bytes of a file of a kind: "svg", "png", "pdf"; what write_picture() writes. Throws records::WriteError as
/// require_picture_name() does.
std::string make_picture_bytes(const std::string& svg, const std::string& kind);

/// An SVG document as a file: .svg as it is, .png 300 dots per inch when the picture is 7.2 inches (183 mm) wide, .pdf with vectors and 96
/// SVG pixels per inch. The file is complete or absent. Throws records::WriteError.
void write_picture(const std::filesystem::path& path, const std::string& svg);

}  // namespace musim::lsdem
