"""ParaView reads result.xdmf: times, places, sizes, turns and velocities of all blocks, with units in their names; scripts/paraview_blocks.py
makes a picture of it.

usage: paraview_test.py MUSIM. Exit code 77: skipped, since there is no ParaView.
"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
if shutil.which("pvpython") is None:
    print("skipped: there is no pvpython (Debian: paraview, python3-paraview)")
    sys.exit(SKIPPED)

SCENE = {
    "schema": "musim-scene/1", "name": "column", "material": "wood",
    "structure": {"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
    "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.5 g", "duration": "20 ms"},
    "time": {"duration": "20 ms"}, "output": {"spine_rate": "500 Hz", "frame_rate": "500 Hz"},
}

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


def close(a, b, scale):
    # frames are single precision
    return abs(a - b) <= 2e-7 * scale


def main():
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        (place / "scene.json").write_text(json.dumps(SCENE))
        (place / "read.py").write_text(READ)
        subprocess.run([pathlib.Path(sys.argv[1]).resolve(), "run", "scene.json", "-o", "out"], cwd=place, check=True, capture_output=True)
        given = subprocess.run(["pvpython", "--force-offscreen-rendering", "read.py", place / "out/result.xdmf"], cwd=place, check=True, capture_output=True, text=True).stdout
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
        subprocess.run(["pvpython", "--force-offscreen-rendering", script, "out", "blocks.png", "0.01"], cwd=place, check=True, capture_output=True)
        assert (place / "blocks.png").read_bytes().startswith(b"\x89PNG"), "no picture"
    print("ParaView reads what musim writes")


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
