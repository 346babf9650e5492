#include "lsdem/results/hdf5_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lsdem/results/checksum.hpp"
#include "lsdem/results/result_error.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem::detail {
namespace {

/// The library takes damaged numbers as they are, and damaged structure for anything: the checksum comes first.
std::string check_file(const std::filesystem::path& path) {
    const std::string obstacle = scaling::find_obstacle(path);
    if (!obstacle.empty()) {
        throw ResultError(
            fmt::format("{}: cannot be read ({}); name the results of a run, or a prepared specimen", path.string(), obstacle));
    }
    return require_checksum(path);
}

hid_t open_file(const std::filesystem::path& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) throw ResultError(fmt::format("{}: is no HDF5 file; make it again with the command that made it", path.string()));
    return file;
}

/// Number of values that a dataset of that shape holds; nothing when the file keeps fewer, as ours, which are not compressed, never do.
std::optional<std::size_t> count_values(hid_t set, const std::vector<hsize_t>& shape) {
    if (std::find(shape.begin(), shape.end(), 0) != shape.end()) return 0;
    const Hdf5Handle type(H5Dget_type(set), H5Tclose, "describe a dataset");
    const std::size_t kept = H5Dget_storage_size(set) / H5Tget_size(type);
    std::size_t count = 1;
    for (const hsize_t n : shape) {
        if (count > kept / n) return std::nullopt;
        count *= n;
    }
    return count;
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path)
    : path_(path), checksum_(check_file(path)), file_(open_file(path), H5Fclose, "open " + path.string()) {}

void Hdf5Reader::fail(const std::string& what) const {
    const std::optional<std::string> version = find_text("program_version");
    if (version) {
        throw ResultError(
            fmt::format("{}: {} (it is damaged, or of another version: musim {} wrote it); read it with that version, or run the "
                        "scene again",
                        path_.string(), what, *version));
    }
    throw ResultError(fmt::format("{}: {} (it is no result of musim, or damaged); run the scene again", path_.string(), what));
}

bool Hdf5Reader::has(const std::string& path) const {
    // every group on the way must be there
    for (std::size_t at = path.find('/', 1); at != std::string::npos; at = path.find('/', at + 1)) {
        if (H5Lexists(file_, path.substr(0, at).c_str(), H5P_DEFAULT) <= 0) return false;
    }
    return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

template <class Number>
Hdf5Data<Number> Hdf5Reader::read(const std::string& path, std::size_t rank) const {
    if (!has(path)) fail(fmt::format("has no {}", path));
    const Hdf5Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, "open " + path);
    const Hdf5Handle space(H5Dget_space(set), H5Sclose, "describe " + path);
    if (H5Sget_simple_extent_ndims(space) != static_cast<int>(rank)) fail(fmt::format("{} has not {} dimensions", path, rank));
    Hdf5Data<Number> data;
    data.shape.resize(rank);
    H5Sget_simple_extent_dims(space, data.shape.data(), nullptr);
    const std::optional<std::size_t> count = count_values(set, data.shape);
    if (!count) fail(fmt::format("{} says that it holds more than there is", path));
    data.values.resize(*count);
    if (*count > 0 && H5Dread(set, types_of(Number{}).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data()) < 0) {
        fail(fmt::format("{} cannot be read", path));
    }
    return data;
}

template Hdf5Data<double> Hdf5Reader::read(const std::string& path, std::size_t rank) const;
template Hdf5Data<float> Hdf5Reader::read(const std::string& path, std::size_t rank) const;
template Hdf5Data<long long> Hdf5Reader::read(const std::string& path, std::size_t rank) const;

std::vector<int> Hdf5Reader::layers(const std::string& path, std::size_t blocks) const {
    std::vector<int> layers;
    for (const long long layer : read<long long>(path, 1).values) {
        if (layer < 0 || static_cast<unsigned long long>(layer) > blocks) {
            fail(fmt::format("{} has a layer {} in a structure of {} blocks", path, layer, blocks));
        }
        layers.push_back(static_cast<int>(layer));
    }
    return layers;
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
    if (!has(path)) fail(fmt::format("has no {}", path));
    const Hdf5Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, "open " + path);
    const Hdf5Handle space(H5Dget_space(set), H5Sclose, "describe " + path);
    const Hdf5Handle type(H5Dget_type(set), H5Tclose, "describe " + path);
    if (H5Sget_simple_extent_ndims(space) != 1 || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) {
        fail(fmt::format("{} is no list of texts", path));
    }
    std::vector<hsize_t> shape(1);
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    const std::optional<std::size_t> count = count_values(set, shape);
    if (!count) fail(fmt::format("{} says that it holds more than there is", path));
    const std::size_t size = H5Tget_size(type);
    std::string padded(*count * size, '\0');
    if (*count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) fail(fmt::format("{} cannot be read", path));
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < *count; ++i) {
        const std::string text = padded.substr(i * size, size);
        texts.push_back(text.substr(0, text.find('\0')));
    }
    return texts;
}

std::optional<std::string> Hdf5Reader::find_text(const std::string& name) const {
    const Hdf5Handle root(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose, "open the root group");
    if (H5Aexists(root, name.c_str()) <= 0) return std::nullopt;
    const Hdf5Handle attribute(H5Aopen(root, name.c_str(), H5P_DEFAULT), H5Aclose, "open " + name);
    const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "describe " + name);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return std::nullopt;
    std::string text(H5Tget_size(type), '\0');
    if (H5Aread(attribute, type, text.data()) < 0) return std::nullopt;
    return text.substr(0, text.find('\0'));
}

std::string Hdf5Reader::attribute(const std::string& name) const {
    const std::optional<std::string> text = find_text(name);
    if (!text) fail(fmt::format("has no attribute \"{}\" that is text", name));
    return *text;
}

}  // namespace musim::lsdem::detail
