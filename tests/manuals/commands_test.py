#!/usr/bin/env python3
"""Runs every command that starts with `musim` in README.md and docs/user, page by page, in the order of the page.

Called by ctest with the program's path; `commands_test.py MUSIM PAGE...` takes some pages alone.

A page is run as a reader would: in one folder, with the repository's `examples` and `scripts` in it and the records
that it names. Only scenes, those of `examples` and those that commands write, are made shorter (shorten), so that
minutes become seconds; commands are run as they are printed. A command that catches SIGINT may be interrupted after
LIMIT seconds, unless a later one reads in the folder that it leaves: it must then end by its own message. What a page
takes for granted (RESULTS) is made first.

A ```json block becomes the file that the next command names and that is not there yet. Exit code: 0, or what the comment says
("exit code 5", "exit code 6 if not"). Skips itself (77) where ../shared/records is absent.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORDS = ROOT.parent / "shared" / "records"
LIMIT = 5.0  # s for one command
OUT = r"(?:-o|--out) ([\w./-]+)"
SHELLS = ("", "sh", "bash", "console")
SKIPPED = 77
INTERRUPTED = 130
NO_FFMPEG = "there is no ffmpeg"

# pages about a folder of results that another page or program has left: the commands that leave it
RESULTS = {
    "reports.md": [
        "musim run examples/tower_prototype.json -o out/tower",
        "musim pair examples/tower_prototype.json --length 1/25 --length 1/107 -o out/demo/pair",
        "musim specimen examples/uneven_wall.json -o out/specimens --seeds 2",
    ],
}
# files that stand for a reader's own: another record, a scene of the examples, a text
OWN_RECORDS = {"other.v1": "CICLC.v1", "my.mseed": "CI.CLC..HNE.mseed", "station.xml": "CI.CLC.xml",
               **{f"STATION.{direction}": f"AOM0011801241951.{direction}" for direction in ("EW", "NS", "UD")}}
OWN_SCENES = {"my_model.json": "tower_prototype.json"}
OWN_TEXTS = {"code.csv": "period_s,psa_g\n0.05,0.4\n0.15,1.0\n0.5,1.0\n1,0.5\n5,0.1\n"}


def shorten_scenes(paths):
    for path in paths:
        content = json.loads(path.read_text())
        if isinstance(content, dict) and content.get("schema") == "musim-scene/1":
            path.write_text(json.dumps(shorten(content), indent=2))


def shorten(scene):
    """A scene with few layers, a tenth of its time at most and no motion more than twice, so that its commands run in seconds."""
    structure = scene.get("structure", {})
    if "layers" in structure:
        structure["layers"] = min(structure["layers"], 2)
    if "base_motion" in scene and scene["base_motion"].get("signal") == "synthetic":
        scene["base_motion"]["duration"] = "2 s"
    for motion in scene.get("motions", []):
        motion["repeat"] = min(motion.get("repeat", 1), 2)
    for timed in [scene.get("time"), *scene.get("motions", [])]:
        if timed:
            number, unit = timed["duration"].split()
            timed["duration"] = f"{float(number) / 10} {unit}"
    return scene


def find_record(name):
    return next((path for path in sorted(RECORDS.rglob(name)) if path.is_file()), None)


def lay_out(place):
    """The folder in which a page's commands run."""
    shutil.copytree(ROOT / "examples", place / "examples")
    (place / "scripts").symlink_to(ROOT / "scripts")
    shorten_scenes((place / "examples").rglob("*.json"))


def read_blocks(page):
    """(language, lines) of every fenced block."""
    blocks, language, lines = [], None, []
    for line in page.read_text().splitlines():
        if line.startswith("```"):
            if language is None:
                language, lines = line[3:].strip(), []
            else:
                blocks.append((language, lines))
                language = None
        elif language is not None:
            lines.append(line)
    return blocks


def split_comment(line):
    """A command and its comment: `#` after white space, outside quotes."""
    quote = None
    for i, letter in enumerate(line):
        if quote:
            quote = None if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter == "#" and (i == 0 or line[i - 1].isspace()):
            return line[:i].strip(), line[i + 1:].strip()
    return line.strip(), ""


def find_commands(lines):
    """(command, what its comments say) of a block; a backslash goes on in the next line, a comment above counts."""
    above = ""
    for line in re.sub(r"\\\n\s*", " ", "\n".join(lines)).splitlines():
        command, comment = split_comment(line)
        if command.startswith("musim "):
            yield command, f"{above} {comment}"
        above = comment if not command else ""


