"""What a browser makes of reports: no error, the plots hold the data, the slider moves blocks, pictures of each view.

The checks of the view itself are in browser_view.py.

usage: browser_test.py MUSIM [FOLDER FOR PICTURES]
Exit code 77: skipped, since there is no chromium, chromedriver or selenium (Debian: chromium, chromium-driver, python3-selenium).
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    print("skipped: there is no selenium (python3-selenium)")
    sys.exit(SKIPPED)
if not shutil.which("chromium") or not shutil.which("chromedriver"):
    print("skipped: there is no chromium or chromedriver")
    sys.exit(SKIPPED)

sys.dont_write_bytecode = True
from browser_view import (  # noqa: E402
    LEAST_AREA, SIZES, check, check_axes, check_keys, check_linked_plots, check_names, check_order,
    check_sizes, check_width, check_without_webgl, set_size)

SCENE = {
    "schema": "musim-scene/1", "name": "ring of blocks",
    "material": {"density": "2320 kg/m^3", "normal_stiffness": "2.625 GN/m", "shear_stiffness": "2.5 GN/m", "friction": 0.59, "restitution": 0.5},
    "structure": {"kind": "tower", "layers": 6, "block": ["1.36 m", "2.82 m", "4.25 m"], "tiling": "ring_14"},
    "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.3 g", "frequency": "2 Hz", "cycles": 1},
    "time": {"duration": "1 s"}, "output": {"spine_rate": "200 Hz", "frame_rate": "50 Hz"},
}

# one block of each kind of shape, beside each other
SHAPES = {
    "schema": "musim-scene/1", "name": "shapes", "material": "granite",
    "shapes": {
        "drum": {"kind": "cylinder", "radius": "0.2 m", "height": "0.3 m"},
        "body": {"kind": "box", "size": ["0.4 m", "0.3 m", "0.2 m"]}, "key": {"kind": "box", "size": ["0.1 m", "0.3 m", "0.1 m"]},
        "keyed": {"kind": "compound", "parts": [{"shape": "body"}, {"shape": "key", "position": ["0 m", "0 m", "0.15 m"]}]}},
    "structure": {"kind": "blocks", "blocks": [
        {"shape": "drum", "position": ["0 m", "0 m", "0.15 m"]}, {"shape": "keyed", "position": ["0.6 m", "0 m", "0.1 m"]},
        {"size": ["0.3 m", "0.3 m", "0.3 m"], "position": ["1.2 m", "0 m", "0.15 m"]}]},
    "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.2 g", "frequency": "2 Hz", "cycles": 1},
    "time": {"duration": "0.4 s"}, "output": {"spine_rate": "200 Hz", "frame_rate": "50 Hz"},
}

FULL_TOWER = {
    "schema": "musim-scene/1", "name": "full tower", "material": "wood",
    "structure": {"kind": "tower", "layers": 38, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
    "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "1 g", "duration": "20 ms"},
    "time": {"duration": "12.5 ms"}, "output": {"spine_rate": "20 kHz", "frame_rate": "20 kHz"},
}


def open_browser(width, height, more=()):
    options = Options()
    for argument in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--hide-scrollbars", "--host-resolver-rules=MAP * ~NOTFOUND", f"--window-size={width},{height}", *more):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    set_size(browser, width, height)
    return browser


def set_colours(browser, scheme):
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})


def open_report(browser, page):
    browser.get(page.resolve().as_uri())
    for _ in range(300):
        if browser.execute_script("return document.getElementById('tower').dataset.ready === 'yes'"):
            return
        time.sleep(0.1)
    raise AssertionError("the blocks are not shown: " + browser.execute_script("return document.getElementById('tower-message').textContent"))


def open_report_at_desk(browser, page):
    set_size(browser, *SIZES["desk"])
    open_report(browser, page)


def check_console(browser):
    """Empty but for what count_colours brings about, on a busy machine: no page reads pixels back."""
    own = "GPU stall due to ReadPixels"
    errors = [entry for entry in browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING") and own not in entry["message"]]
    check(not errors, f"the console is not empty: {errors}")


def check_plots(browser, figures):
    """Of each plot's numbers on the page, the largest magnitude is that of its CSV."""
    names = browser.execute_script("return [...document.querySelectorAll('figure')].map(f => f.dataset.figure)")
    check(len(names) > 5, f"only {names} are drawn")
    for name in names:
        with open(figures / f"{name}.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        check(rows, f"{name}.csv is empty")
        drawn = browser.execute_script(f"return document.querySelector('#figure-{name} svg').querySelectorAll('path, circle, polyline').length")
        check(drawn > 0, f"{name} shows no curve")
        if "component" in rows[0]:
            check_peaks(browser, name, rows)
            continue
        series = "run" if "run" in rows[0] else "series"
        cells = browser.execute_script(
            f"return [...document.querySelectorAll('#figure-{name} tbody tr')].map(r => [...r.children].map(c => c.textContent))")
        for cell in cells:
            if series == "run":
                values = [float(row["y"]) for row in rows if row["run"] == cell[0] and row["row"] == cell[1]]
                expected, shown = max(values, key=abs), float(cell[2])
            else:
                values = [float(row["y"]) for row in rows if row["series"] == cell[0]]
                expected, shown = max(values), float(cell[6])
            check(abs(shown - expected) <= 5e-4 * abs(expected) + 1e-300, f"{name}, {cell}: shown {shown}, the data have {expected}")


def check_pointer(browser, name):
    """A pointer at the middle of a plot's frame reads off the middle of its axes."""
    shown = browser.execute_script("""
        const figure = document.getElementById("figure-" + arguments[0]), svg = figure.querySelector("svg"), frame = svg.querySelector("rect.frame");
        const box = frame.getBoundingClientRect();
        svg.dispatchEvent(new PointerEvent("pointermove", {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2}));
        return [frame.dataset.x, frame.dataset.xName, figure.querySelector(".readout").textContent];""", name)
    low, high = (float(number) for number in shown[0].split()[:2])
    read = float(shown[2].split(",")[0].rpartition("= ")[2])
    check(shown[2].startswith(shown[1]) and abs(read - (low + high) / 2) <= 0.01 * (high - low), f"{name}: the pointer reads {shown}")


def check_peaks(browser, name, rows):
    """Of a record's figure: the first peak in the table is that of the acceleration's curve; of a run's base, whose samples are means over
    the time between them, up to half a percent above it."""
    cells = browser.execute_script(f"return [...document.querySelectorAll('#figure-{name} tbody tr')].map(r => [...r.children].map(c => c.textContent))")
    check(cells, f"{name} has no table")
    for cell in cells:
        component = cell[0].split()[0]
        values = [float(row["value"]) for row in rows if row["component"] == component and row["quantity"] == "acceleration_g" and row["scale"] == "prototype"]
        drawn, shown = max(map(abs, values)), float(cell[1].split()[0])
        check("model" in cell[0] or (1 - 5e-4) * drawn <= shown <= (1 + 5e-3) * drawn, f"{name}, {cell}: shown {shown}, the data have {drawn}")


def find_renderer_memory():
    """Resident memory of the largest renderer [MB]."""
    largest = 0.0
    for process in pathlib.Path("/proc").iterdir():
        try:
            if "--type=renderer" in (process / "cmdline").read_text():
                status = (process / "status").read_text()
                largest = max(largest, int(status.split("VmRSS:")[1].split()[0]) / 1024)
        except (OSError, IndexError):
            pass  # it has ended, or is another user's
    return largest


def check_full_tower(run, place, pictures):
    """All 7,144 blocks in 251 frames: small enough to send and to show."""
    (place / "full.json").write_text(json.dumps(FULL_TOWER))
    run("run", "full.json", "-o", "full")
    answer = json.loads(run("report", "full", "-o", "full.html", "--json"))
    check(answer["bytes"] < 40e6, f"the page has {answer['bytes']} bytes")
    browser = open_browser(1280, 1000)
    try:
        start = time.monotonic()
        open_report(browser, place / "full.html")
        print(f"full tower: {1e-6 * answer['bytes']:.1f} MB, shown after {time.monotonic() - start:.1f} s, {find_renderer_memory():.0f} MB of memory")
        check(browser.execute_script("return [window.musimTower.runs[0].blocks, window.musimTower.runs[0].times.length]") == [7144, 251], "blocks or frames are missing")
        check(0 < find_renderer_memory() < 1000, "the browser takes more than 1 GB")
        check(count_colours(browser) > 20, "nothing is seen of the full tower")
        browser.save_screenshot(str(pictures / "full.png"))
        check_console(browser)
    finally:
        browser.quit()


def check_inputs(browser, run, place):
    """Specimens, records and printed results, which have no run."""
    specimen = dict(SCENE, structure=dict(SCENE["structure"], layers=3, height_deviation="12.5 mm"))
    (place / "specimen.json").write_text(json.dumps(specimen))
    run("specimen", "specimen.json", "-o", "specimens")
    run("record", "make", "ricker", "--frequency", "2", "--pga", "0.3", "-o", "made.at2")
    (place / "scale.json").write_text(run("scale", "--length", "1/107", "--friction", "0.63/0.59", "--json"))
    run("report", "specimens", "made.at2", "scale.json", "-o", "inputs.html", "--figures", "input_figures")
    open_report_at_desk(browser, place / "inputs.html")
    check(count_colours(browser) > 10, "no specimen is seen")
    check(not browser.execute_script("return document.getElementById('tower-play').checkVisibility()"), "a specimen can be played")
    check_sizes(browser, "specimen")
    with open(place / "input_figures/record_1.csv", newline="") as file:
        check_peaks(browser, "record_1", list(csv.DictReader(file)))
    check_console(browser)


def check_blocks(browser, blocks):
    """The slider moves blocks, to where the frames have them; fields work."""
    move = "const s = document.getElementById('tower-time'); s.value = arguments[0]; s.dispatchEvent(new Event('input'));"
    top = "return [...window.musimTower.groups[0].run.displacement.slice(3 * arguments[0], 3 * arguments[0] + 3)]"
    browser.execute_script(move, 0)
    start = browser.execute_script(top, blocks - 1)
    browser.execute_script(move, 0.5)
    moved = browser.execute_script(top, blocks - 1)
    check(max(abs(value) for value in start) < 1e-9, f"the top has moved at the start: {start}")
    check(abs(moved[0]) > 1e-3, f"the slider does not move the top: {moved}")
    history = browser.execute_script("return window.musimTower.historyOf(window.musimTower.runs[0], arguments[0])", blocks - 1)
    check(len(history) == 51, f"{len(history)} frames")
    browser.execute_script("const b = document.getElementById('tower-block'); b.value = 7; b.dispatchEvent(new Event('change'));")
    check("block 7 of" in browser.execute_script("return document.getElementById('tower-block-properties').textContent"), "the block's properties are not shown")
    browser.execute_script("document.getElementById('tower-play').click()")
    # a busy machine draws its first picture when it can
    deadline = time.monotonic() + 30.0
    while browser.execute_script("return window.musimTower.time") == 0.5 and time.monotonic() < deadline:
        time.sleep(0.1)
    check(browser.execute_script("return window.musimTower.time") != 0.5, "it does not play")
    browser.execute_script("window.musimTower.play(false)")


def count_colours(browser):
    return browser.execute_script("""
        const gl = window.musimTower.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, p = new Uint8Array(4 * w * h);
        window.musimTower.draw();
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, p);
        const seen = new Set();
        for (let i = 0; i < p.length; i += 4) if (p[i + 3] > 0) seen.add(p[i] << 16 | p[i + 1] << 8 | p[i + 2]);
        return seen.size;""")


def check_views(browser, pictures, name):
    for camera in ("front", "side", "top", "corner"):
        browser.execute_script(f"document.querySelector('[data-camera={camera}]').click()")
        check(count_colours(browser) > 20, f"the view from {camera} is empty")
        check_axes(browser, camera)
        browser.execute_script("document.getElementById('blocks').scrollIntoView()")
        browser.save_screenshot(str(pictures / f"{name}_{camera}.png"))
    for colour in browser.execute_script("return [...document.getElementById('tower-colour').options].map(o => o.value)"):
        browser.execute_script("const c = document.getElementById('tower-colour'); c.value = arguments[0]; c.dispatchEvent(new Event('change'));", colour)
        check(count_colours(browser) > 10, f"coloured by {colour} nothing is seen")


def check_layout(browser, page, pictures):
    for name, (width, height), scheme in (*((name, size, "light") for name, size in SIZES.items()), ("dark", (1280, 900), "dark")):
        set_size(browser, width, height)
        set_colours(browser, scheme)
        open_report(browser, page)
        check_console(browser)
        check_width(browser, name)
        if scheme == "dark":
            ground = browser.execute_script("return getComputedStyle(document.body).backgroundColor")
            check(ground != "rgb(255, 255, 255)", "the page is not dark")
        for place in ("verdict", "blocks", "profiles", "energy"):
            browser.execute_script(f"document.getElementById('{place}').scrollIntoView()")
            time.sleep(0.2)
            browser.save_screenshot(str(pictures / f"{name}_{place}.png"))
    set_colours(browser, "light")


def check_pair_without_webgl(page):
    browser = open_browser(*SIZES["desk"], more=["--disable-3d-apis"])
    try:
        check_without_webgl(browser, page)
        check_order(browser, "without WebGL")
    finally:
        browser.quit()


def check_shapes(browser, run, place, pictures):
    """Each shape is a mesh of its own, a click on a block chooses it, and the bounds are those of the shapes."""
    (place / "shapes.json").write_text(json.dumps(SHAPES))
    run("run", "shapes.json", "-o", "shapes")
    run("report", "shapes", "-o", "shapes.html")
    open_report_at_desk(browser, place / "shapes.html")
    faces = browser.execute_script("return window.musimTower.groups[0].meshes.map(m => [m.blocks.length, window.musimTower.runs[0].shapeOf(m.blocks[0]).faces.length])")
    # the key of three boxes has the faces of its parts that lie outside, however it is cut
    check(sorted(faces)[0][0] == 1 and len(faces) == 3 and {6, 26} <= {f for _, f in faces}, f"other meshes: {faces}")
    bounds = browser.execute_script("const b = window.musimTower.runBounds[0]; return [b.low, b.high]")
    expected = [[-0.2, -0.2, 0.0], [1.35, 0.2, 0.3]]
    # the corners of 24 flats lie to 0.9914 of the radius along x and y
    check(all(abs(a - b) < 0.002 for got, want in zip(bounds, expected) for a, b in zip(got, want)), f"other bounds: {bounds}")
    for block in range(3):
        chosen = browser.execute_script("""
            const viewer = window.musimTower, rect = viewer.canvas.getBoundingClientRect();
            const at = viewer.groups[0].centre(arguments[0], 1).project(viewer.camera);
            viewer.pick({ clientX: rect.left + rect.width * 0.5 * (1 + at.x), clientY: rect.top + rect.height * 0.5 * (1 - at.y) });
            return viewer.chosen.block;""", block)
        check(chosen == block, f"a click on block {block} chooses {chosen}")
    check_views(browser, pictures, "shapes")
    check_console(browser)


def check_kinds(browser, run, place, pictures):
    """Pages of a slender column, of an ensemble and of a sequence, at three sizes of the window."""
    scene = dict(SCENE, structure={"kind": "column", "layers": 8, "block": ["1.36 m", "2.82 m", "4.25 m"], "height_deviation": "10 mm"}, time={"duration": "0.4 s"})
    stages = {key: value for key, value in scene.items() if key not in ("base_motion", "time")}
    stages["motions"] = [{"name": "shock", "base_motion": scene["base_motion"], "duration": "0.4 s", "repeat": 2}]
    for name, content in (("column", scene), ("stages", stages)):
        (place / f"{name}.json").write_text(json.dumps(content))
    run("run", "column.json", "-o", "column")
    run("ensemble", "column.json", "--members", "2", "-o", "ensemble")
    run("sequence", "stages.json", "-o", "sequence")
    for name in ("column", "ensemble", "sequence"):
        run("report", name, "-o", f"{name}.html")
        open_report_at_desk(browser, place / f"{name}.html")
        check_sizes(browser, name)
        browser.save_screenshot(str(pictures / f"{name}_phone.png"))
        check_console(browser)


def touch(browser, kind, *points):
    browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]})


