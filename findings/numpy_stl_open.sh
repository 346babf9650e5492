#!/usr/bin/env bash
# numpy-stl 2.9.0 (Debian python3-stl): Mesh.is_closed(), which decides whether get_mass_properties() warns.
# Guess: a box without one of its sides is open, whichever side is missing, and so is a tube without ends.
# Behaviour: the sum of the facets' normals is asked, and only whether a component is above 1e-4, not below -1e-4. Without its lowest side a
# box is open, with a warning; without its top it is "closed", and its centre of gravity lies in its bottom; the tube's lies wherever the
# origin is. An open box whose edge is 5 mm, in metres, is closed whatever is missing.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack python3-stl=2.9.0-2+b3 python3-python-utils=3.5.2-1 python3-numpy=1:1.24.2-1+deb12u1

cat > closed.py <<'CODE'
import sys
import numpy
from stl.mesh import Mesh

# the sides of a cube of edge 1 from the origin on, wound outwards: two triangles each
SIDES = {"-x": (0, 4, 6, 2), "+x": (1, 3, 7, 5), "-y": (0, 1, 5, 4), "+y": (2, 6, 7, 3), "-z": (0, 2, 3, 1), "+z": (4, 5, 7, 6)}
edge, height, missing = float(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]
corners = [[(c & 1) * edge, (c >> 1 & 1) * edge, height + (c >> 2 & 1) * edge] for c in range(8)]
kept = [s for name, s in SIDES.items() if name not in missing]
facets = [[corners[c] for c in t] for s in kept for t in (s[:3], (s[0], s[2], s[3]))]
box = Mesh(numpy.zeros(len(facets), dtype=Mesh.dtype))
box.vectors[:] = facets
box.update_normals()
centre = (box.get_mass_properties()[1][2] - height) / edge
print("closed" if box.is_closed() else "open", round(centre, 3) + 0.0)
CODE
# box EDGE HEIGHT SIDE...: without these sides, its lowest corners at a height; its centre above them, in edges
box() { PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -S -W ignore closed.py "$@" 2>/dev/null; }
expect "cube" "$(box 1 0)" "closed 0.5"
expect "cube without its bottom" "$(box 1 0 -z)" "open 0.5"
expect "cube without its top" "$(box 1 0 +z)" "closed 0.0"
expect "cube without ends" "$(box 1 0 -z +z)" "closed 0.0"
expect "cube without ends, 10 higher" "$(box 1 10 -z +z)" "closed -10.0"
for side in -x +x -y +y -z +z; do expect "cube of 0.005 without $side" "$(box 0.005 0 $side | cut -d' ' -f1)" "closed"; done