def allowed_codes(comment):
    """Exit codes that a comment names; 0 when it names none, or names one that depends ("exit code 6 if not")."""
    codes = {int(code) for code in re.findall(r"exit code (\d+)", comment)}
    if not codes or re.search(r"exit code \d+ (if|when)\b", comment):
        codes.add(0)
    return codes


def provide(command, place, own_json):
    """Puts in place what a command reads: a record by its name, a file of the reader's own, a block of JSON shown before."""
    shown = "\n".join(own_json[0]) if own_json else ""
    command = re.sub(OUT, "", command)
    for word in re.findall(r"[\w./-]+", f"{command} {shown}"):
        target = place / word
        if "/" in word or target.exists() or not re.search(r"\.\w+$", word):
            continue
        if word in OWN_SCENES:
            shutil.copy(place / "examples" / OWN_SCENES[word], target)
        elif word in OWN_TEXTS:
            target.write_text(OWN_TEXTS[word])
        elif own_json and word.endswith(".json"):
            target.write_text(shown)
            own_json.clear()
        elif (record := find_record(OWN_RECORDS.get(word, word))) is not None:
            target.symlink_to(record)


def find_limit(command, later):
    """The seconds after which a command is interrupted; none where later ones read the folder that it leaves, or in it."""
    out = re.search(OUT, command)
    read = [re.sub(OUT, "", each).split() for each in later]
    return None if out and any((word + "/").startswith(out[1] + "/") for words in read for word in words) else LIMIT


def catches_interruption(pid):
    """Whether a process has a handler of SIGINT, by Linux's mask of caught signals."""
    caught = re.search(r"^SigCgt:\s*(\w+)", pathlib.Path(f"/proc/{pid}/status").read_text(), re.MULTILINE)
    return bool(int(caught[1], 16) >> (signal.SIGINT - 1) & 1)


def heed_interruption():
    """A process started in the background inherits that SIGINT is ignored, and leaves it so."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def run(command, place, musim, limit):
    """Exit code, standard output and error, seconds; interrupted after the limit if it can be."""
    environment = os.environ | {"PATH": f"{musim.parent}:{os.environ['PATH']}"}
    start = time.time()
    process = subprocess.Popen(["bash", "-c", command], cwd=place, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, start_new_session=True, preexec_fn=heed_interruption)
    try:
        out, err = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        if catches_interruption(process.pid):
            os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=60)
    return process.returncode, out, err, time.time() - start


def run_page(page, musim):
    """How many commands of a page were run; those that did not do what it says."""
    failures, count, own_json = [], 0, []
    blocks = read_blocks(page)
    later = [command for language, lines in blocks if language in SHELLS for command, _ in find_commands(lines)]
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        lay_out(place)
        for command in RESULTS.get(page.name, []):
            code, _, err, _ = run(command, place, musim, limit=None)
            if code != 0:
                failures.append(f"{page.name}: to prepare it, `{command}` returned {code}: {err.strip()}")
        for language, lines in blocks:
            if language == "json":
                own_json = [lines]
                continue
            if language not in SHELLS:
                continue
            for command, comment in find_commands(lines):
                provide(command, place, own_json)
                before = set(place.glob("*.json"))
                later = later[1:]
                code, _, err, seconds = run(command, place, musim, find_limit(command, later))
                shorten_scenes(set(place.glob("*.json")) - before)
                count += 1
                ended = code in allowed_codes(comment) or (code == INTERRUPTED and "musim: " in err)
                ended = ended or (NO_FFMPEG in err and shutil.which("ffmpeg") is None)
                print(f"{page.name}: {command}: exit code {code}, {seconds:.1f} s", flush=True)
                if not ended:
                    failures.append(f"{page.name}: `{command}` returned {code}: {err.strip()}")
    return count, failures


def main(arguments):
    if not RECORDS.is_dir():
        print(f"{RECORDS} is absent: the commands of the manuals read its records")
        return SKIPPED
    musim = pathlib.Path(arguments[0]).resolve()
    pages = [pathlib.Path(page) for page in arguments[1:]] or [ROOT / "README.md", *sorted((ROOT / "docs/user").glob("*.md"))]
    count, failures = 0, []
    for page in pages:
        run_count, page_failures = run_page(page, musim)
        count += run_count
        failures += page_failures
    print(f"{count} commands, {len(failures)} of them do not do what the manual says")
    for failure in failures:
        print(failure)
    return 1 if failures or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
