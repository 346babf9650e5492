#include "tests/fuzz/edit_hdf5.hpp"

#include <hdf5.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "lsdem/results/checksum.hpp"
#include "lsdem/results/hdf5_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::tests {
namespace {

using lsdem::detail::Hdf5Handle;

/// Growth of a file in memory [bytes].
constexpr std::size_t kIncrement = 1 << 16;

void require(herr_t status) {
    if (status < 0) std::abort();
}

/// Datasets of a group, by path.
std::vector<std::string> list_datasets(hid_t file) {
    std::vector<std::string> paths;
    const auto note = [](hid_t, const char* name, const H5O_info_t* info, void* list) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
    };
    require(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, note, &paths));
    return paths;
}

/// Small numbers, and any bits of a double.
double draw_number(FuzzedDataProvider& draw) {
    if (draw.ConsumeBool()) return draw.ConsumeIntegralInRange<int>(-3, 300);
    const std::uint64_t bits = draw.ConsumeIntegral<std::uint64_t>();
    double number = 0.0;
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

/// A dataset in memory.
struct Data {
    std::vector<hsize_t> shape;
    std::vector<double> values;
};

Data read(hid_t file, const std::string& path) {
    const Hdf5Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "open a dataset");
    const Hdf5Handle space(H5Dget_space(set), H5Sclose, "describe a dataset");
    Data data;
    data.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, data.shape.data(), nullptr);
    std::size_t count = 1;
    for (const hsize_t n : data.shape) count *= n;
    data.values.resize(count);
    if (count > 0) require(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data()));
    return data;
}

/// Does a dataset hold numbers, all that its shape says? One that was changed before need not.
bool is_whole(hid_t file, const std::string& path) {
    const Hdf5Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "open a dataset");
    const Hdf5Handle type(H5Dget_type(set), H5Tclose, "describe a dataset");
    const bool in_pieces = H5Dget_storage_size(set) == 0;
    return !in_pieces && H5Tget_class(type) != H5T_STRING;
}

void change_number(hid_t file, const std::string& path, FuzzedDataProvider& draw) {
    Data data = read(file, path);
    if (data.values.empty()) return;
    data.values[draw.ConsumeIntegralInRange<std::size_t>(0, data.values.size() - 1)] = draw_number(draw);
    const Hdf5Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "open a dataset");
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data());
}

/// Another shape, or another type, with the numbers that were there as far as they go.
void replace_dataset(hid_t file, const std::string& path, FuzzedDataProvider& draw) {
    Data data = read(file, path);
    require(H5Ldelete(file, path.c_str(), H5P_DEFAULT));
    if (draw.ConsumeBool()) {
        data.shape.resize(draw.ConsumeIntegralInRange<std::size_t>(0, 3));
        for (hsize_t& n : data.shape) n = draw.ConsumeIntegralInRange<hsize_t>(0, 8);
    } else if (!data.shape.empty()) {
        data.shape[0] = draw.ConsumeIntegralInRange<hsize_t>(0, data.shape[0] + 1);
    }
    std::size_t count = 1;
    for (const hsize_t n : data.shape) count *= n;
    data.values.resize(count);
    const hid_t type = draw.PickValueInArray({H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I64LE, H5T_STD_U8LE, H5T_C_S1});
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(data.shape.size()), data.shape.data(), nullptr), H5Sclose, "create a space");
    const Hdf5Handle set(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, "create a dataset");
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data());
}

/// A shape of any size, of which the file holds nothing.
void claim_size(hid_t file, const std::string& path, FuzzedDataProvider& draw) {
    std::vector<hsize_t> shape = read(file, path).shape;
    require(H5Ldelete(file, path.c_str(), H5P_DEFAULT));
    for (hsize_t& n : shape) n = draw.ConsumeIntegral<std::uint64_t>() >> 1U;
    if (shape.empty()) return;
    const std::vector<hsize_t> piece(shape.size(), 1);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create properties");
    require(H5Pset_chunk(properties, static_cast<int>(piece.size()), piece.data()));
    const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    if (space < 0) return;
    const hid_t set = H5Dcreate2(file, path.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    if (set >= 0) H5Dclose(set);
    H5Sclose(space);
}

void change_attribute(hid_t file, FuzzedDataProvider& draw) {
    const Hdf5Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "open the root group");
    const std::string name =
        draw.PickValueInArray({"scene", "summary", "inputs", "format", "program_version", "state_hash", "time_step", "duration"});
    if (H5Aexists(root, name.c_str()) <= 0) return;
    require(H5Adelete(root, name.c_str()));
    if (draw.ConsumeBool()) return;
    const std::string text = draw.ConsumeRandomLengthString(200);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "create a type");
    require(H5Tset_size(type, text.size() + 1));
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "create a space");
    const Hdf5Handle attribute(H5Acreate2(root, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "create an attribute");
    require(H5Awrite(attribute, type, text.c_str()));
}

void edit(hid_t file, FuzzedDataProvider& draw) {
    if (draw.ConsumeIntegralInRange(0, 7) == 0) return change_attribute(file, draw);
    const std::vector<std::string> paths = list_datasets(file);
    if (paths.empty()) return;
    const std::string& path = paths[draw.ConsumeIntegralInRange<std::size_t>(0, paths.size() - 1)];
    if (!is_whole(file, path)) return;
    switch (draw.ConsumeIntegralInRange(0, 7)) {
        case 0:
            return require(H5Ldelete(file, path.c_str(), H5P_DEFAULT));
        case 1:
            return claim_size(file, path, draw);
        case 2:
        case 3:
            return replace_dataset(file, path, draw);
        default:
            return change_number(file, path, draw);
    }
}

}  // namespace

std::vector<char> edit_hdf5(const std::filesystem::path& file, FuzzedDataProvider& draw) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    std::string whole = bytes_of(file);
    whole.resize(whole.rfind("musim-checksum"));
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "create file properties");
    require(H5Pset_fapl_core(access, kIncrement, 0));
    require(H5Pset_file_image(access, whole.data(), whole.size()));
    const Hdf5Handle opened(H5Fopen("edited", H5F_ACC_RDWR, access), H5Fclose, "open a file in memory");
    for (int edits = draw.ConsumeIntegralInRange(0, 4); edits > 0; --edits) edit(opened, draw);
    require(H5Fflush(opened, H5F_SCOPE_GLOBAL));
    std::vector<char> bytes(static_cast<std::size_t>(H5Fget_file_image(opened, nullptr, 0)));
    if (H5Fget_file_image(opened, bytes.data(), bytes.size()) < 0) std::abort();
    lsdem::detail::append_checksum(bytes);
    return bytes;
}

}  // namespace musim::tests
