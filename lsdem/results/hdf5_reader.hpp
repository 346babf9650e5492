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

/// An HDF5 file of ours to read from: the one way to open it, its checksum first. Other threads wait as long as one lives. Throws
/// ResultError, with the file's path in front.
class Hdf5Reader {
  public:
    explicit Hdf5Reader(const std::filesystem::path& path);

    /// Checksum of the whole file, see append_checksum().
    const std::string& checksum() const { return checksum_; }

    bool has(const std::string& path) const;

    /// Dataset of a given rank. Numbers (double, float, long long) are converted to the type asked for.
    template <class Number>
    Hdf5Data<Number> read(const std::string& path, std::size_t rank) const;
    /// Reads what Hdf5File::exchange wrote. Throws ResultError, too, where `shape` is not that of the values.
    template <class Value>
    void exchange(const std::string& path, const std::vector<hsize_t>& shape, std::vector<Value>& values,
                  const std::string& /*units*/) const {
        using Numbers = Hdf5Numbers<Value>;
        const std::vector<hsize_t> wanted = shape_of<Value>(shape);
        const auto data = read<typename Numbers::Number>(path, wanted.size());
        if (data.shape != wanted) fail(path + " has another size than the rest");
        values.clear();
        values.reserve(data.values.size() / Numbers::kCount);
        for (std::size_t i = 0; i < data.values.size(); i += Numbers::kCount) values.push_back(Numbers::make(&data.values[i]));
    }
    /// Number of values in the list `path`.
    template <class Value>
    hsize_t count(const std::string& path, const std::vector<Value>& /*values*/) const {
        return read<typename Hdf5Numbers<Value>::Number>(path, shape_of<Value>({0}).size()).shape[0];
    }
    /// Layers or levels of a structure of so many blocks, from 1; 0 for what is in none. Throws ResultError for any other.
    std::vector<int> layers(const std::string& path, std::size_t blocks) const;
    /// Texts that Hdf5File::write_texts wrote.
    std::vector<std::string> texts(const std::string& path) const;
    /// Text attribute of the file itself.
    std::string attribute(const std::string& name) const;

    /// Throws ResultError: the file, what is wrong, and what to do.
    [[noreturn]] void fail(const std::string& what) const;

  private:
    /// Text attribute of the file itself, if it has one.
    std::optional<std::string> find_text(const std::string& name) const;

    std::filesystem::path path_;
    std::string checksum_;
    Hdf5Lock lock_;
    Hdf5Handle file_;
};

}  // namespace musim::lsdem::detail
