#include "cli/overview.hpp"

namespace musim::cli {

std::string describe_program() {
    return R"(musim: similitude, records, shake tables and simulation of dry-stacked blocks

  scale a model test             musim scale --length 1/107 --friction 0.63/0.59
  measure and process a record   musim record info STATION.v1
  see what a shake table can do  musim table STATION.v1 --limits TABLE.json --length 1/25
  begin a scene, and check it    musim new tower -o tower.json && musim check tower.json -o preview.svg
  run it, and see the results    musim run tower.json -o out/tower && musim report out/tower -o tower.html
  compare prototype and models   musim pair SCENE.json --length 1/107 -o out/pair

A structure of your own under a record of your own: musim new tower --record STATION.v1 -o tower.json
All commands: musim --help. One of them, with examples: musim COMMAND --help.
)";
}

}  // namespace musim::cli
