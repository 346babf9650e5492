#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/hdf5_file.hpp"

namespace musim::lsdem::detail {

/// A dataset in memory, row by row.
template <class Number>
struct Hdf5Data {
    std::vector<hsize_t> shape;
    std::vector<Number> values;
};

/// An HDF5 file of ours to read from: the one way to open it, its checksum first. Throws ResultError, with the file's path in front.
class Hdf5Reader {
  public:
    explicit Hdf5Reader(const std::filesystem::path& path);

    /// Of the whole file, see append_checksum().
    const std::string& checksum() const { return checksum_; }

    bool has(const std::string& path) const;

    /// Dataset of a given rank. Numbers are converted to the type asked for.
    Hdf5Data<double> doubles(const std::string& path, std::size_t rank) const;
    Hdf5Data<float> floats(const std::string& path, std::size_t rank) const;
    Hdf5Data<long long> integers(const std::string& path, std::size_t rank) const;

    /// Layers or levels of a structure of so many blocks, from 1; 0 for what is in none. Throws ResultError for any other.
    std::vector<int> layers(const std::string& path, std::size_t blocks) const;

    /// Text attribute of the file itself.
    std::string attribute(const std::string& name) const;

    /// Throws ResultError: the file, what is wrong, and what to do.
    [[noreturn]] void fail(const std::string& what) const;

  private:
    /// Text attribute of the file itself, if it has one.
    std::optional<std::string> find_text(const std::string& name) const;

    template <class Number>
    Hdf5Data<Number> read(const std::string& path, std::size_t rank, hid_t type) const;

    std::filesystem::path path_;
    std::string checksum_;
    Hdf5Handle file_;
};

}  // namespace musim::lsdem::detail
