#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "lsdem/scene/scene_json.hpp"
#include "records/design/parse_design.hpp"
#include "records/design/parse_properties.hpp"
#include "records/processing/recipe.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/pi/pi_problem.hpp"
#include "tests/fuzz/choose_reader.hpp"

/// Any bytes are a scene, a law, a design or what else MUSIM_READER names, or a std::runtime_error of one short line. A scene that is
/// one is written as text that is read back to an equal scene.
namespace {

using namespace musim;

struct Reader {
    std::string_view name;
    void (*read)(const std::string& text);
};

void read_scene(const std::string& text) {
    const lsdem::Scene scene = lsdem::parse_scene(text, "fuzzed");
    lsdem::check_scene(scene, "fuzzed");
    if (lsdem::parse_scene(lsdem::write_scene(scene), "fuzzed") != scene) __builtin_trap();
}

constexpr Reader kReaders[] = {
    {"scene", read_scene},
    {"design", [](const std::string& text) { records::parse_design(text, "fuzzed", {}); }},
    {"properties", [](const std::string& text) { records::parse_properties(text, "fuzzed", {}, 0.04); }},
    {"law", [](const std::string& text) { scaling::parse_scale_law(text, "fuzzed"); }},
    {"pi", [](const std::string& text) { scaling::parse_pi_problem(text, "fuzzed"); }},
    {"table", [](const std::string& text) { records::parse_shake_table(text, "fuzzed", nullptr); }},
    {"recipe", [](const std::string& text) { records::parse_recipe(text, "fuzzed"); }},
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Reader& reader = musim::tests::choose_reader<Reader>(kReaders, "law");
    try {
        reader.read(std::string(reinterpret_cast<const char*>(data), size));
    } catch (const std::runtime_error& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
