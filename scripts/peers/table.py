#!/usr/bin/env python3
"""Makes the tables of docs/validation/peers.md of what `scripts/peers/run` printed. Usage: scripts/peers/table.py FILE.json..."""
import json
import sys

peers = [json.load(open(name)) for name in sys.argv[1:]]
FIRST = 1 / 240


def find(peer, what, edge, step):
    for row in peer["rows"]:
        if row["what"] == what and row["edge"] == edge and abs(row["step"] - step) < 1e-3 * step + 1e-12:
            return row["value"]
    return None


def show(value):
    if value is None:
        return ""
    if abs(value) < 5e-7:
        return "0"
    if abs(value - round(value)) < 1e-6:
        return str(round(value))
    return f"{value:.4f}".rstrip("0") if 0.0001 < abs(value) < 10 else f"{value:.3g}"


def fell(peer, kind, edge, step):
    height, shift = (find(peer, f"stack {what} {kind}", edge, step) for what in ("height", "shift"))
    if height is None:
        return ""
    if abs(height) > 1 or shift > 1:
        return "thrown" if height > 1 else "fell"
    return f"{height:+.4f}, {shift:.4f}"


def table(title, columns, cell):
    lines = [[title] + [name for name, _ in columns]]
    for peer in peers:
        cells = [cell(peer, *key) for _, key in columns]
        if any(cells):
            lines.append([f"{peer['peer']} {peer['version']}"] + cells)
    print("\n".join("| " + " | ".join(line) + " |" + ("\n|" + "---|" * len(line) if k == 0 else "") for k, line in enumerate(lines)), "\n")


def parts(title, whats, edges, step=0.0):
    table(title, [(f"{name}, {edge * 100:g} cm", (what, edge)) for name, what in whats for edge in edges],
          lambda peer, what, edge: show(find(peer, what, edge, step)))


parts("mass", [("cube", "mass corners"), ("drum", "mass drum")], (1, 0.01))
parts("inertia", [("cube", "inertia corners")], (1, 0.1, 0.02, 0.01))
parts("inertia", [("drum", "inertia drum"), ("cube apart", "inertia corners apart")], (1, 0.01))
parts("height", [("corners", "height corners")], (1, 0.1, 0.02, 0.01), FIRST)
parts("points", [("corners", "points corners"), ("box", "points box")], (1, 0.01), FIRST)
parts("points, no step", [("corners", "points corners"), ("box", "points box")], (1, 0.01))
for kind in ("corners", "box"):
    table(f"ten, {kind}", [(f"{edge * 100:g} cm, 1/{round(1 / step)} s", (kind, edge, step)) for edge in (1, 0.1, 0.01)
                           for step in (FIRST, FIRST / 4)], fell)
for restitution in ("1", "0.5"):
    for kind in ("sphere", "box"):
        table(f"rebound {kind} {restitution}",
              [(f"{edge * 100:g} cm, 1/{round(1 / step)} s", (edge, step)) for edge in (1, 0.1, 0.01)
               for step in (FIRST, FIRST / 4, FIRST / 16)],
              lambda peer, edge, step: show(find(peer, f"rebound {kind} {restitution}", edge, step)))
for edge in (1, 0.1, 0.01):
    table(f"cube of {edge * 100:g} cm, overlap", [(f"{name}, {part:g}", (what, part)) for name, what in
                                                  (("EPA off", "normal off EPA"), ("MPR missed", "missed MPR"))
                                                  for part in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)],
          lambda peer, what, part: show(find(peer, what, edge, part)))
parts("manifold", [("flats", "flats drum"), ("volume over round", "mass round drum"), ("bodies", "bodies")], (1, 0.1, 0.01))
parts("open mesh", [("mass", "mass open"), ("centre", "centre open")], (1, 0.01))
