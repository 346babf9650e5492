#!/usr/bin/env bash
# libccd 2.1: a cube that stands on another, tilted by a thousandth, as deep in it as part of the edge; defaults of CCD_INIT.
# Guess: whether two bodies meet does not depend on the unit of length, and an overlap far above rounding is found.
# Behaviour: ccdMPRPenetration compares with mpr_tolerance, at first 1e-4 of whatever unit lengths are in: of 100 pairs that overlap by 1e-4
# of their edge, or by less, it finds all of 1 m and none of 10 cm or 1 cm, and answers that they do not intersect. Blocks of millimetres
# given in metres sink before they are borne. With mpr_tolerance = 1e-12 edge it finds all at every size: scale what is absolute.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack libccd-dev=2.1-2+b1 libccd2=2.1-2+b1

cat > pairs.cpp <<'CODE'
#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <ccd/vec3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

struct Cube {
    double half;
    ccd_vec3_t middle;
    ccd_quat_t turn, back;
};

void support(const void* of, const ccd_vec3_t* direction, ccd_vec3_t* at) {
    const Cube& cube = *static_cast<const Cube*>(of);
    ccd_vec3_t own = *direction;
    ccdQuatRotVec(&own, &cube.back);
    ccdVec3Set(at, std::copysign(cube.half, own.v[0]), std::copysign(cube.half, own.v[1]), std::copysign(cube.half, own.v[2]));
    ccdQuatRotVec(at, &cube.turn);
    ccdVec3Add(at, &cube.middle);
}

void center(const void* of, ccd_vec3_t* at) { *at = static_cast<const Cube*>(of)->middle; }

/// `EDGE PART TOLERANCE`, 0 for the default one: number of pairs out of a hundred that are found.
int main(int /*argc*/, char** argv) {
    const double edge = std::atof(argv[1]), part = std::atof(argv[2]);
    int found = 0;
    for (int k = 0; k < 100; ++k) {
        Cube below{}, above{};
        below.half = above.half = 0.5 * edge;
        ccdQuatSet(&below.turn, 0, 0, 0, 1);
        ccd_vec3_t axis;
        ccdVec3Set(&axis, std::cos(0.3 + k), std::sin(0.3 + k), 0);
        ccdQuatSetAngleAxis(&above.turn, 1e-3, &axis);
        ccdQuatInvert2(&below.back, &below.turn);
        ccdQuatInvert2(&above.back, &above.turn);
        // the lowest corner of the upper cube lies over the middle of the lower cube's upper face, and as deep below it as asked
        ccd_vec3_t down, lowest;
        ccdVec3Set(&down, 0, 0, -1);
        support(&above, &down, &lowest);
        ccdVec3Set(&above.middle, -lowest.v[0], -lowest.v[1], edge * (0.5 - part) - lowest.v[2]);
        ccd_t ccd;
        CCD_INIT(&ccd);
        ccd.support1 = ccd.support2 = support;
        ccd.center1 = ccd.center2 = center;
        ccd.max_iterations = 1000;
        if (std::atof(argv[3]) > 0) ccd.mpr_tolerance = std::atof(argv[3]);
        ccd_real_t depth;
        ccd_vec3_t normal, at;
        found += ccdMPRPenetration(&below, &above, &ccd, &depth, &normal, &at) == 0;
    }
    std::printf("%d", found);
}
CODE
g++ -std=c++17 -isystem "$root/usr/include" pairs.cpp -L "$lib" -lccd -o pairs
for part in 1e-4 1e-6; do
    for edge in 1 0.1 0.01; do expect "$edge m, $part" "$(./pairs $edge $part 0)" "$([[ $edge == 1 ]] && echo 100 || echo 0)"; done
    expect "0.01 m, $part, tolerance 1e-14" "$(./pairs 0.01 $part 1e-14)" 100
done
