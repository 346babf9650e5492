#!/usr/bin/env python3
"""Makes the tables of docs/validation/peers.md of what `scripts/peers/run` printed. Usage: scripts/peers/table.py FILE.json..."""
import json
import sys

peers = [json.load(open(name)) for name in sys.argv[1:]]
STEPS = (1 / 240, 1 / 960, 1 / 3840)  # [s]
EDGES = (1, 0.1, 0.02, 0.01)  # [m]


def find(peer, what, edge, step=0.0):
    """The value of a row, or None. Small overlaps have their own in place of a step."""
    for row in peer["rows"]:
        if row.get("what") == what and row["edge"] == edge and abs(row["step"] - step) <= 1e-3 * step:
            return row["value"]
    return None


def show(value):
    """Three digits; whole numbers as such, and 0 below single precision."""
    if value is None:
        return ""
    if abs(value) < 5e-7 or abs(value - round(value)) < 1e-5 * abs(value):
        return str(round(value))
    return f"{value:.3g}"


def show_pile(peer, kind, edge, step):
    """Height and way aside of the topmost, in thousandths of an edge."""
    height, aside = (find(peer, f"stack {what} {kind}", edge, step) for what in ("height", "shift"))
    if height is None:
        return ""
    if height > 1:
        return "thrown"
    return "fell" if height < -1 or aside > 1 else f"{show(round(1e3 * height, 3))}, {show(round(1e3 * aside, 3))}"


def unit(edge):
    return f"{edge:g} m" if edge >= 1 else f"{100 * edge:g} cm"


def name(step):
    return f"1/{round(1 / step)}"


def table(columns, corner=""):
    """One row for each peer that has an answer; columns: title and function of the peer."""
    lines = [[corner] + [title for title, _ in columns]]
    for peer in peers:
        cells = [cell(peer) for _, cell in columns]
        if any(cells):
            lines.append([f"{peer['peer']} {peer['version']}"] + cells)
    for k, line in enumerate(lines):
        print("| " + " | ".join(line) + " |" + ("\n|" + "---|" * len(line) if k == 0 else ""))
    print()


def value(what, edge, step=0.0):
    return lambda peer: show(find(peer, what, edge, step))


table([(f"{title}, {unit(edge)}", value(what, edge)) for title, what, edges in (
    ("mass", "mass drum", (0.01,)), ("cube", "inertia corners", EDGES), ("drum", "inertia drum", (1, 0.01)),
    ("apart", "inertia corners apart", (0.01,))) for edge in edges])
table([(f"height, {unit(edge)}", value("height corners", edge, STEPS[0])) for edge in EDGES] +
      [(f"points, {kind}", lambda peer, what=f"points {kind}": value(what, 0.1, STEPS[0])(peer) or value(what, 0.1)(peer))
       for kind in ("corners", "box")])
for kind in ("corners", "box"):
    table([(f"{unit(edge)}, {name(step)}", lambda peer, edge=edge, step=step: show_pile(peer, kind, edge, step))
           for edge in (1, 0.1, 0.01) for step in STEPS[:2]], kind)
for kind in ("box", "sphere"):
    table([(f"{restitution}, {name(step)}", value(f"rebound {kind} {restitution}", 0.1, step))
           for restitution in (1, 0.5) for step in STEPS], kind)
for edge in (1, 0.1, 0.01):
    table([(f"{title}, {unit(edge)}, {part:g}", value(what, edge, part))
           for title, what in (("EPA", "normal off EPA"), ("MPR", "missed MPR")) for part in (1e-3, 1e-4, 1e-5)])
table([(f"{title}, {unit(edge)}", value(what, edge))
       for title, what in (("flats", "flats drum"), ("volume", "mass round drum"), ("bodies", "bodies")) for edge in (1, 0.1, 0.01)])
table([(f"{title}, {unit(edge)}", value(f"{title} open", edge)) for title in ("mass", "centre") for edge in (1, 0.01)])
for peer in peers:
    for row in peer["rows"]:
        if "state" in row:
            print(f"| {row['scene']}, {row['state']} | {row['blocks']} | {row['core_us_per_block_and_step']:.0f} | "
                  f"{row['least']:.0f} to {row['most']:.0f} |" + (f" {show(row['musim'])} |" if row.get("musim") else ""))
