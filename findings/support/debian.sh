# To be sourced: works in a temporary folder, with packages of Debian 12 that are unpacked there and not installed.
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
chmod 755 "$place"
cd "$place"
root=$place/root

# unpack NAME=VERSION...: packages of these versions, and the libraries that they need
unpack() {
    local names=("${@%%=*}") needed
    needed=$(apt-cache depends --recurse --no-{recommends,suggests,conflicts,breaks,replaces,enhances} "${names[@]}" | grep '^lib' |
        grep -vE '^lib(c6|gcc|stdc\+\+|c-dev|crypt)|-dev|:' | sort -u | grep -vxF "$(printf '%s\n' "${names[@]}")" || true)
    # shellcheck disable=SC2086
    apt-get download --quiet=2 "$@" $needed 2>/dev/null
    local package
    for package in *.deb; do dpkg -x "$package" "$root"; done
    rm -- *.deb
    lib=$root/usr/lib/$(gcc -print-multiarch)
    LD_LIBRARY_PATH=$(find "$root" -name '*.so*' -printf '%h\n' | sort -u | tr '\n' ':')
    export LD_LIBRARY_PATH
}

# expect WHAT SEEN WANTED: fails when what is seen has changed
expect() {
    printf '%s: %s\n' "$1" "$2"
    [[ "$2" == "$3" ]] || { printf 'changed: %s was %s\n' "$1" "$3" >&2; exit 1; }
}
