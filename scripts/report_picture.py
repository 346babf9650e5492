"""Photographs the top of a report, its verdict and its blocks, in headless Chromium:
scripts/report_picture.py PAGE.html PICTURE.png TIME [COLOUR [BLOCK]]

Needs chromium, chromium-driver and python3-selenium (`scripts/setup --checks` installs them).
"""
import pathlib
import shutil
import sys
import time

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

SHOW = """
const change = function (id, value, event) { const field = document.getElementById(id); field.value = value; field.dispatchEvent(new Event(event)); };
change("tower-colour", arguments[1], "change");
change("tower-exaggeration", 10, "input");
change("tower-time", arguments[0], "input");
if (arguments[2] > 0) change("tower-block", arguments[2], "change");
"""


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    page, picture, when = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], float(sys.argv[3])
    colour, block = sys.argv[4] if len(sys.argv) > 4 else "vx", int(sys.argv[5]) if len(sys.argv) > 5 else 0
    options = Options()
    for argument in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--hide-scrollbars", "--window-size=1440,1240"):
        options.add_argument(argument)
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    try:
        browser.get(page.as_uri())
        for _ in range(300):
            if browser.execute_script("return document.getElementById('tower').dataset.ready === 'yes'"):
                break
            time.sleep(0.1)
        browser.execute_script(SHOW, when, colour, block)
        time.sleep(0.5)
        browser.save_screenshot(picture)
    finally:
        browser.quit()


if __name__ == "__main__":
    main()
