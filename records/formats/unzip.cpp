#include <fmt/format.h>
#include <zip.h>

#include <memory>
#include <vector>

#include "records/detail/text.hpp"
#include "records/formats/detail/packed_file.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {
namespace {

struct DiscardZip {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseZipFile {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

/// A zip error with its text.
class ZipError {
  public:
    ZipError() { zip_error_init(&error_); }
    ZipError(const ZipError&) = delete;
    ZipError& operator=(const ZipError&) = delete;
    ~ZipError() { zip_error_fini(&error_); }

    zip_error_t* get() { return &error_; }
    std::string text() { return printable(zip_error_strerror(&error_)); }

  private:
    zip_error_t error_{};
};

using ZipArchive = std::unique_ptr<zip_t, DiscardZip>;

ZipArchive open_archive(const BinaryFile& file) {
    ZipError error;
    zip_source_t* const source = zip_source_buffer_create(file.bytes().data(), file.bytes().size(), 0, error.get());
    if (source == nullptr) throw std::bad_alloc();
    ZipArchive archive(zip_open_from_source(source, ZIP_RDONLY, error.get()));
    if (!archive) {
        zip_source_free(source);
        file.fail(fmt::format("is no readable zip file ({}; truncated or damaged)", error.text()), "fetch the record again");
    }
    return archive;
}

// folders, and what some systems put beside files
bool is_no_record(std::string_view name) {
    const std::string_view last = name.substr(name.rfind('/') + 1);
    return last.empty() || name.starts_with("__MACOSX/") || last.starts_with("._") || last == ".DS_Store" || last == "Thumbs.db";
}

/// A file of the archive.
struct ZipEntry {
    zip_uint64_t index = 0;
    std::string name = {};
};

ZipEntry find_only_entry(const BinaryFile& file, zip_t* archive) {
    std::vector<ZipEntry> entries;
    for (zip_uint64_t index = 0; index < static_cast<zip_uint64_t>(zip_get_num_entries(archive, 0)); ++index) {
        const char* const name = zip_get_name(archive, index, ZIP_FL_ENC_GUESS);
        if (name != nullptr && !is_no_record(name)) entries.push_back({index, printable(name)});
    }
    if (entries.empty()) file.fail("zip file holds no file (folders at most)", "fetch the record again");
    if (entries.size() == 1) return entries.front();

    constexpr std::size_t kNamed = 12;
    std::string names;
    for (std::size_t i = 0; i < std::min(entries.size(), kNamed); ++i) names += (i == 0 ? "" : ", ") + entries[i].name;
    if (entries.size() > kNamed) names += fmt::format(" and {} more", entries.size() - kNamed);
    file.fail(fmt::format("zip file holds {} files: {} (one record is read)", entries.size(), names), "unpack it and name one of them");
}

}  // namespace

NamedBytes unzip(const NamedBytes& packed, std::size_t largest) {
    const BinaryFile file(packed.path, packed.bytes);
    const ZipArchive archive = open_archive(file);
    const ZipEntry entry = find_only_entry(file, archive.get());
    const auto fail_entry = [&](std::string_view what_why, const Remedy& what_to_do) {
        file.fail(fmt::format("{} in the zip file {}", entry.name, what_why), what_to_do);
    };

    zip_stat_t about;
    zip_stat_init(&about);
    if (zip_stat_index(archive.get(), entry.index, 0, &about) == 0 && (about.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 &&
        about.encryption_method != ZIP_EM_NONE) {
        fail_entry("is encrypted", "unpack it first");
    }
    const std::unique_ptr<zip_file_t, CloseZipFile> opened(zip_fopen_index(archive.get(), entry.index, 0));
    if (!opened) fail_entry(fmt::format("cannot be opened ({})", printable(zip_strerror(archive.get()))), "unpack it first");

    NamedBytes unpacked{packed.path / entry.name, {}};
    std::vector<char> chunk(std::size_t{1} << 16U);
    for (zip_int64_t got = 1; got > 0;) {
        got = zip_fread(opened.get(), chunk.data(), chunk.size());
        if (got < 0) {
            fail_entry(fmt::format("cannot be unpacked behind {} bytes ({}; damaged)", unpacked.bytes.size(),
                                   printable(zip_file_strerror(opened.get()))),
                       "fetch the record again");
        }
        unpacked.bytes.append(chunk.data(), static_cast<std::size_t>(got));
        if (unpacked.bytes.size() > largest) {
            fail_entry(fmt::format("unpacks to more than {:.3g} GB (no record)", 1e-9 * static_cast<double>(largest)),
                       "cut it into shorter records");
        }
    }
    return unpacked;
}

}  // namespace musim::records::detail
