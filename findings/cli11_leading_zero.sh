#!/usr/bin/env bash
# CLI11 2.1.2: a whole number with leading zeros on the command line.
# Guess: 010 is ten, as it is for an option that takes a real number, and 08 is eight.
# Behaviour: an integer option reads 010 as octal, 8, without a word; 08 cannot be converted. A real option reads the same text as 10.
# Members of a campaign that are numbered 001, 002, ... come out right up to 007.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack libcli11-dev=2.1.2+ds-1

cat > read.cpp <<'CODE'
#include <CLI/CLI.hpp>
#include <cstdio>

int main(int argc, char** argv) {
    CLI::App app;
    int whole = 0;
    double real = 0.0;
    app.add_option("--whole", whole);
    app.add_option("--real", real);
    try {
        app.parse(argc, argv);
        std::printf("%g", app.count("--whole") > 0 ? whole : real);
    } catch (const CLI::ConversionError&) {
        std::printf("refused");
    }
}
CODE
g++ -std=c++17 -isystem "$root/usr/include" read.cpp -o read
expect "whole 007" "$(./read --whole 007)" 7
expect "whole 010" "$(./read --whole 010)" 8
expect "whole 08" "$(./read --whole 08)" refused
expect "real 010" "$(./read --real 010)" 10
