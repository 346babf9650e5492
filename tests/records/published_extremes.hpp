#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "records/sample_unit.hpp"

/// The largest and smallest samples that the files' own headers print, and the peaks of their velocity and displacement blocks that the
/// README of the shared records measured.
namespace musim::tests {

struct PublishedExtreme {
    std::string_view file;
    std::size_t component;  ///< in file order
    records::SampleQuantity quantity;
    double value;  ///< signed as the samples are: of the largest sample when positive, of the smallest when negative [unit]
    int decimals;  ///< of the coarser print: that of the header (or README) or of the samples
    std::string_view unit;
    double time;  ///< from the first sample [s]; negative: not published
};

inline constexpr std::array<PublishedExtreme, 78> kPublishedExtremes{{
    {"csmip/CICLC.v1", 0, records::SampleQuantity::acceleration, 0.344, 3, "g", 234.36},
    {"csmip/CICLC.v1", 1, records::SampleQuantity::acceleration, 0.511, 3, "g", 235.7},
    {"csmip/CICLC.v1", 2, records::SampleQuantity::acceleration, 0.347, 3, "g", 234.39},
    {"csmip/ce23583r_HESPERIA.RAW", 0, records::SampleQuantity::acceleration, 0.058, 3, "g", 9.425},
    {"csmip/ce23583r_HESPERIA.RAW", 1, records::SampleQuantity::acceleration, 0.042, 3, "g", -1.0},
    {"csmip/ce23583r_HESPERIA.RAW", 2, records::SampleQuantity::acceleration, -0.091, 3, "g", 9.615},
    {"csmip/CE58667.V2", 0, records::SampleQuantity::acceleration, 27.114, 3, "cm/s2", -1.0},
    {"csmip/CE58667.V2", 0, records::SampleQuantity::velocity, -2.890, 3, "cm/s", -1.0},
    {"csmip/CE58667.V2", 0, records::SampleQuantity::displacement, 1.086, 3, "cm", -1.0},
    {"csmip/CE58667.V2", 1, records::SampleQuantity::acceleration, 11.244, 3, "cm/s2", -1.0},
    {"csmip/CE58667.V2", 1, records::SampleQuantity::velocity, -1.216, 3, "cm/s", -1.0},
    {"csmip/CE58667.V2", 1, records::SampleQuantity::displacement, -0.3497, 4, "cm", -1.0},
    {"csmip/CE58667.V2", 2, records::SampleQuantity::acceleration, -26.411, 3, "cm/s2", -1.0},
    {"csmip/CE58667.V2", 2, records::SampleQuantity::velocity, 2.219, 3, "cm/s", -1.0},
    {"csmip/CE58667.V2", 2, records::SampleQuantity::displacement, 0.9363, 4, "cm", -1.0},
    {"csmip/ce36456p_CE36456.V2", 0, records::SampleQuantity::acceleration, -267.957, 3, "cm/s2", -1.0},
    {"csmip/ce36456p_CE36456.V2", 0, records::SampleQuantity::velocity, -28.253, 3, "cm/s", -1.0},
    {"csmip/ce36456p_CE36456.V2", 0, records::SampleQuantity::displacement, 5.449, 3, "cm", -1.0},
    {"csmip/ce36456p_CE36456.V2", 1, records::SampleQuantity::acceleration, -94.805, 3, "cm/s2", -1.0},
    {"csmip/ce36456p_CE36456.V2", 1, records::SampleQuantity::velocity, -11.377, 3, "cm/s", -1.0},
    {"csmip/ce36456p_CE36456.V2", 1, records::SampleQuantity::displacement, -3.820, 3, "cm", -1.0},
    {"csmip/ce36456p_CE36456.V2", 2, records::SampleQuantity::acceleration, -256.231, 3, "cm/s2", -1.0},
    {"csmip/ce36456p_CE36456.V2", 2, records::SampleQuantity::velocity, 34.298, 3, "cm/s", -1.0},
    {"csmip/ce36456p_CE36456.V2", 2, records::SampleQuantity::displacement, -8.911, 3, "cm", -1.0},
    {"csmip/CE89146.V2", 0, records::SampleQuantity::acceleration, 77.280, 3, "cm/s2", -1.0},
    {"csmip/CE89146.V2", 0, records::SampleQuantity::velocity, 3.150, 3, "cm/s", -1.0},
    {"csmip/CE89146.V2", 0, records::SampleQuantity::displacement, 0.1654, 4, "cm", -1.0},
    {"csmip/CE89146.V2", 1, records::SampleQuantity::acceleration, 20.529, 3, "cm/s2", -1.0},
    {"csmip/CE89146.V2", 1, records::SampleQuantity::velocity, 0.9838, 4, "cm/s", -1.0},
    {"csmip/CE89146.V2", 1, records::SampleQuantity::displacement, -0.07819, 5, "cm", -1.0},
    {"csmip/CE89146.V2", 2, records::SampleQuantity::acceleration, -44.200, 3, "cm/s2", -1.0},
    {"csmip/CE89146.V2", 2, records::SampleQuantity::velocity, 2.783, 3, "cm/s", -1.0},
    {"csmip/CE89146.V2", 2, records::SampleQuantity::displacement, 0.3342, 4, "cm", -1.0},
    {"csmip/chan001.v2", 0, records::SampleQuantity::acceleration, 17.433, 3, "cm/s2", -1.0},
    {"csmip/chan001.v2", 0, records::SampleQuantity::velocity, 0.2054, 4, "cm/s", -1.0},
    {"csmip/chan001.v2", 0, records::SampleQuantity::displacement, -0.004402, 6, "cm", -1.0},
    {"cosmos/CE23837.V1C", 0, records::SampleQuantity::acceleration, -0.105433, 6, "g", 31.575},
    {"cosmos/CE23837.V1C", 1, records::SampleQuantity::acceleration, 0.048757, 6, "g", 30.085},
    {"cosmos/CE23837.V1C", 2, records::SampleQuantity::acceleration, -0.059022, 6, "g", 32.075},
    {"cosmos/Cosmos12TimeSeriesTest.v1", 0, records::SampleQuantity::acceleration, -161.962, 3, "cm/s2", 27.85},
    {"cosmos/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c", 0, records::SampleQuantity::acceleration, -6.85151, 5, "cm/s2", 76.215},
    {"smc/np01002p_4225a_a.smc", 0, records::SampleQuantity::acceleration, 186.009, 2, "cm/s2", -1.0},
    {"smc/np01002p_4225a_a.smc", 0, records::SampleQuantity::acceleration, -222.519, 2, "cm/s2", -1.0},
    {"smc/0111a.smc", 0, records::SampleQuantity::acceleration, 104.408, 2, "cm/s2", -1.0},
    {"smc/0111a.smc", 0, records::SampleQuantity::acceleration, -78.821, 3, "cm/s2", -1.0},
    {"smc/0165b_a.smc", 0, records::SampleQuantity::acceleration, 274.451, 2, "cm/s2", -1.0},
    {"smc/0165b_a.smc", 0, records::SampleQuantity::acceleration, -253.064, 2, "cm/s2", -1.0},
    {"smc/A-CAT090.AT2.smc", 0, records::SampleQuantity::acceleration, 41.3554, 4, "cm/s2", -1.0},
    {"smc/A-CAT090.AT2.smc", 0, records::SampleQuantity::acceleration, -38.4271, 4, "cm/s2", -1.0},
    {"smc/A-CAT180.AT2.smc", 0, records::SampleQuantity::acceleration, 46.8987, 4, "cm/s2", -1.0},
    {"smc/A-CAT180.AT2.smc", 0, records::SampleQuantity::acceleration, -58.0092, 4, "cm/s2", -1.0},
    {"smc/2516b_a.smc", 0, records::SampleQuantity::acceleration, 39.1039, 3, "cm/s2", -1.0},
    {"smc/2516b_a.smc", 0, records::SampleQuantity::acceleration, -28.8518, 3, "cm/s2", -1.0},
    {"esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", 0, records::SampleQuantity::acceleration, 0.300022, 6, "cm/s2", -1.0},
    {"esm/HI.ARS1..HNN.D.20190728.160908.C.ACC.ASC", 0, records::SampleQuantity::acceleration, 0.359017, 6, "cm/s2", -1.0},
    {"esm/HI.ARS1..HNZ.D.20190728.160908.C.ACC.ASC", 0, records::SampleQuantity::acceleration, 0.202093, 6, "cm/s2", -1.0},
    {"esm/20101114230825_3104_ap_RawAcc_E.asc", 0, records::SampleQuantity::acceleration, 1.632, 3, "cm/s2", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 0, records::SampleQuantity::acceleration, -41.6, 1, "mm/s2", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 0, records::SampleQuantity::velocity, 1.647, 3, "mm/s", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 0, records::SampleQuantity::displacement, 0.1311, 4, "mm", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 1, records::SampleQuantity::acceleration, -194.0, 1, "mm/s2", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 1, records::SampleQuantity::velocity, 5.091, 3, "mm/s", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 1, records::SampleQuantity::displacement, 0.2789, 4, "mm", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 2, records::SampleQuantity::acceleration, -27.3, 1, "mm/s2", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 2, records::SampleQuantity::velocity, -0.9126, 4, "mm/s", -1.0},
    {"geonet/20180212_211557_WPWS_20.V2A", 2, records::SampleQuantity::displacement, 0.0416, 4, "mm", -1.0},
    {"geonet/20161113_110300_HSES_20.V1A", 0, records::SampleQuantity::acceleration, 2394.8, 1, "mm/s2", -1.0},
    {"geonet/20161113_110300_HSES_20.V1A", 1, records::SampleQuantity::acceleration, 2584.4, 1, "mm/s2", -1.0},
    {"geonet/20161113_110300_HSES_20.V1A", 2, records::SampleQuantity::acceleration, -1589.9, 1, "mm/s2", -1.0},
    {"usc/017m30bt.s0a", 0, records::SampleQuantity::acceleration, 242.39450, 3, "cm/s2", 4.58},
    {"usc/017m30bt.s0a", 0, records::SampleQuantity::velocity, -12.05681, 3, "cm/s", 4.5},
    {"usc/017m30bt.s0a", 0, records::SampleQuantity::displacement, -1.42006, 3, "cm", 4.58},
    {"afad/20170720223109_4812.txt", 0, records::SampleQuantity::acceleration, 37.847707, 6, "gal", -1.0},
    {"afad/20170720223109_4812.txt", 1, records::SampleQuantity::acceleration, -39.771316, 6, "gal", -1.0},
    {"afad/20170720223109_4812.txt", 2, records::SampleQuantity::acceleration, -32.130932, 6, "gal", -1.0},
    {"unam/CUP50401.012", 0, records::SampleQuantity::acceleration, 0.47, 2, "gal", -1.0},
    {"unam/CUP50401.012", 1, records::SampleQuantity::acceleration, -1.19, 2, "gal", -1.0},
    {"unam/CUP50401.012", 2, records::SampleQuantity::acceleration, 1.22, 2, "gal", -1.0},
}};

}  // namespace musim::tests
