#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

/// docs/validation/damaged_records.md says what a reader answers to each damage; here each file is made, read, and the answer compared.
namespace musim::records {
namespace {

using Edit = std::function<std::string(std::string)>;

Edit cut_after(std::size_t bytes) {
    return [=](const std::string& whole) { return whole.substr(0, bytes); };
}

Edit cut_at(std::string mark) {
    return [=](const std::string& whole) {
        const std::size_t at = whole.find(mark);
        REQUIRE(at != std::string::npos);
        return whole.substr(0, at);
    };
}

Edit replace(std::string from, std::string to) {
    return [=](std::string whole) { return tests::replaced(std::move(whole), from, to); };
}

Edit append(std::string text) {
    return [=](std::string whole) { return std::move(whole) + text; };
}

/// Each of the lines as long as `at` or longer loses the rest of it.
Edit narrow(std::size_t line, std::size_t at) {
    return [=](std::string whole) {
        std::size_t from = 0;
        for (std::size_t i = 1; i < line; ++i) from = whole.find('\n', from) + 1;
        return whole.erase(from + at, whole.find('\n', from) - from - at);
    };
}

std::string twice(const std::string& whole) { return whole + whole; }

std::string with_crlf(const std::string& whole) {
    std::string text;
    for (const char letter : whole) {
        if (letter == '\r') continue;
        text += letter == '\n' ? "\r\n" : std::string(1, letter);
    }
    return text;
}

std::string without_last_newline(std::string whole) { return whole.substr(0, whole.find_last_not_of("\r\n") + 1); }

/// An item of the page: a damage, and the shared record that suffers it; without one, the edit makes the whole file.
struct Damage {
    std::string_view file;
    std::string_view what;
    Edit edit;
    ReadOptions options = {};
};

std::string binary_data(const std::string&) {
    std::string bytes;
    for (int i = 0; i < 4096; ++i) bytes += static_cast<char>(i % 256);
    return bytes;
}

const std::string kCsv =
    "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\ntime_s,1\n0,1\n0.01,2\n0.02,3\n";
const std::string kColumns = "0.00 1.0\n0.01 2.0\n0.02 -3.0\n0.03 1.0\n0.04 0.5\n";

Edit whole_file(std::string text) {
    return [=](const std::string&) { return text; };
}

const std::vector<Damage>& damages() {
    static const std::vector<Damage> all = {
        {"", "blank lines only", whole_file("\n\n\n")},
        {"", "binary data of no known format", binary_data},
        {"", "prose", whole_file("The record of the main shock\nis in the other folder.\n")},
        {"", "a web page", whole_file("<!DOCTYPE html>\n<html><body>404 Not Found</body></html>\n")},
        {"peer/ARL360.at2", "cut after 10,000 bytes", cut_after(10000)},
        {"peer/ARL360.at2", "cut within the header", cut_at("NPTS")},
        {"peer/ARL360.at2", "one sample too many", append("  .1000000E-03\n")},
        {"peer/ARL360.at2", "a letter in a sample", replace("-.9703132E-04", "-.97O3132E-04")},
        {"peer/ARL360.at2", "a sample NaN", replace("-.9703132E-04", "          NaN")},
        {"peer/ARL360.at2", "a sample 1E999", replace("-.9703132E-04", "       1.E999")},
        {"peer/ARL360.at2", "NPTS= without a number", replace("NPTS=  2000", "NPTS=      ")},
        {"peer/ARL360.at2", "NPTS= 1000000000000", replace("NPTS=  2000", "NPTS= 1000000000000")},
        {"peer/ARL360.at2", "NPTS= -2000", replace("NPTS=  2000", "NPTS= -2000")},
        {"peer/ARL360.at2", "DT= 0", replace("DT= .02000", "DT= .00000")},
        {"peer/ARL360.at2", "DT= -.02", replace("DT= .02000", "DT=-.02000")},
        {"peer/ARL360.at2", "unit FURLONG", replace("UNITS OF G", "UNITS OF FURLONG")},
        {"peer/ARL360.at2", "the record twice in one file", twice},
        {"peer/ARL360.at2", "another unit asked for", {}, {.unit = "cm/s^2"}},
        {"peer/ARL360.at2", "lines end in CR LF", with_crlf},
        {"peer/ARL360.at2", "a Latin-1 letter in the header", replace("ARLETA", "ARL\xC9TA")},
        {"peer/ARL360.at2", "no newline at the end", without_last_newline},
        {"csmip/CICLC.v1", "cut after 100,000 bytes", cut_after(100000)},
        {"csmip/ce23583r_HESPERIA.RAW", "a letter in a sample", replace(" -.000116", " -.O00116")},
        {"csmip/chan001.v2", "cut in the displacements", cut_after(350000)},
        {"csmip/chan001.v2", "12999 points announced", replace("13000 points of accel", "12999 points of accel")},
        {"csmip/chan001.v2", "time step 0.004 in words", replace("spaced at 0.005", "spaced at 0.004")},
        {"csmip/BadHeader.V2", "as it was found", {}},
        {"csmip/CE89146.V3", "spectra, as published", {}},
        {"cosmos/Cosmos12TimeSeriesTest.v1", "cut after 40,000 bytes", cut_after(40000)},
        {"cosmos/Cosmos12TimeSeriesTest.v1", "another peak in the header", replace("-161.962000", "-261.962000")},
        {"cosmos/Cosmos12TimeSeriesTest.v1", "no unit", replace("units=cm/sec2", "cm/sec2")},
        {"cosmos/Cosmos12TimeSeriesTest2.v1", "as it was found", {}},
        {"smc/A-CAT090.AT2.smc", "cut after 20,000 bytes", cut_after(20000)},
        {"smc/A-CAT090.AT2.smc", "1647 samples announced", replace("      1646", "      1647")},
        {"smc/A-CAT090.AT2.smc", "sampling rate 0", replace("0.5000000E+02", "0.0000000E+00")},
        {"usc/017m30bt.s0a", "cut after 50,000 bytes", cut_after(50000)},
        {"bhrc/5526-1.V1", "cut after 100,000 bytes", cut_after(100000)},
        {"knet/test.knet", "cut after 40,000 bytes", cut_after(40000)},
        {"knet/test.knet", "scale factor over 0", replace("2000(gal)/8388608", "2000(gal)/0")},
        {"knet/test.knet", "another maximum in the header", replace("4.383", "4.483")},
        {"esm/20101114230825_3104_ap_RawAcc_E.asc", "5601 samples announced", replace("NDATA: 5600", "NDATA: 5601")},
        {"esm/20101114230825_3104_ap_RawAcc_E.asc", "one sample too many", append("0.1\n")},
        {"esm/20101114230825_3104_ap_RawAcc_E.asc", "unit cm", replace("UNITS: cm/s^2", "UNITS: cm")},
        {"geonet/20180212_211557_WPWS_20.V2A", "cut after 200,000 bytes", cut_after(200000)},
        {"afad/20170720223109_4812.txt", "9179 samples announced", replace(": 9178", ": 9179")},
        {"afad/20170720223109_4812.txt", "a letter in a sample", replace("-0.006497", "-0.0O6497")},
        {"unam/CUP50401.012", "cut after 300,000 bytes", cut_after(300000)},
        {"cwa/1-EAS.dat", "a row without its time", replace("     0.020     0.000", "     0.000     0.000")},
        {"cwa/1-EAS.dat", "a rate of 40 Hz", replace("SampleRate(Hz): 50", "SampleRate(Hz): 40")},
        {"bbp/2002-SYL.bbp", "a row cut short", narrow(12, 30)},
        {"sac/ALCTENE.UW..sac", "unit not given", {}},
        {"sac/ALCTENE.UW..sac", "cut after 20,000 bytes", cut_after(20000), {.unit = "cm/s^2"}},
        {"mseed/CI.LRL..HNE.mseed", "sensitivity not given", {}},
        {"mseed/CI.LRL..HNE.mseed", "cut within its last record", cut_after(96000), {.sensitivity = 1.0}},
        {"mseed/CI.LRL..HNE.mseed", "without its second record", [](std::string w) { return w.erase(512, 512); }, {.sensitivity = 1.0}},
        {"mseed/CI.LRL..HNE.mseed", "a byte of its samples flipped", [](std::string w) { return w[300] ^= 0x40, w; }, {.sensitivity = 1.0}},
        {"musim.csv", "a row missing", whole_file(tests::replaced(kCsv, "0.01,2\n", ""))},
        {"musim.csv", "a decimal comma", whole_file(tests::replaced(kCsv, "0.01,2", "0,01,2"))},
        {"musim.csv", "a sample inf", whole_file(tests::replaced(kCsv, "0.01,2", "0.01,inf"))},
        {"musim.csv", "no unit", whole_file(tests::replaced(kCsv, "# unit: m/s^2\n", ""))},
        {"columns.txt", "uneven times", whole_file(tests::replaced(kColumns, "0.02 ", "0.024 ")), {.unit = "g"}},
        {"columns.txt", "a row with one number", whole_file(tests::replaced(kColumns, "-3.0", "")), {.unit = "g"}},
        {"columns.txt", "a sample nan", whole_file(tests::replaced(kColumns, "-3.0", "nan")), {.unit = "g"}},
        {"columns.txt", "decimal commas", whole_file("0,00 1,0\n0,01 2,0\n0,02 3,0\n"), {.unit = "g"}},
        {"columns.txt", "decimal commas, one column", whole_file("1,0\n2,0\n-3,0\n"), {.dt = 0.01 * scaling::si::seconds, .unit = "g"}},
        {"columns.txt", "one column, time step not given", whole_file("1.0\n2.0\n-3.0\n"), {.unit = "g"}},
    };
    return all;
}

/// Answer of a reader to the file: its message without the folder, or that the samples are those of the sound file.
std::string answer(const std::filesystem::path& file, const ReadOptions& options, const std::filesystem::path& sound) {
    try {
        const GroundMotion motion = read_record(file, options);
        if (sound.empty()) return "read";
        const GroundMotion whole = read_record(sound, options);
        const auto is_same = [](const Component& a, const Component& b) { return a.series == b.series; };
        return std::equal(motion.components.begin(), motion.components.end(), whole.components.begin(), whole.components.end(), is_same)
                   ? "*read, the same samples*"
                   : "read, other samples";
    } catch (const ReadError& error) {
        std::string message = error.what();
        const std::string folder = file.parent_path().string() + "/";
        for (std::size_t at = message.find(folder); at != std::string::npos; at = message.find(folder)) message.erase(at, folder.size());
        return "`" + message + "`";
    }
}

/// Words of the page about a damage, on one line: the heading with the file, and the item below it.
std::string row_of(std::string_view file, std::string_view what, std::string_view answer) {
    return "## `" + std::string(file.empty() ? "file.txt" : file) + "` - " + std::string(what) + ": " + std::string(answer);
}

/// Damages that no content can show: what stands at the path is no file that can be read.
std::vector<std::string> rows_of_paths(const tests::TemporaryFolder& folder) {
    std::vector<std::string> rows;
    const auto add = [&](std::string_view what, const std::filesystem::path& path) {
        rows.push_back(row_of("file.txt", what, answer(path, {}, {})));
    };
    const std::filesystem::path path = folder.path() / "file.txt";
    add("does not exist", path);
    std::filesystem::create_directory(path);
    add("is a folder", path);
    std::filesystem::remove(path);
    folder.write("file.txt", "");
    add("is empty", path);
    std::filesystem::resize_file(path, std::uintmax_t{2} << 30U);  // no byte of it is stored
    add("has 2 GiB", path);
    return rows;
}

std::vector<std::string> make_rows() {
    const tests::TemporaryFolder folder;
    std::vector<std::string> rows = rows_of_paths(folder);
    for (const Damage& damage : damages()) {
        const std::filesystem::path shared = tests::shared_records() / damage.file;
        const bool is_shared = !damage.file.empty() && std::filesystem::is_regular_file(shared);
        const std::string whole = is_shared ? tests::bytes_of(shared) : std::string();
        const std::filesystem::path name = damage.file.empty() ? "file.txt" : std::filesystem::path(damage.file).filename();
        const auto path = folder.write(name.string(), damage.edit ? damage.edit(whole) : whole);
        rows.push_back(row_of(damage.file, damage.what, answer(path, damage.options, is_shared ? shared : std::filesystem::path())));
    }
    return rows;
}

std::vector<std::string> read_documented_rows() {
    std::ifstream file(std::filesystem::path(MUSIM_SOURCE_DIR) / "docs/validation/damaged_records.md");
    std::string heading;
    std::vector<std::string> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) heading = line;
        if (heading.empty()) continue;
        if (line.starts_with("- ")) rows.push_back(heading + " " + line);
        if (line.starts_with("  ") && !rows.empty()) rows.back() += line.substr(1);  // an item goes on
    }
    return rows;
}

TEST_CASE("every damaged file of docs is answered as it says there") {
    if (!tests::have_shared_records()) return;
    const std::vector<std::string> rows = make_rows(), documented = read_documented_rows();
    CHECK(rows.size() == documented.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string expected = i < documented.size() ? documented[i] : std::string();
        CHECK_MESSAGE(rows[i] == expected, "docs/validation/damaged_records.md should say\n", rows[i], "\nand says\n", expected);
    }
}

}  // namespace
}  // namespace musim::records
