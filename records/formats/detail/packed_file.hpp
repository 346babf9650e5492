#pragma once

#include <filesystem>
#include <string>

#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// A file's bytes, and how messages call it.
struct NamedBytes {
    std::filesystem::path path;
    std::string bytes;
};

/// The one file that is packed in a `.gz` or `.zip` file; the file itself when it is neither, which its first bytes decide. A file in a zip
/// is called `archive.zip/name`. Throws ReadError for a damaged archive, one that holds no file, several (named in the message), an
/// encrypted one or another archive, and for more than `largest` bytes, which are counted while they are unpacked.
NamedBytes unpack(NamedBytes packed, std::size_t largest = kLargestFileBytes);

/// The same for a zip file alone.
NamedBytes unzip(const NamedBytes& packed, std::size_t largest);

}  // namespace musim::records::detail
