#include "lsdem/report/tower_section.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "lsdem/report/specimen_sections.hpp"
#include "lsdem/report/tower_data.hpp"
#include "lsdem/report/web_assets.hpp"
#include "scaling/angle.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

fs::path three_script() { return fs::path(kThreeFolder) / "three.min.js"; }
fs::path controls_script() { return fs::path(kThreeFolder) / "examples/js/controls/OrbitControls.js"; }
bool has_three() { return fs::exists(three_script()) && fs::exists(controls_script()); }

/// A script as the contents of an element, where "</script" would end it.
std::string as_element(std::string script) {
    for (std::size_t at = script.find("</script"); at != std::string::npos; at = script.find("</script", at + 1)) {
        script.replace(at, 2, "<\\/");
    }
    return "<script>\n" + script + "\n</script>\n";
}

constexpr const char* kControls = R"(<div class="tower" id="tower">
<div class="tower-view"><canvas id="tower-canvas" tabindex="0" role="img" aria-label="Blocks in three dimensions"></canvas>
<button type="button" id="tower-handle" aria-label="Drag to turn the blocks">turn</button>
<p id="tower-message" role="status"></p></div>
<div class="tower-controls">
<p class="row moving"><button type="button" id="tower-play" aria-pressed="false">Play</button>
<label>time <input type="range" id="tower-time" min="0" max="1000" value="0" step="any"></label> <output id="tower-clock"></output></p>
<p class="row"><label class="moving">speed <select id="tower-speed"><option value="1">as it was</option><option value="0.5">half</option><option value="0.1" selected>a tenth</option><option value="0.02">a fiftieth</option></select></label>
<label>colour <select id="tower-colour"></select></label>
<label class="moving">exaggerated <input type="number" id="tower-exaggeration" min="1" max="1000" value="1" step="1"> times</label>
<label class="moving"><input type="checkbox" id="tower-relative"> as seen from the ground</label></p>
<p class="row"><span role="group" aria-label="camera"><button type="button" data-camera="front">Front (A)</button> <button type="button" data-camera="side">Side</button>
<button type="button" data-camera="top">Top (B)</button> <button type="button" data-camera="corner">Corner</button></span>
<label>cut across <select id="tower-cut-axis"><option value="x">x</option><option value="y" selected>y</option><option value="z">z</option></select></label>
<label>at <input type="range" id="tower-cut" min="0" max="1000" value="1000"></label></p>
<div id="tower-legend" class="legend"></div>
<p class="row"><label>block <input type="number" id="tower-block" min="1" step="1"></label> <label>of <select id="tower-run"></select></label></p>
<div id="tower-block-facts" aria-live="polite"></div>
</div></div>
)";

}  // namespace

std::string make_tower_scripts() {
    if (!has_three()) return {};
    return as_element(scaling::read_regular_file(three_script()).value_or("")) +
           as_element(scaling::read_regular_file(controls_script()).value_or("")) + as_element(kTowerScript);
}

ReportSection make_tower_section(const ReportContent& content) {
    ReportSection section{.id = "blocks", .title = "The blocks in 3D", .html = {}};
    if (!has_three()) {
        section.html = make_statement(
            Tone::note, fmt::format("there is no three.js on the machine that made this report ({}); install it there (apt-get "
                                    "install libjs-three) and make the report again",
                                    three_script().string()));
        return section;
    }
    section.html = kControls;
    std::string rounding;
    std::vector<const ReportedRun*> shown;
    const std::vector<ReportedRun> standing = make_standing_runs(content.specimens);
    for (const std::vector<ReportedRun>* runs : {&content.runs, &standing}) {
        for (const ReportedRun& run : *runs) shown.push_back(&run);
    }
    for (const ReportedRun* reported : shown) {
        const ReportedRun& run = *reported;
        const TowerData data = make_tower_data(run);
        section.html += "<script type=\"application/json\" class=\"tower-data\">" + data.json.dump() + "</script>\n";
        rounding +=
            fmt::format("{}{}: places to {:.2g} mm, turns to {:.2g}°, velocities to {:.2g} mm/s", rounding.empty() ? "" : "; ", run.label,
                        1e3 * data.rounding.displacement, data.rounding.rotation / scaling::kDegree, 1e3 * data.rounding.velocity);
        if (data.rounding.force > 0.0) rounding += fmt::format(", contact forces to {:.2g} weights", data.rounding.force);
    }
    section.html += "<p class=\"small\">Rounded, at most, by " + escape_html(rounding) +
                    ". Drag to turn (two fingers, or one on the round button), wheel or + and − to come nearer, arrow keys turn and space "
                    "plays when the picture has the focus; "
                    "click a block for its "
                    "history.</p>\n";
    return section;
}

}  // namespace musim::lsdem
