#!/usr/bin/env bash
# meshio (Debian python3-meshio 7.0.0-3): faces of an OBJ whose corners are counted back from the last vertex, as exporters that write
# vertices and faces in turn do: -1 is the last vertex so far.
# Guess: two triangles written so are read as the two triangles, or are refused.
# Behaviour: one is taken off every index, as of those that count from 1, and numpy counts the rest back from the last vertex of the whole
# file: each corner is another vertex, in range, without a word. Of two triangles in planes z = 0 and z = 5 both become the same one between
# the planes, and a conversion to STL writes it twice. With indices from 1 the same file is read rightly.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack python3-meshio=7.0.0-3 python3-numpy=1:1.24.2-1+deb12u1 python3-rich=13.3.1-1

cat > heights.py <<'CODE'
import sys
import meshio

mesh = meshio.read(sys.argv[1])
print(" | ".join(" ".join(f"{z:g}" for z in mesh.points[corners, 2]) for cells in mesh.cells for corners in cells.data))
CODE
# heights OBJ: z of the corners of each triangle
heights() { PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -S -W ignore heights.py "$1"; }
printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' > low
printf 'v %s\n' '0 0 5' '1 0 5' '0 1 5' > high
{ cat low; echo 'f 1 2 3'; cat high; echo 'f 4 5 6'; } > first.obj
{ cat low; echo 'f -3 -2 -1'; cat high; echo 'f -3 -2 -1'; } > last.obj
expect "indices from 1" "$(heights first.obj)" "0 0 0 | 5 5 5"
expect "indices from the last" "$(heights last.obj)" "0 5 5 | 0 5 5"
