#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <filesystem>
#include <vector>

namespace musim::tests {

/// The HDF5 file of ours, changed as `draw` says in up to four places through the library, with the checksum of what has become of it:
/// numbers, shapes and types of datasets, and texts of attributes; datasets and attributes that are missing; shapes without numbers.
std::vector<char> edit_hdf5(const std::filesystem::path& file, FuzzedDataProvider& draw);

}  // namespace musim::tests
