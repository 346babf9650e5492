"""ParaView reads result.xdmf: times, places, sizes, turns and velocities of all blocks, with units in their names; surfaces of blocks of other
shapes; scripts/paraview_blocks.py makes a picture of it.

usage: paraview_test.py MUSIM. Exit code 77: skipped, since there is no ParaView, or neither a display nor Xvfb to draw without one.
"""
import contextlib
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
if shutil.which("pvpython") is None:
    print("skipped: there is no pvpython (Debian: paraview, python3-paraview)")
    sys.exit(SKIPPED)
if not os.environ.get("DISPLAY") and shutil.which("Xvfb") is None:
    print("skipped: pictures of ParaView need a display or Xvfb (Debian: xvfb)")
    sys.exit(SKIPPED)
PVPYTHON = ["pvpython", "--force-offscreen-rendering"]

SCENE = {
    "schema": "musim-scene/1", "name": "column", "material": "wood",
    "structure": {"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
    "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.5 g", "duration": "20 ms"},
    "time": {"duration": "20 ms"}, "output": {"spine_rate": "500 Hz", "frame_rate": "500 Hz"},
}

# a drum that is thrown and turns
SHAPES = {
    "schema": "musim-scene/1", "name": "drum", "material": "wood", "ground": {"present": False},
    "shapes": {"drum": {"kind": "cylinder", "radius": "50 mm", "height": "120 mm", "flats": 12, "top_radius": "40 mm"}},
    "structure": {"kind": "blocks", "blocks": [
        {"shape": "drum", "position": ["0 m", "0 m", "0.1 m"], "velocity": ["1 m/s", "2 m/s", "0 m/s"], "angular_velocity": ["20 1/s", "9 1/s", "30 1/s"]},
        {"size": ["0.1 m", "0.1 m", "0.1 m"], "position": ["0.5 m", "0 m", "0.05 m"]}]},
    "time": {"duration": "40 ms"}, "output": {"spine_rate": "500 Hz", "frame_rate": "100 Hz"},
}

READ_SURFACES = """
import json, sys
from paraview import simple, servermanager
reader = simple.XDMFReader(FileNames=[sys.argv[1]])
reader.UpdatePipelineInformation()
frames = []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    cells = data.GetCellData()
    frames.append({"time": time, "places": [data.GetPoint(i) for i in range(data.GetNumberOfPoints())], "faces": data.GetNumberOfCells(),
                   "block": [cells.GetArray("block").GetTuple(i)[0] for i in range(data.GetNumberOfCells())],
                   "velocity": [cells.GetArray("velocity [m/s]").GetTuple(i) for i in range(data.GetNumberOfCells())]})
print("FRAMES" + json.dumps(frames))
"""

READ = """
import json, sys
from paraview import simple, servermanager
reader = simple.XDMFReader(FileNames=[sys.argv[1]])
reader.UpdatePipelineInformation()
frames = []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    arrays = [data.GetPointData().GetArray(i) for i in range(data.GetPointData().GetNumberOfArrays())]
    frames.append({"time": time, "places": [data.GetPoint(i) for i in range(data.GetNumberOfPoints())],
                   "fields": {a.GetName(): [a.GetTuple(i) for i in range(a.GetNumberOfTuples())] for a in arrays}})
print("FRAMES" + json.dumps(frames))
"""


@contextlib.contextmanager
def display():
    """A display to draw on: the one there is, or one of its own.

    It is ready when it has written its number. By default it begins anew when its last client leaves, and pvpython connects twice.
    """
    if os.environ.get("DISPLAY"):
        yield
        return
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset"], pass_fds=[write],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as numbers:
        number = numbers.readline().strip()
    assert number, "Xvfb did not start"
    os.environ["DISPLAY"] = ":" + number
    try:
        yield
    finally:
        server.terminate()
        server.wait()


def close(a, b, scale):
    # frames are single precision
    return abs(a - b) <= 2e-7 * scale


