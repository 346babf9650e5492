#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "records/formats/detail/parsers.hpp"
#include "records/formats/read_record.hpp"
#include "records/formats/write_record.hpp"
#include "records/processing/base_motion.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

// reads whatever the bytes are: a valid record or a ReadError, nothing else; true when it was a record
bool is_read(const tests::TemporaryFolder& folder, std::string_view bytes, const ReadOptions& options = {}) {
    const auto path = folder.write("damaged", bytes);
    try {
        const GroundMotion motion = read_record(path, options);
        REQUIRE_FALSE(motion.components.empty());
        for (const Component& component : motion.components) {
            REQUIRE(component.series.size() > 0);
            REQUIRE(component.series.dt().value() > 0.0);
        }
        return true;
    } catch (const ReadError& error) {
        const std::string message = error.what();
        CAPTURE(message);
        CHECK(message.find("damaged") != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
        return false;
    }
}

// cuts at many places, flips single bytes, and repeats pieces
void damage(const std::string& whole, int rounds, unsigned seed, const ReadOptions& options = {}) {
    const tests::TemporaryFolder folder;
    CHECK(is_read(folder, whole, options));
    std::mt19937 random(seed);
    int refused = 0;
    for (int i = 0; i < rounds; ++i) {
        refused += is_read(folder,
                           std::string_view(whole).substr(0, whole.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(rounds)),
                           options)
                       ? 0
                       : 1;

        std::string flipped = whole;
        for (int flip = 0; flip <= i % 4; ++flip) flipped[random() % whole.size()] = static_cast<char>(random() % 256);
        is_read(folder, flipped, options);

        std::string header_flipped = whole;
        header_flipped[random() % std::min<std::size_t>(whole.size(), 3000)] = static_cast<char>(random() % 256);
        is_read(folder, header_flipped, options);

        std::string repeated = whole;
        const std::size_t from = random() % whole.size();
        const std::size_t length = random() % 500;
        repeated.insert(random() % whole.size(), whole.substr(from, length));
        is_read(folder, repeated, options);
    }
    CHECK(refused > 0);
}

TEST_CASE("a damaged PEER file or CSV is a record or a ReadError, never a crash") {
    const GroundMotion motion = make_synthetic_record({.dt = 0.02 * scaling::si::seconds, .duration = 4.0 * scaling::si::seconds});
    const tests::TemporaryFolder folder;
    write_at2(folder.path() / "a.at2", motion, "1");
    write_csv(folder.path() / "a.csv", motion);

    damage(tests::bytes_of(folder.path() / "a.at2"), 300, 1);
    damage(tests::bytes_of(folder.path() / "a.csv"), 300, 2);
}

TEST_CASE("every reader of text refuses a file without a letter, though nobody asked it what the file looks like") {
    for (const auto parse : {detail::parse_afad, detail::parse_asa, detail::parse_at2, detail::parse_bbp, detail::parse_bhrc,
                             detail::parse_cosmos, detail::parse_csmip, detail::parse_csmnc, detail::parse_cwa, detail::parse_deepsoil,
                             detail::parse_esm, detail::parse_geonet, detail::parse_jma, detail::parse_knet, detail::parse_shake,
                             detail::parse_slist, detail::parse_smc, detail::parse_text, detail::parse_usc}) {
        for (const std::string_view content : {"", "\n", " \n \n"})
            CHECK_THROWS_AS(parse(detail::TextFile("blank", std::string(content)), {}), ReadError);
    }
}

TEST_CASE("a file too large to be a record is refused before it is read") {
    const tests::TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "big.at2";
    std::ofstream(path) << "x";
    std::filesystem::resize_file(path, std::uintmax_t{2} << 30U);  // no byte of it is stored
    CHECK_THROWS_WITH_AS(read_record(path),
                         (path.string() + ": file has 2.15 GB (more than 1.07 GB is no record); cut it into shorter records").c_str(),
                         ReadError);
}

TEST_CASE("damaged real records are records or ReadErrors, never a crash") {
    if (!tests::have_shared_records()) return;
    for (const std::string_view file :
         {"csmip/ce36456p_CE36456.V2", "cosmos/Cosmos12TimeSeriesTest.v1", "smc/A-CAT090.AT2.smc", "smc/0111a.smc", "usc/017m30cc.y0a",
          "usc/017m30bt.s0a", "peer/elCentro.at2", "peer/ANLA196.AT2", "text/RSN143_TABAS_TAB-L1.AT2.csv", "knet/test.knet",
          "esm/20101114230825_3104_ap_RawAcc_E.asc", "geonet/20180212_211557_WPWS_20.V2A", "afad/20170720223109_4812.txt",
          "unam/CUP50401.012", "cwa/1-EAS.dat"}) {
        CAPTURE(file);
        damage(tests::bytes_of(tests::shared_records() / file), 40, 3);
    }
}

TEST_CASE("damaged records of formats that few networks write are records or ReadErrors, never a crash") {
    const std::filesystem::path cases = tests::shared_records() / ".." / "cases" / "records";
    if (!std::filesystem::is_directory(cases)) {
        MESSAGE("skipped: there are no cases in ../shared/cases/records");
        return;
    }
    const scaling::Time step = 0.005 * scaling::si::seconds;
    damage(tests::bytes_of(cases / "csmnc_china.dat"), 60, 7);
    damage(tests::bytes_of(cases / "deepsoil.txt"), 60, 8);
    damage(tests::bytes_of(cases / "shake_8f9.txt"), 60, 9, {.dt = step});
    damage(tests::bytes_of(cases / "miniseed3.mseed3"), 60, 10, {.sensitivity = 1.0});
}

TEST_CASE("damaged binary records are records or ReadErrors, never a crash") {
    if (!tests::have_shared_records()) return;
    damage(tests::bytes_of(tests::shared_records() / "sac/ALCTENE.UW..sac"), 100, 4, {.unit = "cm/s^2"});
    damage(tests::bytes_of(tests::shared_records() / "mseed/CI.CLC..HNE.mseed"), 100, 5, {.sensitivity = 1.0});
    damage(tests::bytes_of(tests::shared_records() / "mseed/CI.LRL..HNE.mseed"), 100, 6, {.sensitivity = 1.0});
}

TEST_CASE("a record cut anywhere before its end mark is refused") {
    if (!tests::have_shared_records()) return;
    const tests::TemporaryFolder folder;
    // one channel only: a cut between channels leaves a whole record
    const std::string whole = tests::bytes_of(tests::shared_records() / "csmip/chan001.v2");
    for (std::size_t part = 1; part < 50; ++part) {
        CAPTURE(part);
        CHECK_FALSE(is_read(folder, std::string_view(whole).substr(0, whole.size() * part / 50)));
    }
}

}  // namespace
}  // namespace musim::records
