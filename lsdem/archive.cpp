#include "lsdem/archive.hpp"

#include <algorithm>
#include <cstring>
#include <istream>
#include <ostream>
#include <stdexcept>

namespace musim::lsdem {
namespace {

/// Reads otherwise on a machine of the other byte order.
constexpr std::uint32_t kByteOrder = 0x01020304;

/// Bytes asked of a stream at once, so that a wrong length costs no memory.
constexpr std::size_t kPiece = 1 << 20;

[[noreturn]] void refuse(const ArchiveKind& kind, const std::string& what_is_wrong) {
    throw std::runtime_error(std::string(kind.what) + ": " + what_is_wrong);
}

/// The next `size` bytes, appended.
void take(std::istream& in, std::uint64_t size, const ArchiveKind& kind, std::string& bytes) {
    while (size > 0) {
        const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(size, kPiece));
        const std::size_t before = bytes.size();
        bytes.resize(before + piece);
        in.read(bytes.data() + before, static_cast<std::streamsize>(piece));
        if (static_cast<std::size_t>(in.gcount()) != piece) refuse(kind, "it is cut off");
        size -= piece;
    }
}

constexpr std::size_t kWord = sizeof(std::uint64_t);
constexpr std::size_t kRow = 64;  ///< words that share a mask

/// The word that starts at a byte; past the end come zeros.
std::uint64_t word_at(std::string_view bytes, std::size_t at) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(kWord, bytes.size() - at));
    return word;
}

void append(std::uint64_t word, std::string& bytes) { bytes.append(reinterpret_cast<const char*>(&word), kWord); }

/// Leaves out words that are zero: histories of contacts that do not touch or slip. The length, then of every 64 words a mask of those that
/// are not zero, and these.
std::string pack(std::string_view bytes) {
    std::string packed;
    packed.reserve(bytes.size() / 2);
    append(bytes.size(), packed);
    for (std::size_t row = 0; row < bytes.size(); row += kRow * kWord) {
        const std::size_t mask_at = packed.size(), end = std::min(bytes.size(), row + kRow * kWord);
        std::uint64_t mask = 0;
        append(mask, packed);
        for (std::size_t at = row; at < end; at += kWord) {
            const std::uint64_t word = word_at(bytes, at);
            if (word == 0) continue;
            mask |= std::uint64_t{1} << (at - row) / kWord;
            append(word, packed);
        }
        std::memcpy(packed.data() + mask_at, &mask, kWord);
    }
    return packed;
}

std::string unpack(std::string_view packed) {
    const auto next = [&] {
        if (packed.size() < kWord) Archive::fail("it ends too soon");
        const std::uint64_t word = word_at(packed, 0);
        packed.remove_prefix(kWord);
        return word;
    };
    const std::uint64_t size = next();
    if (size / (kRow * kWord) > packed.size() / kWord) Archive::fail("it ends too soon");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    for (std::size_t row = 0; row < bytes.size(); row += kRow * kWord) {
        const std::uint64_t mask = next();
        const std::size_t end = std::min(bytes.size(), row + kRow * kWord);
        for (std::size_t at = row; at < end; at += kWord) {
            if ((mask >> (at - row) / kWord & 1U) == 0) continue;
            const std::uint64_t word = next();
            std::memcpy(bytes.data() + at, &word, std::min(kWord, bytes.size() - at));
        }
    }
    if (!packed.empty()) Archive::fail("it holds more than it should");
    return bytes;
}

struct Head {
    std::array<char, 8> name{};
    std::uint32_t byte_order = kByteOrder;
    std::uint32_t version = 0;
    std::uint64_t size = 0;
};

void exchange(Archive& archive, Head& head) { archive(head.name, head.byte_order, head.version, head.size); }

constexpr std::size_t kHeadSize = 24;

}  // namespace

void Archive::fail(std::string_view what_is_wrong) { throw std::runtime_error("saved state: " + std::string(what_is_wrong)); }

void Archive::finish() const {
    if (loads_ && !source_.empty()) fail("it holds more than it should");
}

void Archive::raw(void* data, std::size_t size) {
    if (size == 0) return;
    if (!loads_) {
        written_.append(static_cast<const char*>(data), size);
        return;
    }
    if (size > source_.size()) fail("it ends too soon");
    std::memcpy(data, source_.data(), size);
    source_.remove_prefix(size);
}

std::size_t Archive::count(std::size_t size, std::size_t least) {
    auto value = static_cast<std::uint64_t>(size);
    raw(&value, sizeof value);
    if (loads_ && value > source_.size() / least) fail("it ends too soon");
    return static_cast<std::size_t>(value);
}

std::uint64_t hash_bytes(std::string_view bytes) {
    // FNV-1a by words, the high half folded into the low one so that every bit reaches every other
    std::uint64_t hash = 14695981039346656037ULL ^ bytes.size();
    for (std::size_t at = 0; at < bytes.size(); at += kWord) {
        hash = (hash ^ word_at(bytes, at)) * 1099511628211ULL;
        hash ^= hash >> 32U;
    }
    return hash;
}

void write_sealed(std::ostream& out, const ArchiveKind& kind, std::string_view bytes) {
    const std::string packed = pack(bytes);
    Head head{.name = kind.name, .version = kind.version, .size = packed.size()};
    Archive sealed;
    sealed(head);
    std::uint64_t sum = hash_bytes(sealed.bytes()) ^ hash_bytes(packed);
    Archive seal;
    seal(sum);
    for (const std::string_view part : {sealed.bytes(), std::string_view(packed), seal.bytes()})
        out.write(part.data(), static_cast<std::streamsize>(part.size()));
    if (!out) throw std::ios_base::failure(std::string(kind.what) + ": cannot be written");
}

std::string read_sealed(std::istream& in, const ArchiveKind& kind) {
    std::string first;
    take(in, kHeadSize, kind, first);
    Head head;
    Archive opened{std::string_view(first)};
    opened(head);
    if (head.name != kind.name) refuse(kind, "this is something else");
    if (head.byte_order != kByteOrder) refuse(kind, "it was written on a machine of another byte order");
    if (head.version != kind.version) {
        refuse(kind, "it has format " + std::to_string(head.version) + ", this program reads format " + std::to_string(kind.version) +
                         "; continue it with the program that wrote it");
    }
    std::string packed, last;
    take(in, head.size, kind, packed);
    std::uint64_t sum = 0;
    take(in, sizeof sum, kind, last);
    Archive(std::string_view(last))(sum);
    if (sum != (hash_bytes(first) ^ hash_bytes(packed))) refuse(kind, "it is damaged (its checksum does not match)");
    return unpack(packed);
}

}  // namespace musim::lsdem
