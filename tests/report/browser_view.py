"""Checks of the view of the blocks and of the page around it, in a browser that browser_test.py has opened."""
import time

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

# a desk, a tablet and a phone [pixels]
SIZES = {"desk": (1440, 900), "tablet": (820, 1180), "phone": (390, 844)}

# Of the picture, along the side that limits the structure: the view leaves 3 % of the picture free at three sides and 8 % at the lower one,
# where names stand, so that 0.89 of the height or 0.94 of the width are taken, less what pixels at the edges miss.
LEAST_SHARE = 0.85

# Of the area of the picture, by the rectangle around three runs beside each other at the start; the least seen is 0.59, on a desk and a tablet.
LEAST_AREA = 0.55


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def set_size(browser, width, height):
    # a window is no narrower than 500 pixels, a phone is
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
    wait_for_size(browser)


def wait_for_size(browser):
    """Until the view has drawn in the size that it has now; a busy machine takes its time."""
    deadline = time.monotonic() + 30.0
    time.sleep(0.2)
    while time.monotonic() < deadline:
        if browser.execute_script("""
            const c = document.getElementById("tower-canvas"), apart = (a, b) => Math.abs(a - b) > 1;
            return !window.musimTower || !(apart(c.width, c.clientWidth) || apart(c.height, c.clientHeight));"""):
            return
        time.sleep(0.1)
    raise AssertionError("the view does not follow the size of the window")


def find_drawn(browser):
    """Where the blocks are seen, without the grid: shares of the picture from its left and its lower edge, [x0, x1, y0, y1]."""
    return browser.execute_script("""
        const viewer = window.musimTower, gl = viewer.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, p = new Uint8Array(4 * w * h);
        viewer.grounds.forEach(function (ground) { ground.visible = false; });
        viewer.draw();
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, p);
        viewer.grounds.forEach(function (ground) { ground.visible = true; });
        let x0 = w, x1 = -1, y0 = h, y1 = -1;
        for (let y = 0; y < h; ++y) for (let x = 0; x < w; ++x) if (p[4 * (y * w + x) + 3] > 0) {
            x0 = Math.min(x0, x); x1 = Math.max(x1, x); y0 = Math.min(y0, y); y1 = Math.max(y1, y);
        }
        return [x0 / w, (x1 + 1) / w, y0 / h, (y1 + 1) / h];""")


def check_fill(browser, where):
    x0, x1, y0, y1 = find_drawn(browser)
    check(max(x1 - x0, y1 - y0) >= LEAST_SHARE, f"{where}: the blocks take {x1 - x0:.2f} of the width and {y1 - y0:.2f} of the height of the picture")
    check(min(x0, y0) > 0 and max(x1, y1) < 1, f"{where}: the blocks reach the edge of the picture: {[x0, x1, y0, y1]}")
    return x1 - x0, y1 - y0


def check_sizes(browser, name, least_area=0.0):
    """At each size, first the one the page was opened in: the structure fills the picture, and nothing is wider than the window."""
    for size, (width, height) in SIZES.items():
        set_size(browser, width, height)
        where = f"{name} on a {size}"
        across, up = check_fill(browser, where)
        check(across * up >= least_area, f"{where}: the runs take {across:.2f} of the width times {up:.2f} of the height")
        for view in ("front", "side", "top", "corner"):
            browser.execute_script(f"document.querySelector('[data-camera={view}]').click()")
            check_fill(browser, f"{where}, view from {view}")
        browser.execute_script("document.getElementById('tower-reset').click()")
        check(max(abs(a - b) for a, b in zip(check_fill(browser, where), (across, up))) < 0.01, f"{where}: the view that is reset is not the one at the start")
        narrow = "document.querySelector('.tower-view').style.width = arguments[0]"
        browser.execute_script(narrow, "40%")
        wait_for_size(browser)
        check_fill(browser, f"{where}, with less room")
        browser.execute_script(narrow, "")
        wait_for_size(browser)
        check_width(browser, where)
        check_order(browser, where)


