#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Values as bytes, in the machine's own form: `archive(a, b, c)` writes them one after another, or reads them back in the same order, so
/// that one list of fields serves both ways. A type takes part through a function `exchange(Archive&, Type&)` beside it.
///
/// Reading throws std::runtime_error when the bytes end too soon; it never takes more memory than a small multiple of them.
class Archive {
  public:
    /// Writes.
    Archive() = default;
    /// Reads `bytes`, which must outlive it.
    explicit Archive(std::string_view bytes) : loads_(true), source_(bytes) {}

    bool loads() const { return loads_; }
    std::string_view bytes() const { return written_; }             ///< written so far
    std::size_t remaining() const { return source_.size(); }        ///< not yet read
    void finish() const;                                            ///< throws unless all bytes have been read
    [[noreturn]] static void fail(std::string_view what_is_wrong);  ///< throws std::runtime_error

    template <class... Fields>
    void operator()(Fields&... fields) {
        (add(fields), ...);
    }

  private:
    template <class T>
    static constexpr bool kPlain = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;

    void raw(void* data, std::size_t size);
    /// Number of elements that follow, each of `least` bytes or more.
    std::size_t count(std::size_t size, std::size_t least);

    template <class T>
    void add(T& value) {
        if constexpr (kPlain<T>) {
            raw(&value, sizeof value);
        } else {
            exchange(*this, value);
        }
    }
    void add(bool& value) {
        auto byte = static_cast<std::uint8_t>(value ? 1 : 0);
        raw(&byte, 1);
        value = byte != 0;
    }
    template <class Scalar, int Rows, int Columns>
    void add(Eigen::Matrix<Scalar, Rows, Columns>& matrix) {
        static_assert(Rows > 0 && Columns > 0);
        raw(matrix.data(), sizeof(Scalar) * static_cast<std::size_t>(Rows * Columns));
    }
    void add(Quaternion& q) { add(q.coeffs()); }
    void add(std::string& text) {
        text.resize(count(text.size(), 1));
        raw(text.data(), text.size());
    }
    template <class T, std::size_t N>
    void add(std::array<T, N>& values) {
        for (T& value : values) add(value);
    }
    template <class T>
    void add(std::vector<T>& values) {
        if constexpr (kPlain<T>) {
            values.resize(count(values.size(), sizeof(T)));
            raw(values.data(), values.size() * sizeof(T));
        } else {
            // one by one, so that a wrong count ends with the bytes
            const std::size_t size = count(values.size(), 1);
            if (loads_) values.clear();
            for (std::size_t i = 0; i < size; ++i) {
                if (loads_) values.emplace_back();
                add(values[i]);
            }
        }
    }
    template <class T>
    void add(std::optional<T>& value) {
        bool has = value.has_value();
        add(has);
        if (loads_) value = has ? std::optional<T>(T{}) : std::nullopt;
        if (value) add(*value);
    }

    bool loads_ = false;
    std::string written_;
    std::string_view source_;
};

/// Kind of a file and version of its layout; another number of the version is another format.
struct ArchiveKind {
    std::array<char, 8> name;
    std::uint32_t version;
    const char* what;  ///< what messages call it
};

/// 64-bit hash of bytes; any change within one word of eight bytes changes it.
std::uint64_t hash_bytes(std::string_view bytes);

/// Bytes under a seal: kind, byte order, version, length, the bytes (words of zeros left out), checksum of all these. Throws
/// std::ios_base::failure when the stream does not take them.
void write_sealed(std::ostream& out, const ArchiveKind& kind, std::string_view bytes);

/// The bytes again; reads no further than the seal. Throws std::runtime_error `WHAT: ...` for another kind, byte order or version, and for
/// what is cut off or damaged. Takes no more memory than 64 times what the stream holds.
std::string read_sealed(std::istream& in, const ArchiveKind& kind);

}  // namespace musim::lsdem
