#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace musim::tests {

/// The reader that the environment's MUSIM_READER names, or the one called `usual` without it; ends the program with the names that are
/// known for any other. Readers have a `name`.
template <class Reader>
const Reader& choose_reader(std::span<const Reader> readers, std::string_view usual) {
    const char* const asked = std::getenv("MUSIM_READER");
    const std::string_view name = asked == nullptr ? usual : asked;
    for (const Reader& reader : readers) {
        if (reader.name == name) return reader;
    }
    std::fprintf(stderr, "MUSIM_READER is '%s' (known:", asked);
    for (const Reader& reader : readers) std::fprintf(stderr, " %s", reader.name.data());
    std::fprintf(stderr, "); name one of these\n");
    std::exit(2);
}

}  // namespace musim::tests