def check_width(browser, where):
    browser.execute_script("document.querySelectorAll('details').forEach(d => { d.open = true; })")
    wide = browser.execute_script("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    browser.execute_script("document.querySelectorAll('details').forEach(d => { d.open = false; })")
    check(wide <= 0, f"{where}: the page is {wide} pixels wider than the window")


def check_order(browser, where):
    """The verdict is in the first window, with a number, above all plots and above the blocks."""
    shown = browser.execute_script("""
        const line = document.querySelector(".statement"), box = line.getBoundingClientRect(), at = y => y + window.scrollY;
        const others = [...document.querySelectorAll("figure, #tower")].map(e => at(e.getBoundingClientRect().top));
        return [line.textContent, at(box.bottom), window.innerHeight, Math.min(...others)];""")
    text, bottom, window, first = shown
    check(any(c.isdigit() for c in text), f"{where}: the verdict has no number: {text}")
    check(bottom <= min(window, first), f"{where}: the verdict ends at {bottom}, the window at {window}, the first picture begins at {first}")


# Directions of the axes, as the picture of them says it in words.
AXES = {"front": "x to the right, y away from you, z up", "side": "x toward you, y to the right, z up",
        "top": "x to the right, y up, z toward you", "corner": "x to the right, y away from you, z up"}


def check_axes(browser, view):
    """The arrows of the axes go where the camera has them: y across and z up from the side, and so on."""
    words, arrows = browser.execute_script("""
        const picture = document.querySelector("#tower-axes svg");
        return [picture.getAttribute("aria-label"), ["x", "y", "z"].map(axis => picture.querySelector("path." + axis).getAttribute("d"))];""")
    check(words == "Axes: " + AXES[view], f"from {view}: {words}")
    ends = [[float(number) for number in arrow.split("M")[1].split("L")[1].split()] for arrow in arrows]
    right, up = {"front": (0, 2), "side": (1, 2), "top": (0, 1), "corner": (0, 2)}[view]
    check(ends[right][0] > 15 and ends[up][1] < -15, f"from {view}: axes end at {ends}")


def check_keys(browser):
    """Keys step through the frames and turn the view, and are left to fields that one types into."""
    def press(*keys):
        ActionChains(browser).send_keys(*keys).perform()

    def state():
        return browser.execute_script("const v = window.musimTower; return [v.time, v.camera.position.toArray(), v.playing]")

    times, duration = browser.execute_script("return [window.musimTower.runs[0].times, window.musimTower.duration]")
    check(abs(duration - times[-1]) < 1e-6 * duration, f"runs of one motion end at {duration} s and {times[-1]} s")
    browser.execute_script("const c = document.getElementById('tower-canvas'); c.scrollIntoView({block: 'center'}); c.focus()")
    press(Keys.HOME)
    check(state()[0] == 0, "Home does not go to the start")
    press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    check(state()[0] == times[2], f"two arrows to the right lead to {state()[0]} s, the frames are at {times[:4]}")
    press(Keys.ARROW_LEFT)
    check(state()[0] == times[1], f"an arrow to the left leads to {state()[0]} s")
    press(Keys.END)
    check(state()[0] == duration, f"End leads to {state()[0]} s, not {duration}")
    before = state()[1]
    press("2")
    check(state()[1] != before, "2 does not look from the side")
    press("r")
    check(state()[1] == before, "R does not reset the view")
    ActionChains(browser).key_down(Keys.SHIFT).send_keys(Keys.ARROW_LEFT).key_up(Keys.SHIFT).perform()
    check(state()[1] != before and state()[0] == duration, "Shift and an arrow do not turn the view, or change the time")
    press(Keys.HOME, Keys.SPACE)
    check(state()[2], "Space does not play")
    press(Keys.SPACE)
    check(not state()[2], "Space does not pause")
    press("?")
    check(browser.execute_script("return document.getElementById('tower-help').open"), "? does not list the keys")
    press(Keys.ESCAPE)
    check(not browser.execute_script("return document.getElementById('tower-help').open"), "Escape does not close the list of keys")

    # a field keeps its keys
    browser.execute_script("""document.querySelectorAll(".tower-controls details").forEach(d => { d.open = true; });
        document.getElementById("tower-exaggeration").focus()""")
    before = state()
    press(Keys.ARROW_RIGHT, "2", "r", Keys.HOME)
    check(state() == before, "a field of the view loses its keys to it")
    browser.execute_script("const f = document.getElementById('tower-exaggeration'); f.value = 1; f.dispatchEvent(new Event('input')); f.blur()")
    # far from the view, keys are the page's
    browser.execute_script("window.scrollTo(0, document.body.scrollHeight)")
    press(Keys.ARROW_RIGHT, Keys.SPACE)
    check(state() == before, "keys at the end of the page change the view at its start")


def check_linked_plots(browser):
    """The plots over time show the time of the view: at the share of the axis at which it is; a click in the middle of an axis sets it."""
    names = browser.execute_script("return [...document.querySelectorAll('figure[data-seconds-per-x]')].map(f => f.dataset.figure)")
    check("spine_velocity" in names, f"of the plots only {names} are linked with the view")
    for name in names:
        clicked, end, seconds, axis = browser.execute_script("""
            const figure = document.getElementById("figure-" + arguments[0]), frame = figure.querySelector("rect.frame"), box = frame.getBoundingClientRect();
            figure.querySelector(".plot svg").dispatchEvent(new MouseEvent("click", {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2}));
            return [window.musimTower.time, window.musimTower.duration, Number(figure.dataset.secondsPerX), frame.dataset.x.split(" ").map(Number)];""", name)
        middle = seconds * (axis[0] + axis[1]) / 2
        check(abs(clicked - middle) < 0.01 * end and 0.4 * end < clicked < 0.6 * end, f"{name}: a click in the middle leads to {clicked} s of {end} s, not {middle} s")
        share = browser.execute_script("""
            const figure = document.getElementById("figure-" + arguments[0]), frame = figure.querySelector("rect.frame");
            window.musimTower.goTo(0.25 * window.musimTower.duration);
            const x = Number((figure.querySelector(".now").getAttribute("d") || "M-1e9").slice(1).split(" ")[0]);
            return (x - Number(frame.getAttribute("x"))) / Number(frame.getAttribute("width"));""", name)
        expected = (0.25 * end / seconds - axis[0]) / (axis[1] - axis[0])
        check(abs(share - expected) < 0.01, f"{name}: the line stands at {share:.3f} of the axis, not at {expected:.3f}")


def check_names(browser):
    """What a screen reader says: every control has a name, and the picture and the plots have theirs."""
    nameless = browser.execute_script("""
        return [...document.querySelectorAll("#tower button, #tower input, #tower select, #tower canvas, .plot")]
            .filter(e => !(e.getAttribute("aria-label") || e.textContent.trim() || (e.labels && e.labels.length > 0))).map(e => e.id || e.className);""")
    check(not nameless, f"without a name: {nameless}")
    fetched = browser.execute_script("return performance.getEntriesByType('resource').map(e => e.name)")
    check(not fetched, f"the page fetches {fetched}")


def check_without_webgl(browser, page):
    """The blocks are drawn in a plane, and it is said why."""
    browser.get(page.resolve().as_uri())
    deadline = time.monotonic() + 30.0
    while browser.execute_script("return document.getElementById('tower').dataset.ready") != "yes" and time.monotonic() < deadline:
        time.sleep(0.1)
    said = browser.execute_script("return document.getElementById('tower-message').textContent")
    check("WebGL" in said, f"it is not said that there is no WebGL, but: {said}")
    check(not browser.execute_script("return document.getElementById('tower-play').checkVisibility()"), "what cannot move can be played")
    drawn = browser.execute_script("""
        const c = document.getElementById("tower-canvas"), p = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
        let least = c.height, most = -1;
        for (let i = 0; i < p.length; i += 4) if (p[i + 3] > 0) { const y = Math.floor(i / 4 / c.width); least = Math.min(least, y); most = Math.max(most, y); }
        return (most - least) / c.height;""")
    check(drawn > 0.5, f"the blocks take {drawn:.2f} of the height of the picture without WebGL")
