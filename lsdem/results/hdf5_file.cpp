#include "lsdem/results/hdf5_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "lsdem/results/checksum.hpp"

namespace musim::lsdem::detail {
namespace {

/// Growth of the file in memory [bytes]: large enough for few reallocations, small enough not to matter for a small run.
constexpr std::size_t kMemoryIncrement = std::size_t{4} << 20U;

void require(herr_t status, const std::string& what) {
    if (status < 0) throw std::runtime_error("HDF5 cannot " + what);
}

std::recursive_mutex& library_mutex() {
    static std::recursive_mutex mutex;
    return mutex;
}

/// Equal results are equal files: none says when it was made.
void leave_out_times(hid_t creation) { require(H5Pset_obj_track_times(creation, 0), "leave out times"); }

hid_t create_file_in_memory() {
    // the library would print its own error stack to stderr; ours is the exception
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "create file properties");
    require(H5Pset_fapl_core(access, kMemoryIncrement, 0), "use its memory driver");
    // a root group that tracks its attributes' order has the object header of HDF5 1.8, which lifts the 64 KiB limit of an attribute that
    // the scene of a large structure passes; asking for the format of 1.8 altogether spoils the superblock's checksum in H5Fget_file_image
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "create file properties");
    require(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED), "track attributes");
    leave_out_times(creation);
    return H5Fcreate("musim-result", H5F_ACC_TRUNC, creation, access);
}

hid_t make_text_type(std::size_t size) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    require(H5Tset_size(type, size), "size a text type");
    require(H5Tset_cset(type, H5T_CSET_UTF8), "use UTF-8");
    return type;
}

void write_text_attribute(hid_t owner, const std::string& name, const std::string& text) {
    const Hdf5Handle type(make_text_type(text.size() + 1), H5Tclose, "create a text type");
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "create a data space");
    const Hdf5Handle attribute(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "create " + name);
    require(H5Awrite(attribute, type, text.c_str()), "write " + name);
}

}  // namespace

Hdf5Lock::Hdf5Lock() : lock_(library_mutex()) {}

Hdf5Handle::Hdf5Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) throw std::runtime_error("HDF5 cannot " + what);
}

Hdf5Handle::~Hdf5Handle() { close_(id_); }

Hdf5File::Hdf5File() : file_(create_file_in_memory(), H5Fclose, "create a file in memory") {}

void Hdf5File::write_attribute(const std::string& name, const std::string& text) {
    const Hdf5Handle root(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose, "open the root group");
    write_text_attribute(root, name, text);
}

void Hdf5File::write_texts(const std::string& path, const std::vector<std::string>& texts) {
    std::size_t longest = 0;
    for (const std::string& text : texts) longest = std::max(longest, text.size());
    std::string padded;
    for (const std::string& text : texts) padded += text + std::string(longest + 1 - text.size(), '\0');
    const Hdf5Handle type(make_text_type(longest + 1), H5Tclose, "create a text type");
    write_dataset(path, {texts.size()}, {.memory = type, .file = type}, padded.data(), "1");
}

std::vector<char> Hdf5File::image() const {
    require(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    if (size < 0) throw std::runtime_error("HDF5 cannot size its file image");
    std::vector<char> bytes(static_cast<std::size_t>(size));
    if (H5Fget_file_image(file_, bytes.data(), bytes.size()) != size) throw std::runtime_error("HDF5 cannot copy its file image");
    append_checksum(bytes);
    return bytes;
}

void Hdf5File::write_dataset(const std::string& path, const std::vector<hsize_t>& shape, const Hdf5Types& types, const void* values,
                             const std::string& units) {
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "create link properties");
    require(H5Pset_create_intermediate_group(links, 1), "create groups");
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "create a data space");
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create data properties");
    leave_out_times(creation);
    const Hdf5Handle set(H5Dcreate2(file_, path.c_str(), types.file, space, links, creation, H5P_DEFAULT), H5Dclose, "create " + path);
    require(H5Dwrite(set, types.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write " + path);
    write_text_attribute(set, "units", units);
}

}  // namespace musim::lsdem::detail