def check_touch(page, pictures):
    """On a phone one finger on the blocks scrolls the page; two, or one on the handle, turn them."""
    browser = open_browser(390, 900)
    try:
        browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
        open_report(browser, page)
        browser.execute_script("document.getElementById('tower-canvas').scrollIntoView({block: 'center'})")
        camera = "return window.musimTower.camera.position.toArray()"
        middle = "const r = document.getElementById(arguments[0]).getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]"
        x, y = browser.execute_script(middle, "tower-canvas")

        before, scrolled = browser.execute_script(camera), browser.execute_script("return window.scrollY")
        touch(browser, "touchStart", (x, y))
        for k in range(1, 11):
            touch(browser, "touchMove", (x, y - 20 * k))
            time.sleep(0.02)
        touch(browser, "touchEnd")
        time.sleep(0.5)
        check(browser.execute_script("return window.scrollY") > scrolled + 50, "one finger on the blocks does not scroll the page")
        check(browser.execute_script(camera) == before, "one finger that scrolls turns the blocks, too")

        browser.execute_script("document.getElementById('tower-canvas').scrollIntoView({block: 'center'})")
        x, y = browser.execute_script(middle, "tower-canvas")
        touch(browser, "touchStart", (x - 40, y), (x + 40, y))
        for k in range(1, 6):
            touch(browser, "touchMove", (x - 40 + 10 * k, y), (x + 40 + 10 * k, y))
        touch(browser, "touchEnd")
        turned = browser.execute_script(camera)
        check(turned != before, "two fingers do not turn the blocks")

        x, y = browser.execute_script(middle, "tower-handle")
        touch(browser, "touchStart", (x, y))
        for k in range(1, 6):
            touch(browser, "touchMove", (x + 10 * k, y + 5 * k))
        touch(browser, "touchEnd")
        check(browser.execute_script(camera) != turned, "the handle does not turn the blocks")
        browser.save_screenshot(str(pictures / "phone_handle.png"))
    finally:
        browser.quit()


