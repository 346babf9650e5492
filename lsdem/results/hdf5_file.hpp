#pragma once

#include <hdf5.h>

#include <cstddef>
#include <string>
#include <vector>

namespace musim::lsdem::detail {

/// Owns one HDF5 identifier and closes it with the function of its kind. Throws std::runtime_error on an invalid identifier.
class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);

    Hdf5Handle(hid_t id, Close close, const std::string& what);
    ~Hdf5Handle();
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;

    operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands in for the raw identifier

  private:
    hid_t id_;
    Close close_;
};

/// An HDF5 file built in memory. Its bytes are written by whoever wants them: a full disk is then an ordinary failed write, which the
/// HDF5 library itself does not survive when it meets it in H5Fclose.
class Hdf5File {
  public:
    Hdf5File();

    /// Row-major dataset `path` ("/group/name", groups are made) with the attribute `units`.
    void write(const std::string& path, const std::vector<hsize_t>& shape, const double* values, const std::string& units);
    void write(const std::string& path, const std::vector<hsize_t>& shape, const float* values, const std::string& units);
    void write(const std::string& path, const std::vector<hsize_t>& shape, const long long* values, const std::string& units);

    /// Text attribute of the file itself.
    void write_attribute(const std::string& name, const std::string& text);

    /// The file as bytes, with its checksum at the end (see append_checksum).
    std::vector<char> image() const;

  private:
    void write_dataset(const std::string& path, const std::vector<hsize_t>& shape, hid_t memory_type, hid_t file_type, const void* values,
                       const std::string& units);

    Hdf5Handle file_;
};

}  // namespace musim::lsdem::detail
