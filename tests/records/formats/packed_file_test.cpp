#include <doctest/doctest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

#include "records/formats/detail/packed_file.hpp"
#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"

namespace musim::records {
namespace {

const std::string kPlainRecord = "0.00 0.1\n0.01 -0.2\n0.02 0.3\n";

std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    REQUIRE(deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    std::string input = bytes;
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(input.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

/// A file as a zip archive stores it.
struct StoredFile {
    std::string name;
    std::string bytes;
    std::uint16_t flags = 0;  ///< 1: encrypted
};

std::string little(std::uint32_t value, int bytes) {
    std::string raw;
    for (int i = 0; i < bytes; ++i) raw += static_cast<char>(value >> (8 * i) & 0xFFU);
    return raw;
}

// a zip archive of files that are stored as they are [APPNOTE.TXT 4.3]
std::string zipped(const std::vector<StoredFile>& files) {
    std::string archive, directory;
    for (const StoredFile& file : files) {
        const auto* const letters = reinterpret_cast<const Bytef*>(file.bytes.data());
        const auto checksum = static_cast<std::uint32_t>(crc32(0, letters, static_cast<uInt>(file.bytes.size())));
        const auto size = static_cast<std::uint32_t>(file.bytes.size());
        // version, flags, method (stored), time, date, checksum, sizes, lengths of name and extra field
        const std::string about = little(20, 2) + little(file.flags, 2) + little(0, 2) + little(0, 2) + little(33, 2) +
                                  little(checksum, 4) + little(size, 4) + little(size, 4) +
                                  little(static_cast<std::uint32_t>(file.name.size()), 2) + little(0, 2);
        directory += "PK\1\2" + little(20, 2) + about + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 4) +
                     little(static_cast<std::uint32_t>(archive.size()), 4) + file.name;
        archive += "PK\3\4" + about + file.name + file.bytes;
    }
    const auto count = static_cast<std::uint32_t>(files.size());
    return archive + directory + "PK\5\6" + little(0, 4) + little(count, 2) + little(count, 2) +
           little(static_cast<std::uint32_t>(directory.size()), 4) + little(static_cast<std::uint32_t>(archive.size()), 4) + little(0, 2);
}

bool can_unzip() {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", zipped({}));
    return tests::message_of<ReadError>([&] { read_record(path); }).find("does not unpack") == std::string::npos;
}

TEST_CASE("a record packed by gzip is the record, also in several members") {
    const tests::TemporaryFolder folder;
    const GroundMotion plain = read_record(folder.write("a", kPlainRecord));
    const GroundMotion packed = read_record(folder.write("a.gz", gzipped(kPlainRecord)));
    CHECK(packed.format == "text");
    CHECK(packed.components.front().series == plain.components.front().series);

    const std::string members = gzipped(kPlainRecord.substr(0, 12)) + gzipped(kPlainRecord.substr(12)) + std::string(8, '\0');
    CHECK(read_record(folder.write("b.gz", members)).components.front().series == plain.components.front().series);
}

TEST_CASE("a record in a zip file is the record, whatever folders lie beside it") {
    if (!can_unzip()) return;
    const tests::TemporaryFolder folder;
    const GroundMotion plain = read_record(folder.write("a", kPlainRecord));
    const auto path = folder.write("a.zip", zipped({{"data/", ""}, {"data/rec.txt", kPlainRecord}, {"__MACOSX/data/._rec.txt", "x"}}));
    const GroundMotion packed = read_record(path);
    CHECK(packed.components.front().series == plain.components.front().series);
    CHECK(packed.history.front().find("read text from rec.txt") == 0);
}

TEST_CASE("a defect within a packed file is reported with its line there") {
    tests::check_refused(gzipped("0.00 0.1\n0.01 x\n0.02 0.3\n"), "a:2: sample 2 is 'x'");
    if (!can_unzip()) return;
    tests::check_refused(zipped({{"rec.txt", "0.00 0.1\n0.01 x\n0.02 0.3\n"}}), "a/rec.txt:2: sample 2 is 'x'");
}

TEST_CASE("every defect of a gzip file is reported") {
    using tests::check_refused;
    const std::string good = gzipped(kPlainRecord);
    std::string flipped = good;
    flipped[good.size() - 6] = static_cast<char>(flipped[good.size() - 6] ^ 1);  // of the checksum
    check_refused(good.substr(0, good.size() - 4), "a: unpacks to 28 bytes, then ends (file is truncated)");
    check_refused(good.substr(0, 6), "a: unpacks to 0 bytes, then ends (file is truncated)");
    check_refused(flipped, "a: cannot be unpacked behind ");
    check_refused("\x1F\x8B no gzip", "a: cannot be unpacked behind 0 bytes (");
    check_refused(good + "abc", "a: bytes follow the packed data (file is damaged)");
    check_refused(gzipped(""), "a: packed file is empty (no header, no samples)");
    check_refused(gzipped(good), "a: holds a gzip archive (one is unpacked, none within another)");
    check_refused(gzipped(std::string(257, 'x') + "ustar  "), "a: holds a tar archive (one is unpacked, none within another)");
    check_refused("BZh91AY", "a: is a bzip2 archive (unpacked are .gz and .zip); unpack it first");
}

TEST_CASE("no more is unpacked than a record may have") {
    constexpr std::size_t kAllowed = 1'000'000;
    const std::string zeros(100 * kAllowed, '0');
    const auto message = [&](const std::string& bytes) {
        return tests::message_of<ReadError>([&] { detail::unpack({"a", bytes}, kAllowed); });
    };
    CHECK(message(gzipped(zeros)) == "a: unpacks to more than 0.001 GB (no record); cut it into shorter records");
    CHECK(detail::unpack({"a", gzipped(zeros.substr(0, kAllowed))}, kAllowed).bytes.size() == kAllowed);
    if (!can_unzip()) return;
    CHECK(message(zipped({{"b", zeros}})) == "a: b in the zip file unpacks to more than 0.001 GB (no record); cut it into shorter records");
}

TEST_CASE("every defect of a zip file is reported") {
    if (!can_unzip()) return;
    using tests::check_refused;
    const std::string good = zipped({{"rec.txt", kPlainRecord}});
    std::string flipped = good;
    flipped[good.find("-0.2")] = '+';
    check_refused(good.substr(0, good.size() - 4), "a: is no readable zip file (");
    check_refused(good.substr(0, 40), "a: is no readable zip file (");
    check_refused(flipped, "a: rec.txt in the zip file cannot be unpacked behind ");
    check_refused(zipped({}), "a: zip file holds no file (folders at most)");
    check_refused(zipped({{"data/", ""}}), "a: zip file holds no file (folders at most)");
    check_refused(zipped({{"a.txt", kPlainRecord}, {"b.txt", kPlainRecord}}),
                  "a: zip file holds 2 files: a.txt, b.txt (one record is read)");
    check_refused(zipped({{"rec.txt", kPlainRecord, 1}}), "a: rec.txt in the zip file is encrypted");
    check_refused(zipped({{"rec.txt", ""}}), "a/rec.txt: packed file is empty");
    check_refused(zipped({{"in.zip", good}}), "a/in.zip: holds a zip archive (one is unpacked, none within another)");
    std::vector<StoredFile> many;
    for (int i = 0; i < 15; ++i) many.push_back({"r" + std::to_string(i), kPlainRecord});
    check_refused(zipped(many), "r10, r11 and 3 more (one record is read)");
}

}  // namespace
}  // namespace musim::records
