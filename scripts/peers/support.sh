# shellcheck shell=bash disable=SC2154
# To be sourced with $peers, the folder of these scripts: a temporary folder as for the findings, and how peers are built there.
source "$peers/../../findings/support/debian.sh"

# build NAME.cc FLAG...: with the packages that were unpacked
build() {
    local source=$1
    shift
    g++ -std=c++17 -O1 -I "$peers" -isystem "$root/usr/include" -isystem /usr/include/eigen3 "$peers/$source" "$@" -L "$lib" \
        -Wl,--allow-shlib-undefined -o peer
}

# node_packages NAME@VERSION...: beside copies of our scripts
node_packages() {
    npm install --silent --no-audit --no-fund "$@" >/dev/null
    cp "$peers"/*.mjs .
}

# unpack_yade VERSION: YADE and what of it this machine lacks
unpack_yade() {
    local package
    mkdir -p debs/partial
    apt-get install --yes --quiet=2 --download-only --no-install-recommends -o Dir::Cache::archives="$place/debs" -o Debug::NoLocking=1 \
        "yade=$1" >/dev/null
    for package in debs/*.deb; do dpkg -x "$package" "$root"; done
    rm -r debs
    LD_LIBRARY_PATH=$(find "$root" -name '*.so*' -printf '%h\n' | grep -v python | sort -u | tr '\n' ':')
    export LD_LIBRARY_PATH YADE_PREFIX=$root/usr PYTHONPATH=$root/usr/lib/python3/dist-packages
    sed "s#'/usr/lib/[^']*/yade-double/py'#'$root/usr/lib/$(gcc -print-multiarch)/yade-double/py'#" "$root/usr/bin/yade" > launch.py
}

# run_yade SCRIPT ARGUMENT...: one thread, errors only; the script's last lines are its JSON
run_yade() { /usr/bin/python3 launch.py -f 1 -j 1 -n -x "$@" 2>/dev/null | sed -n '/^{/,$p'; }