def main():
    musim = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else place
        pictures.mkdir(parents=True, exist_ok=True)
        (place / "scene.json").write_text(json.dumps(SCENE))

        def run(*arguments):
            return subprocess.run([musim, *arguments], cwd=place, check=True, capture_output=True, text=True).stdout

        run("pair", "scene.json", "--length", "1/16", "--length", "1/25", "-o", "pair")
        answer = json.loads(run("report", "pair", "-o", "pair.html", "--figures", "figures", "--json"))
        check(answer["runs"] == 3 and not answer["remarks"], f"{answer}")
        browser = open_browser(1280, 1000)
        try:
            open_report(browser, place / "pair.html")
            check_plots(browser, place / "figures")
            for name in ("spine_velocity", "slip", "base_motion_1"):
                check_pointer(browser, name)
            check_blocks(browser, 6 * 14)
            check_keys(browser)
            check_linked_plots(browser)
            check_names(browser)
            check_views(browser, pictures, "pair")
            check_console(browser)
            open_report_at_desk(browser, place / "pair.html")
            check_sizes(browser, "pair", LEAST_AREA)
            check_layout(browser, place / "pair.html", pictures)
            check_kinds(browser, run, place, pictures)
            check_inputs(browser, run, place)
            check_shapes(browser, run, place, pictures)
        finally:
            browser.quit()
        run("report", "pair", "-o", "again.html")
        check((place / "again.html").read_bytes() == (place / "pair.html").read_bytes(), "two reports of one folder differ")
        check_pair_without_webgl(place / "pair.html")
        check_touch(place / "pair.html", pictures)
        check_full_tower(run, place, pictures)
    print("reports are shown as they should be")


if __name__ == "__main__":
    main()
