#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <filesystem>

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

/// Text that the licence of three.js wants beside every copy of it.
constexpr const char* kThreeLicence = R"(<!--
three.js and its OrbitControls, Copyright 2010-2019 three.js authors, The MIT License:
Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the
"Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish,
distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the
following conditions: The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF
MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY
CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE
SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
-->
)";

/// JSON that no text in it can end the element, whatever a run or its folder is called.
std::string dump_for_script(const nlohmann::json& document) {
    const std::string text = document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char letter : text) {
        if (letter == '<') {
            safe += "\\u003c";
        } else {
            safe += letter;
        }
    }
    return safe;
}

/// A script as the contents of an element, where "</script" would end it.
std::string as_element(std::string script) {
    for (std::size_t at = script.find("</script"); at != std::string::npos; at = script.find("</script", at + 1)) {
        script.replace(at, 2, "<\\/");
    }
    return "<script>\n" + script + "\n</script>\n";
}

constexpr const char* kControls = R"(<div class="tower" id="tower" role="group" aria-label="Blocks in three dimensions">
<div class="tower-view"><canvas id="tower-canvas" tabindex="0" role="application" aria-label="Blocks in three dimensions; ? lists the keys"></canvas>
<p id="tower-scale" class="overlay"></p><div id="tower-axes" class="overlay"></div><div id="tower-names" class="overlay"></div>
<button type="button" id="tower-handle" aria-label="Drag to turn the blocks">turn</button>
<p id="tower-message" class="overlay" role="status"></p></div>
<div class="tower-controls">
<p class="row transport moving"><button type="button" id="tower-play" aria-pressed="false" title="Space">Play</button>
<button type="button" id="tower-back" aria-label="One frame back" title="One frame back: ←">◂</button><button type="button" id="tower-on" aria-label="One frame on" title="One frame on: →">▸</button>
<input type="range" id="tower-time" aria-label="time" min="0" max="1000" value="0" step="any"><output id="tower-clock" for="tower-time"></output>
<label>speed <select id="tower-speed"><option value="1">real time</option><option value="0.5">1/2</option><option value="0.1" selected>1/10</option><option value="0.02">1/50</option><option value="0.002">1/500</option></select></label></p>
<p class="row"><span role="group" aria-label="view from" class="views"><button type="button" data-camera="front" title="1">Front</button><button type="button" data-camera="side" title="2">Side</button><button type="button" data-camera="top" title="3">Top</button><button type="button" data-camera="corner" title="4">Corner</button></span>
<button type="button" id="tower-reset" title="R">Reset view</button> <button type="button" id="tower-fill" title="F">Full screen</button> <button type="button" id="tower-keys" title="?" aria-haspopup="dialog">Keys</button></p>
<p class="row"><label>colour <select id="tower-colour"></select></label>
<label class="moving">displacements <input type="number" id="tower-exaggeration" min="1" max="1000" value="1" step="1"> times</label></p>
<div id="tower-legend" class="legend"></div>
<details><summary>More: ground, cut, block by number</summary>
<p class="row"><label class="moving"><input type="checkbox" id="tower-relative"> relative to the ground</label>
<label>cut across <select id="tower-cut-axis"><option value="x">x</option><option value="y" selected>y</option><option value="z">z</option></select></label>
<label>at <input type="range" id="tower-cut" min="0" max="1000" value="1000"></label></p>
<p class="row"><label>block <input type="number" id="tower-block" min="1" step="1"></label> <label>of <select id="tower-run"></select></label></p></details>
<div id="tower-block-properties"><p class="small">Click a block for its values and its history.</p></div>
</div>
<dialog id="tower-help" aria-label="Keys"><table><caption>Keys in the view</caption><tbody></tbody></table>
<p class="small">Drag to turn, after a click the wheel comes nearer; on a phone two fingers, or one on the round button. Click a block for its values.</p>
<form method="dialog"><button>Close</button></form></dialog>
</div>
<noscript><p class="statement note"><strong>note</strong> The blocks in 3D need JavaScript; verdict, plots and tables do not.</p></noscript>
)";

}  // namespace

std::string make_tower_scripts() {
    if (!has_three()) return {};
    return kThreeLicence + as_element(scaling::read_regular_file(three_script()).value_or("")) +
           as_element(scaling::read_regular_file(controls_script()).value_or("")) + as_element(kTowerScript);
}

ReportSection make_tower_section(const ReportContent& content) {
    ReportSection section{.id = "blocks", .title = content.runs.empty() ? "The blocks" : "Motion of the blocks", .figures_beside = true};
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
        section.html += "<script type=\"application/json\" class=\"tower-data\">" + dump_for_script(data.json) + "</script>\n";
        if (run.stands) continue;
        rounding +=
            fmt::format("{}{}: places to {:.2g} mm, turns to {:.2g}°, velocities to {:.2g} mm/s", rounding.empty() ? "" : "; ", run.label,
                        1e3 * data.rounding.displacement, data.rounding.rotation / scaling::kDegree, 1e3 * data.rounding.velocity);
        if (data.rounding.force > 0.0) rounding += fmt::format(", contact forces to {:.2g} weights", data.rounding.force);
    }
    if (!rounding.empty()) section.html += "<p class=\"small\">Rounded, at most, by " + escape_html(rounding) + ".</p>\n";
    return section;
}

}  // namespace musim::lsdem
