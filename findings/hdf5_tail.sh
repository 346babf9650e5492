#!/usr/bin/env bash
# HDF5 1.10.8: bytes behind the end of an HDF5 file, such as a checksum or signature that a program appends.
# Guess: the library ignores them (the file opens without complaint), so opening a file and closing it, with nothing written, leaves it as
# it is.
# Behaviour: opened to be read they stay; opened for reading and writing the file is cut at HDF5's own end when it is closed, though nothing
# was written, and the appended bytes are gone.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack libhdf5-dev=1.10.8+repack1-1 libhdf5-103-1=1.10.8+repack1-1

cat > open.c <<'CODE'
#include <hdf5.h>
#include <string.h>

int main(int argc, char** argv) {
    if (argc > 1 && strcmp(argv[1], "make") == 0) return H5Fclose(H5Fcreate("a.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    return H5Fclose(H5Fopen("a.h5", argc > 1 && strcmp(argv[1], "write") == 0 ? H5F_ACC_RDWR : H5F_ACC_RDONLY, H5P_DEFAULT));
}
CODE
gcc -isystem "$root/usr/include/hdf5/serial" open.c -L "$lib/hdf5/serial" -L "$lib" -lhdf5_serial -Wl,--allow-shlib-undefined -o open
./open make
whole=$(stat -c %s a.h5)
echo "checksum 0123456789abcdef" >> a.h5
./open read
expect "bytes behind the end after reading" "$(($(stat -c %s a.h5) - whole))" 26
./open write
expect "bytes behind the end after opening to write" "$(($(stat -c %s a.h5) - whole))" 0
