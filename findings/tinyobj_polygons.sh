#!/usr/bin/env bash
# tinyobjloader 2.0.0~rc10: a face of more than four corners in an OBJ, which it cuts into triangles as it reads (its default).
# Guess: the triangles have the polygon's area, whatever corner its list begins with and however small it is: an L of two squares by two
# without one has 3, a T of three squares and one on top has 4, in units of a square.
# Behaviour: the T has 5 when its list begins with one of its two highest corners: a corner on the side of an ear counts as outside, and the
# ear is cut off across the void. An L in metres whose squares are 0.1 mm wide has 4 in four of six orders: its cross products are below
# the epsilon of float, and the polygon is looked at from its edge. No warning. Without `triangulate` the polygons are there as written.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack libtinyobjloader-dev=2.0.0~rc10+dfsg-2+b1 libtinyobjloader2rc10=2.0.0~rc10+dfsg-2+b1

cat > area.cpp <<'CODE'
#include <tiny_obj_loader.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

/// `OBJ SQUARE`: summed area of its triangles, in squares of that edge.
int main(int /*argc*/, char** argv) {
    tinyobj::ObjReader reader;
    if (!reader.ParseFromFile(argv[1]) || !reader.Warning().empty()) return 1;
    const std::vector<float>& x = reader.GetAttrib().vertices;
    const std::vector<tinyobj::index_t>& corners = reader.GetShapes()[0].mesh.indices;
    double area = 0.0;
    for (std::size_t c = 0; c < corners.size(); c += 3) {
        const float *p = &x[3 * corners[c].vertex_index], *q = &x[3 * corners[c + 1].vertex_index], *r = &x[3 * corners[c + 2].vertex_index];
        area += 0.5 * std::abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    }
    const double edge = std::atof(argv[2]);
    std::printf("%.3g", area / (edge * edge));
}
CODE
g++ -std=c++17 -isystem "$root/usr/include" area.cpp -L "$lib" -ltinyobjloader -o area

# areas EDGE X:Y...: of the polygon of these corners, in edges, its list begun with each of them
areas() {
    local edge=$1 count=$(($# - 1)) start i seen=''
    shift
    for ((start = 0; start < count; ++start)); do
        printf '%s\n' "$@" | awk -F: -v edge="$edge" '{ print "v", $1 * edge, $2 * edge, 0 }' > a.obj
        printf f >> a.obj
        for ((i = 0; i < count; ++i)); do printf ' %d' $(((start + i) % count + 1)) >> a.obj; done
        seen+=" $(./area a.obj "$edge")"
    done
    echo "${seen# }"
}
l_shape=(0:0 2:0 2:1 1:1 1:2 0:2)
t_shape=(0:0 3:0 3:1 2:1 2:2 1:2 1:1 0:1)
expect "L of 1" "$(areas 1 "${l_shape[@]}")" "3 3 3 3 3 3"
expect "L of 0.0001" "$(areas 0.0001 "${l_shape[@]}")" "3 4 4 3 4 4"
expect "T of 1" "$(areas 1 "${t_shape[@]}")" "4 4 4 4 5 5 4 4"
