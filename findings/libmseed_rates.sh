#!/usr/bin/env bash
# libmseed 2.19.8: sample rates of records whose time is scaled, as for a model on a shake table, written as miniSEED 2.
# Guess: a rate comes back as it was given, or to the precision of a float.
# Behaviour: the header holds two 16-bit integers, and the library writes the nearest ratio that it finds without a word: a record of 200 Hz
# whose time is scaled by 0.0935543 (1:107) comes back 2.2e-6 faster. 60 s of the prototype's time are then 0.13 ms off. Rates such as 100,
# 12.5 or 1000/3 Hz come back exactly.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack libmseed-dev=2.19.8-1 libmseed2=2.19.8-1

cat > rate.c <<'CODE'
#include <libmseed.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char bytes[512];
static void keep(char* record, int length, void* unused) {
    (void)unused;
    memcpy(bytes, record, (size_t)length);
}

int main(int argc, char** argv) {
    const double rate = argc > 1 ? strtod(argv[1], NULL) / (argc > 2 ? strtod(argv[2], NULL) : 1.0) : 0.0;
    int32_t samples[4] = {1, 2, 3, 4};
    int64_t packed = 0;
    MSRecord *out = msr_init(NULL), *in = NULL;
    strcpy(out->network, "XX"), strcpy(out->station, "A"), strcpy(out->channel, "HNE");
    out->dataquality = 'D', out->reclen = 512, out->encoding = DE_INT32, out->byteorder = 1;
    out->samprate = rate, out->datasamples = samples, out->numsamples = 4, out->sampletype = 'i';
    msr_pack(out, keep, NULL, &packed, 1, 0);
    if (msr_parse(bytes, 512, &in, 0, 1, 0) != MS_NOERROR) return 1;
    printf("%.1e", in->samprate / rate - 1.0);
    return 0;
}
CODE
gcc -isystem "$root/usr/include" rate.c -L "$lib" -lmseed -o rate
expect "100 Hz" "$(./rate 100)" 0.0e+00
expect "12.5 Hz" "$(./rate 12.5)" 0.0e+00
expect "1000/3 Hz" "$(./rate 1000 3)" 0.0e+00
expect "200/0.0935543224 Hz" "$(./rate 200 0.0935543224)" 2.2e-06
