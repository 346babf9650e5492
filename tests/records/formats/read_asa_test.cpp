#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

const std::string kAsaFile =
    "*****\n                       INSTITUTO DE INGENIERIA, UNAM\nNOMBRE DE LA ESTACION                  : IDEI PATIO 5\n"
    "CLAVE DE LA ESTACION                   : CUP5\nNUMERO DE CANALES                      : 2\n"
    "ORIENTACION C1-C6 (rumbo;orientacion)  : /V/N90E\nINTERVALO DE MUESTREO, C1-C6 (s)       : /0.004/0.004\n"
    "FECHA DEL SISMO [GMT]                  : 2004/01/01\nHORA EPICENTRO (GMT)                   : 23:58:02.7\n"
    "HORA DE LA PRIMERA MUESTRA (GMT)       : 00:00:01\nNUM. TOTAL DE MUESTRAS, C1-C6          : /3/3\n"
    "ACEL. MAX.(Gal), C1-C6                 : /0.47/-1.19\nUNIDADES DE LOS DATOS                  : Gal (cm/s/s)\n"
    "DATOS DE ACELERACION:\n---------+---------+\n   CANAL-1   CANAL-2\n         V      N90E\n---------+---------+\n"
    "    -0.084    -1.189\n     0.470    -0.007\n     0.036     0.098\n";

TEST_CASE("an ASA file gives its channels, and a first sample after midnight is of the next day") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kAsaFile));

    CHECK(motion.format == "ASA 2.0");
    CHECK(motion.station == "CUP5, IDEI PATIO 5");
    CHECK(motion.event == "2004/01/01 23:58:02.7 GMT");
    CHECK(motion.time_zero == make_utc_time(2004, 1, 2, 0, 0, 1.0));
    REQUIRE(motion.integration_corner);
    CHECK(motion.component_names() == "V, N90E");
    CHECK_FALSE(motion.components[0].azimuth_deg);
    CHECK(motion.components[1].azimuth_deg == 90.0);
    CHECK(motion.components[1].series.dt().value() == 0.004);
    REQUIRE(motion.components[1].series.size() == 3);
    CHECK(motion.components[1].series.samples()[0] == relative(-0.01189, 1e-15));
}

TEST_CASE("an ASA file of another institute has other blanks, commas, brackets and a date in words") {
    const tests::TemporaryFolder folder;
    std::string text = replaced(kAsaFile, "*****\n                       INSTITUTO DE INGENIERIA, UNAM\n",
                                "*****\n     SOME CENTRE\n     SOME GROUP\nADDRESS\n*****\nARCHIVO ESTANDAR DE ACELERACION:\n");
    text = replaced(text, "/V/N90E", "/V;+/N90E;");
    text = replaced(text, "INTERVALO DE MUESTREO, C1-C6 (s) ", "INTERVALO DE MUESTREO, C1-C6, (s)");
    text = replaced(text, "FECHA DEL SISMO [GMT]                  : 2004/01/01",
                    "FECHA DEL SISMO (GMT)                  : 01 de ENERO del 2004");
    text = replaced(text, "ACEL. MAX.(Gal), C1-C6", "ACEL. MAX. (Gal), C1-C6");
    const GroundMotion motion = read_record(folder.write("a", text));
    CHECK(motion.format == "ASA 2.0");
    CHECK(motion.component_names() == "V, N90E");
    CHECK(motion.time_zero == make_utc_time(2004, 1, 2, 0, 0, 1.0));
    CHECK(motion.components[1].series.samples()[0] == relative(-0.01189, 1e-15));
}

TEST_CASE("channels beyond the sixth of an ASA file are named in fields of their own") {
    const tests::TemporaryFolder folder;
    std::string header = kAsaFile.substr(0, kAsaFile.find("    -0.084"));
    header = replaced(header, ": 2\n", ": 7\n");
    header = replaced(header, "/V/N90E\n", "/1/2/3/4/5/6\nORIENTACION C7-C12 (rumbo;orientacion) : /N00E\n");
    header = replaced(header, "/0.004/0.004\n", "/0.004/0.004/0.004/0.004/0.004/0.004\nINTERVALO DE MUESTREO, C7-C12 (s) : /0.004\n");
    header = replaced(header, "/3/3\n", "/2/2/2/2/2/2\nNUM. TOTAL DE MUESTRAS, C7-C12 : /2\n");
    header = replaced(header, "/0.47/-1.19\n", "/1/2/3/4/5/6\nACEL. MAX.(Gal), C7-C12 : /-7\n");
    const GroundMotion motion = read_record(folder.write("a", header + "1 2 3 4 5 6 -7\n0 0 0 0 0 0 0\n"));
    CHECK(motion.component_names() == "1, 2, 3, 4, 5, 6, N00E");
    CHECK(motion.components[6].series.samples()[0] == relative(-0.07, 1e-15));
}

