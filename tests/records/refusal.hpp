#pragma once

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "records/formats/read_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::tests {

/// Checks that a file "a" of this content is refused in one line that holds `said`, e.g. "a:4: sample 2 is 'x'".
inline void check_refused(std::string_view content, std::string_view said, const records::ReadOptions& options = {}) {
    const TemporaryFolder folder;
    const auto path = folder.write("a", content);
    const std::string message = message_of<records::ReadError>([&] { records::read_record(path, options); });
    CAPTURE(said);
    CAPTURE(message);
    CHECK(message.find(said) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

/// `text` with the first `from` replaced by `to`; the test fails when there is none.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace musim::tests
