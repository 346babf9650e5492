#!/usr/bin/env python3
"""musim's answers to the inputs of README.md, as JSON. Usage: scripts/peers/run musim [PROGRAM], which brings h5dump."""
import json
import math
import pathlib
import struct
import subprocess
import sys

PROGRAM = sys.argv[1]
GRAVITY, DENSITY, FRICTION, STIFFNESS = 9.81, 2500.0, 0.6, 2e10  # [m/s^2], [kg/m^3], -, [N/m^3]
SLICE = math.pi / 12


def corners(kind, edge):
    if kind == "drum":
        outline = [(0.5 * edge * math.cos(SLICE * k), 0.5 * edge * math.sin(SLICE * k)) for k in range(24)]
    else:
        shift = 3 * edge if kind == "corners apart" else 0.0
        outline = [(shift + x * edge, y * edge) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))]
    return [[x, y, z * edge] for z in (-0.5, 0.5) for x, y in outline]


def read(folder, name):
    out = folder / "numbers"
    subprocess.run(["h5dump", "-d", name, "-o", out, "-b", "LE", folder / "result.h5"], check=True, capture_output=True)
    data = out.read_bytes()
    return struct.unpack(f"<{len(data) // 8}d", data)


def run(kind, edge, blocks, duration, restitution=0.3, safety=0.8, rate=0):
    """Blocks are what is added to an entry of the list; of kind "box", or by their corners."""
    block = {"size": [edge] * 3} if kind == "box" else {"shape": "solid"}
    scene = {"schema": "musim-scene/1", "name": "peers", "gravity": GRAVITY,
             "material": {"density": DENSITY, "normal_stiffness_per_area": STIFFNESS, "shear_stiffness_per_area": 0.8 * STIFFNESS,
                          "friction": FRICTION, "restitution": restitution, "shear_damping_ratio": 0.1},
             "structure": {"kind": "blocks", "blocks": [{**block, **each} for each in blocks]},
             "time": {"duration": duration, "safety": safety}, "output": {"spine_rate": rate}, "preparation": "none"}
    if kind != "box":
        scene["shapes"] = {"solid": {"kind": "polyhedron", "vertices": corners(kind, edge)}}
    pathlib.Path("scene.json").write_text(json.dumps(scene))
    folder = pathlib.Path("result")
    subprocess.run(["rm", "-rf", folder], check=True)
    done = subprocess.run([PROGRAM, "run", "scene.json", "-o", folder, "--threads", "1"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return folder


rows = []
for edge in (1.0, 0.1, 0.02, 0.01):
    def say(what, value, step=0.0):
        rows.append({"what": what, "edge": edge, "step": step, "value": value})

    volume, inertia = 3 * math.sin(SLICE) * edge**3, edge**2 / 24 * (2 + math.cos(SLICE))
    for kind, true_mass, true_inertia in (("corners", DENSITY * edge**3, edge**2 / 6), ("drum", DENSITY * volume, inertia),
                                          ("corners apart", DENSITY * edge**3, edge**2 / 6)):
        # a body that only spins, high above the ground: its energy at the start is I w^2 / 2
        spin = 100.0 / math.sqrt(edge)
        folder = run(kind, edge, [{"position": [0, 0, 9 * edge], "angular_velocity": [0, 0, spin]}], 1e-3 * math.sqrt(edge))
        mass = read(folder, "/blocks/mass")[0]
        if kind != "corners apart":
            say(f"mass {kind}", mass / true_mass)
        say(f"inertia {kind}", 2 * read(folder, "/energy/kinetic")[0] / spin**2 / mass / true_inertia)
    for kind in ("corners", "box"):
        folder = run(kind, edge, [{"position": [0, 0, 0.5 * edge]}], 2.0, rate=10)
        say(f"height {kind}", read(folder, "/blocks/final_position")[2] / edge - 0.5, 1 / 240)
        for step, safety in ((1 / 240, 0.8), (1 / 960, 0.2)):
            folder = run(kind, edge, [{"position": [0, 0, (k + 0.5) * edge]} for k in range(10)], 2.0, safety=safety, rate=10)
            x, y, z = read(folder, "/blocks/final_position")[27:]
            say(f"stack height {kind}", z / edge - 9.5, step)
            say(f"stack shift {kind}", math.hypot(x, y) / edge, step)
    fall = math.sqrt(10 * edge / GRAVITY)
    for restitution in (1.0, 0.5):
        for step, safety in ((1 / 240, 0.8), (1 / 960, 0.2), (1 / 3840, 0.05)):
            # on its way up after the first impact: where it would turn
            folder = run("box", edge, [{"position": [0, 0, 5.5 * edge]}], 1.2 * fall, restitution, safety, rate=10 / fall)
            z, up = read(folder, "/spine/position")[-1], read(folder, "/spine/velocity")[-1]
            say(f"rebound box {restitution:g}", ((z + up * up / (2 * GRAVITY)) / edge - 0.5) / 5, step)
version = subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
print(json.dumps({"peer": "musim", "version": version, "rows": rows}).replace('{"what"', '\n  {"what"'))