def main():
    with tempfile.TemporaryDirectory() as folder, display():
        place = pathlib.Path(folder)
        (place / "scene.json").write_text(json.dumps(SCENE))
        (place / "read.py").write_text(READ)
        subprocess.run([pathlib.Path(sys.argv[1]).resolve(), "run", "scene.json", "-o", "out"], cwd=place, check=True, capture_output=True)
        given = subprocess.run([*PVPYTHON, "read.py", place / "out/result.xdmf"], cwd=place, check=True, capture_output=True, text=True).stdout
        frames = json.loads(next(line[6:] for line in given.splitlines() if line.startswith("FRAMES")))
        with open(place / "out/spine.csv", newline="") as file:
            samples = list(csv.DictReader(line for line in file if not line.startswith("#")))
        assert len(frames) == 11, len(frames)
        for frame in frames:
            assert set(frame["fields"]) == {"size [m]", "velocity [m/s]", "quaternion", "contact force [N]"}, frame["fields"].keys()
            assert len(frame["places"]) == 3
            for size in frame["fields"]["size [m]"]:
                assert all(close(a, b, 1.0) for a, b in zip(size, (0.01271, 0.026355, 0.03978))), size
            for q in frame["fields"]["quaternion"]:
                assert close(sum(part * part for part in q), 1.0, 8.0), q
        check_motion(frames, samples)
        script = pathlib.Path(__file__).resolve().parents[2] / "scripts/paraview_blocks.py"
        subprocess.run([*PVPYTHON, script, "out", "blocks.png", "0.01"], cwd=place, check=True, capture_output=True)
        assert (place / "blocks.png").read_bytes().startswith(b"\x89PNG"), "no picture"
        check_surfaces(place, pathlib.Path(sys.argv[1]).resolve(), script)
    print("ParaView reads what musim writes")


def check_surfaces(place, musim, script):
    """Corners are those that `musim export` writes at the same times, and faces have the velocities of their block."""
    (place / "shapes.json").write_text(json.dumps(SHAPES))
    (place / "surfaces.py").write_text(READ_SURFACES)
    subprocess.run([musim, "run", "shapes.json", "-o", "shapes"], cwd=place, check=True, capture_output=True)
    given = subprocess.run([*PVPYTHON, "surfaces.py", place / "shapes/result.xdmf"], cwd=place, check=True,
                           capture_output=True, text=True)
    assert "ERR" not in given.stderr + given.stdout, given.stderr
    frames = json.loads(next(line[6:] for line in given.stdout.splitlines() if line.startswith("FRAMES")))
    assert len(frames) == 5, len(frames)
    for frame in frames:
        subprocess.run([musim, "export", "shapes", "-o", "shapes.obj", "--at", str(frame["time"])], cwd=place, check=True, capture_output=True)
        lines = [line.split() for line in (place / "shapes.obj").read_text().splitlines()]
        corners = sorted([float(word) for word in words[1:]] for words in lines if words[0] == "v")
        assert len(corners) == len(frame["places"]) == 24 + 8
        for a, b in zip(corners, sorted(frame["places"])):
            assert sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5 < 1e-6, (frame["time"], a, b)
        assert frame["faces"] == 14 + 6 and frame["block"] == [0] * 14 + [1] * 6
        # gravity has no part along x
        assert all(close(velocity[0], 1.0, 4.0) for velocity in frame["velocity"][:14]), frame["velocity"][0]
    assert frames[0]["places"] != frames[-1]["places"], "the surfaces do not move"
    subprocess.run([*PVPYTHON, script, "shapes", "shapes.png"], cwd=place, check=True, capture_output=True)
    assert (place / "shapes.png").read_bytes().startswith(b"\x89PNG"), "no picture of shapes"


def check_motion(frames, samples):
    """Velocities of the blocks of the spine are those of spine.csv at the same times."""
    names = [name for name in samples[0] if name.startswith("level") and name.endswith("_vx_m_s")]
    assert names, list(samples[0])
    for frame, sample in zip(frames, samples):
        for name in names:
            block = int(name[len("level"):].split("_")[0]) - 1
            velocity = frame["fields"]["velocity [m/s]"][block][0]
            assert close(velocity, float(sample[name]), 1.0), (frame["time"], name, velocity, sample[name])


if __name__ == "__main__":
    main()
