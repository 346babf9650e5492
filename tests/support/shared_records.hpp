#pragma once

#include <doctest/doctest.h>

#include <filesystem>

/// Real records beside the checkout, used when they are there.
namespace musim::tests {

/// Folder of the shared records; MUSIM_SOURCE_DIR is the root of the checkout.
inline std::filesystem::path shared_records() { return std::filesystem::path(MUSIM_SOURCE_DIR) / ".." / "shared" / "records"; }

/// True when the shared records are there; otherwise says so, once per call, in the test's output.
inline bool have_shared_records() {
    if (std::filesystem::is_directory(shared_records())) return true;
    MESSAGE("skipped: there are no real records in ../shared/records");
    return false;
}

}  // namespace musim::tests