TEST_CASE("rows beyond the announced number are dropped only when they repeat the last one") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kAsaFile + "     0.036     0.098\n     0.036     0.098\n"));
    CHECK(motion.components.front().series.size() == 3);
    CHECK(motion.history.back().find("last row repeated 2 times left out") != std::string::npos);

    tests::check_refused(kAsaFile + "     0.036     0.099\n", "a:22: more rows than NUM. TOTAL DE MUESTRAS, C1-C6 = 3");
}

TEST_CASE("every defect of an ASA file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kAsaFile, "     0.036     0.098\n", ""),
                  "a:20: 2 rows for NUM. TOTAL DE MUESTRAS, C1-C6 = 3 (file is truncated)");
    check_refused(replaced(kAsaFile, "    -0.007", ""), "a:20: 1 values (the header names 2 columns)");
    check_refused(replaced(kAsaFile, "-0.007", "-0.0x7"), "a:20: sample 2 is '-0.0x7' (no finite number)");
    check_refused(replaced(kAsaFile, ": /3/3", ": /3/4"), "a:11: NUM. TOTAL DE MUESTRAS, C1-C6 differs between channels");
    check_refused(replaced(kAsaFile, ": /3/3", ": /x/x"), "a:11: NUM. TOTAL DE MUESTRAS, C1-C6 is 'x' (must be a positive integer)");
    check_refused(replaced(kAsaFile, ": /3/3", ": /1000000000000/1000000000000"),
                  "a:21: 3 rows for NUM. TOTAL DE MUESTRAS, C1-C6 = 1000000000000");
    check_refused(replaced(kAsaFile, "CANALES                      : 2", "CANALES                      : 1000000000000"),
                  "a:6: ORIENTACION C1-C6 (rumbo;orientacion) names 2 channels (1000000000000 needed");
    check_refused(replaced(kAsaFile, "/0.004/0.004", "/0/0"), "a:7: time step is 0 s (must be positive)");
    check_refused(replaced(kAsaFile, "-1.19", "1.19"), "a:12: peak of channel N90E is '1.19' (the samples peak at -1.189;");
    check_refused(replaced(kAsaFile, "Gal (cm/s/s)", "cuentas"), "a:13: UNIDADES DE LOS DATOS is 'cuentas' (no unit of acceleration)");
    check_refused(replaced(kAsaFile, "00:00:01", "25:00:01"), "a:10: HORA DE LA PRIMERA MUESTRA (GMT) is '25:00:01' (no time)");
    check_refused(kAsaFile.substr(0, kAsaFile.find("DATOS DE ACEL")), "a: no samples (no 'DATOS DE ACELERACION'");
    check_refused(kAsaFile.substr(0, kAsaFile.find("    -0.084")), "a: no samples follow the header");
    check_refused(kAsaFile, "file holds acceleration (asked for: displacement)", {.quantity = SampleQuantity::displacement});
}

TEST_CASE("a real UNAM record has the length and the peaks of its header, without its two repeated rows") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "unam/CUP50401.012");
    CHECK(motion.component_names() == "V, N90E, N00E");
    CHECK(motion.components[2].azimuth_deg == 0.0);
    CHECK(motion.time_zero == make_utc_time(2004, 1, 2, 0, 0, 1.0));

    // header: 0.47, -1.19 and 1.22 Gal at samples 10590, 9513 and 10051, counted from 0; three decimals stand in the samples
    constexpr double kPeaks[] = {0.47, -1.189, 1.216};
    constexpr double kPeakSamples[] = {10590.0, 9513.0, 10051.0};
    for (std::size_t i = 0; i < 3; ++i) {
        const TimeSeries& series = motion.components[i].series;
        CHECK(series.size() == 17500);
        const auto peak = find_peak_acceleration(series);
        CHECK(peak.value.value() * 100.0 == relative(kPeaks[i], 1e-9));
        CHECK(peak.time.value() == doctest::Approx(kPeakSamples[i] * 0.004));
    }
}

}  // namespace
}  // namespace musim::records
