#pragma once

#include <hdf5.h>

#include <array>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// Keeps other threads off the HDF5 library, which need not be built for several, while it lives.
class Hdf5Lock {
  public:
    Hdf5Lock();

  private:
    std::unique_lock<std::recursive_mutex> lock_;
};

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

/// Types of a number in memory and in a file.
struct Hdf5Types {
    hid_t memory, file;
};
inline Hdf5Types types_of(double /*number*/) { return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE}; }
inline Hdf5Types types_of(float /*number*/) { return {H5T_NATIVE_FLOAT, H5T_IEEE_F32LE}; }
inline Hdf5Types types_of(long long /*number*/) { return {H5T_NATIVE_LLONG, H5T_STD_I64LE}; }

/// The numbers of a value in a file: one, or those of a vector or quaternion, which are a dimension of their own.
template <class Value>
struct Hdf5Numbers {
    using Number = std::conditional_t<std::is_floating_point_v<Value>, Value, long long>;
    static constexpr hsize_t kCount = 1;
    static constexpr bool kAsInMemory = std::is_same_v<Number, Value>;  ///< numbers stand in the file as they do in memory
    static std::array<Number, kCount> of(const Value& value) { return {static_cast<Number>(value)}; }
    static Value make(const Number* number) { return static_cast<Value>(*number); }
};
template <class Scalar, int Rows>
struct Hdf5Numbers<Eigen::Matrix<Scalar, Rows, 1>> {
    using Number = Scalar;
    static constexpr hsize_t kCount = Rows;
    static constexpr bool kAsInMemory = true;
    static_assert(sizeof(Eigen::Matrix<Scalar, Rows, 1>) == Rows * sizeof(Scalar));
    static Eigen::Matrix<Scalar, Rows, 1> make(const Number* numbers) { return Eigen::Map<const Eigen::Matrix<Scalar, Rows, 1>>(numbers); }
};
/// (w, x, y, z), the order of files; Eigen keeps w last.
template <>
struct Hdf5Numbers<Quaternion> {
    using Number = double;
    static constexpr hsize_t kCount = 4;
    static constexpr bool kAsInMemory = false;
    static std::array<Number, kCount> of(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
    static Quaternion make(const Number* q) { return {q[0], q[1], q[2], q[3]}; }
};

/// The shape of a dataset of so many values.
template <class Value>
std::vector<hsize_t> shape_of(std::vector<hsize_t> values) {
    if (Hdf5Numbers<Value>::kCount > 1) values.push_back(Hdf5Numbers<Value>::kCount);
    return values;
}

/// An HDF5 file built in memory. Its bytes are written by whoever wants them: a full disk is then an ordinary failed write, which the
/// HDF5 library itself does not survive when it meets it in H5Fclose. Other threads wait as long as one lives.
class Hdf5File {
  public:
    Hdf5File();

    /// Writes numbers, vectors or quaternions, as many as `shape` says, as the row-major dataset `path` ("/group/name", groups are made)
    /// with the attribute `units`. Hdf5Reader::exchange reads them, so that one list of datasets serves both ways.
    template <class Value>
    void exchange(const std::string& path, const std::vector<hsize_t>& shape, const std::vector<Value>& values, const std::string& units) {
        using Numbers = Hdf5Numbers<Value>;
        using Number = typename Numbers::Number;
        hsize_t count = 1;
        for (const hsize_t extent : shape) count *= extent;
        if (count != values.size()) throw std::logic_error(path + " has another number of values than its shape says");
        if constexpr (Numbers::kAsInMemory) {
            write_dataset(path, shape_of<Value>(shape), types_of(Number{}), values.data(), units);
        } else {
            std::vector<Number> numbers;
            numbers.reserve(values.size() * Numbers::kCount);
            for (const Value& value : values) {
                for (const Number number : Numbers::of(value)) numbers.push_back(number);
            }
            write_dataset(path, shape_of<Value>(shape), types_of(Number{}), numbers.data(), units);
        }
    }
    /// Number of values in a list that says so itself.
    template <class Value>
    static hsize_t count(const std::string& /*path*/, const std::vector<Value>& values) {
        return values.size();
    }

    /// Writes a list of texts, UTF-8, each padded with zeros to the longest.
    void write_texts(const std::string& path, const std::vector<std::string>& texts);
    /// Text attribute of the file itself.
    void write_attribute(const std::string& name, const std::string& text);

    /// The file as bytes, with its checksum at the end (see append_checksum).
    std::vector<char> image() const;

  private:
    void write_dataset(const std::string& path, const std::vector<hsize_t>& shape, const Hdf5Types& types, const void* values,
                       const std::string& units);

    Hdf5Lock lock_;
    Hdf5Handle file_;
};

}  // namespace musim::lsdem::detail
