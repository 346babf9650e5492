#!/usr/bin/env python3
"""Holds scripts/boulders to what two motions did to a boulder. Called by ctest with the program's path.

Two of the tests in ../shared/rocks, far from where a boulder just falls: one of 0.06 g, which it stood, and one that overturned it.
Skips itself (77) where these are absent.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROCKS = ROOT.parent / "shared" / "rocks"
SEEN = {"11": "0", "101": "1"}

if not ROCKS.is_dir():
    print("skipped: there are no boulders in ../shared/rocks")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder) / "predictions.csv"
    command = [ROOT / "scripts" / "boulders", ROCKS, "--boulder", "SP1", "--musim", sys.argv[1], "--work", folder, "-o", out]
    for motion in SEEN:
        command += ["--only", motion]
    for again in range(2):  # the second time from the results that are kept
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"scripts/boulders: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        with open(out, newline="") as file:
            said = {row["motion"]: row["musim"] for row in csv.DictReader(file)}
        if said != SEEN:
            sys.exit(f"overturned: {said} instead of {SEEN}")
        if "| musim | 1.000 | 1 | 1 | 0 | 0 |" not in done.stdout:
            sys.exit(f"the score is missing:\n{done.stdout}")
    kept = (pathlib.Path(folder) / "results.jsonl").read_text().splitlines()
    if len(kept) != len(SEEN):
        sys.exit(f"{len(kept)} results are kept of {len(SEEN)} runs")
print("two motions as seen")
