"""What other programs read: lines and images for ParaView, a script for RoboDK, a trajectory for ROS 2."""

import base64
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
import stiffarm
from conftest import path_of_program

EXAMPLES = Path(__file__).resolve().parents[3] / "docs/examples"
KUKA = "KR 210 R2700 extra"
SPACE = {"model": "spatial", "tool_mm": (0, 0, 200)}


def arrays(file):
    """Every array of a VTK file by its name, and the attributes of what holds it."""
    root = ET.parse(file).getroot()
    assert root.attrib["byte_order"] == "LittleEndian" and root.attrib["header_type"] == "UInt64"
    found = {}
    for array in root.iter("DataArray"):
        data = base64.b64decode(array.text)
        assert int.from_bytes(data[:8], "little") == len(data) - 8
        values = np.frombuffer(data[8:], "<f8" if array.attrib["type"] == "Float64" else "<i8")
        found.setdefault(array.attrib["Name"], []).append(values)
    return root, {name: parts[0] if len(parts) == 1 else parts for name, parts in found.items()}


@pytest.mark.parametrize("options", [{}, SPACE])
def test_an_image_holds_the_cells_of_the_map(tmp_path, options):
    found = stiffarm.map(KUKA, size=30, output=tmp_path / "map.vti", **options)
    root, layers = arrays(tmp_path / "map.vti")
    image = root.find("ImageData")
    nz, nx = found.worst_mm.shape
    assert image.attrib["WholeExtent"] == f"0 {nx - 1} 0 0 0 {nz - 1}"
    origin, spacing = ([float(part) for part in image.attrib[key].split()] for key in ("Origin", "Spacing"))
    assert np.allclose(origin[0] + spacing[0] * np.arange(nx), found.x_m, atol=1e-12) and origin[2] == found.z_m[0]
    assert origin[1] == 0 and np.isclose(spacing[2], found.z_m[1] - found.z_m[0])
    assert np.array_equal(layers["worst_mm"].reshape(nz, nx), found.worst_mm, equal_nan=True)
    if options:
        assert np.array_equal(layers["limit_margin_deg"].reshape(nz, nx), found.limit_margin_deg, equal_nan=True)


def test_lines_and_faces_stand_where_the_answer_has_them(tmp_path):
    file = tmp_path / "path.vtp"
    found = stiffarm.mill("rect:0.3x0.2", KUKA, force_n=400, feed_mm_per_min=600, at=(1.7, 0, 0.8, 20), tool_mm=(0, 0, 200), output=file)
    root, read = arrays(file)
    points, values = read["Points"].reshape(-1, 3), read["deflection_mm"]
    (lines, faces), (line_ends, face_ends) = read["connectivity"], read["offsets"]
    piece = root.find("PolyData/Piece").attrib
    assert [int(piece[f"NumberOf{what}"]) for what in ("Points", "Lines", "Polys")] == [len(points), len(line_ends), len(face_ends)]
    assert len(read["part"]) == len(line_ends) + len(face_ends) and line_ends[-1] == len(lines) and face_ends[-1] == len(faces)
    assert max(lines.max(), faces.max()) < len(points)
    assert np.nanmax(values) == found.worst_mm
    # The arm reaches from the base to the tool, which is at the path where the error is largest.
    arm = points[lines[: line_ends[0]]]
    at_worst = points[np.nanargmax(values)]
    assert np.allclose(arm[0], 0) and np.linalg.norm(arm[-1] - at_worst) < 1e-6
    # Of a place the faces fill the zone.
    best = stiffarm.place(KUKA, task="rect:0.3x0.2", output=tmp_path / "place.vtp", **SPACE)
    _, read = arrays(tmp_path / "place.vtp")
    assert np.nanmax(read["deflection_mm"][read["connectivity"][1]]) >= best.deflection_mm * (1 - 1e-9)


# The arm by its drawing, in mm, and KUKA's own axes: A1, A4 and A6 turn against the right hand. Shares nothing with the library.
STAND_IN = {
    "__init__.py": "",
    "robomath.py": """
import numpy
class Mat(numpy.matrix):
    pass
""",
    "robolink.py": """
import json, os
import numpy as np
from . import robomath
ITEM_TYPE_ROBOT = 2
CALLS = []
def turn(axis, deg):
    c, s = np.cos(np.radians(deg)), np.sin(np.radians(deg))
    a, b = [i for i in range(3) if i != axis]
    m = np.eye(4); m[a, a] = m[b, b] = c
    m[a, b], m[b, a] = (s, -s) if axis == 1 else (-s, s)
    return m
def shift(x, y, z):
    m = np.eye(4); m[:3, 3] = x, y, z
    return m
class Item:
    def __init__(self, what): self.what = what
    def __getattr__(self, name):
        def call(*given):
            CALLS.append([self.what, name, *[one.what if isinstance(one, Item) else np.asarray(one).tolist() if not isinstance(one, str) else one for one in given]])
            return Item(given[1] if name == "AddTool" else name)
        return call
    def Valid(self): return True
    def Name(self): return "stand-in"
    def Parent(self): return Item("base")
    def SolveFK(self, q):
        ahead = float(os.environ["AHEAD"])
        m = turn(2, -q[0]) @ shift(ahead, 0, 675) @ turn(1, q[1]) @ shift(1150, 0, 0) @ turn(1, q[2]) @ shift(1200, 0, -41)
        m = m @ turn(0, -q[3]) @ turn(1, q[4]) @ turn(0, -q[5]) @ shift(215, 0, 0) @ turn(1, 90)
        return robomath.Mat(m)
class Robolink:
    def ItemUserPick(self, message, kind): return Item("robot")
    def __getattr__(self, name):
        def call(*given):
            CALLS.append(["station", name, *[one.what if isinstance(one, Item) else one for one in given]])
            return Item(given[0] if given else name)
        return call
import atexit
atexit.register(lambda: open(os.environ["CALLS"], "w").write(json.dumps(CALLS)))
""",
}


def run(script, tmp_path, ahead):
    package = tmp_path / "robodk"
    package.mkdir(exist_ok=True)
    for name, text in STAND_IN.items():
        (package / name).write_text(text)
    calls = tmp_path / "calls.json"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "AHEAD": str(ahead), "CALLS": str(calls)}
    ended = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True)
    return ended, json.loads(calls.read_text())


def test_the_script_for_robodk_makes_frame_tool_targets_and_program(tmp_path):
    at = (1.7, 0, 0.8, 20)
    milled = stiffarm.mill("line:0.1", KUKA, force_n=400, feed_mm_per_min=600, at=at, tool_mm=(0, 0, 200))
    script = milled.program("py")
    ended, calls = run(script, tmp_path, 350)
    assert ended.returncode == 0, ended.stderr
    named = [call[:2] for call in calls]
    targets = [call for call in calls if call[1] == "AddTarget"]
    assert all(call[3:] == ["STIFFARM part", "robot"] for call in targets)
    joint, straight = named.count(["STIFFARM", "MoveJ"]), named.count(["STIFFARM", "MoveL"])
    assert joint == 1 and joint + straight == len(targets) == len(milled.to_pandas()) + 1
    (frame,) = (call[2] for call in calls if call[:2] == ["STIFFARM part", "setPose"])
    assert np.allclose(np.array(frame)[:3, 3], [1700, 0, 800]) and np.isclose(np.degrees(np.arctan2(frame[1][0], frame[0][0])), 20)
    (tool,) = (call[2] for call in calls if call[1] == "AddTool")
    assert np.allclose(tool, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 200], [0, 0, 0, 1]])
    assert [call[2] for call in calls if call[1] == "setSpeed"][-1] == 10
    # Joints by the program are those of the answer.
    joints = np.array([call[2] for call in calls if call[1] == "setJoints"])[1:]
    assert np.allclose(joints, milled.to_pandas()[[f"q{i}_deg" for i in range(1, 7)]], atol=1e-6)


def test_of_another_arm_nothing_is_made(tmp_path):
    milled = stiffarm.mill("line:0.1", KUKA, force_n=400, feed_mm_per_min=600, at=(1.7, 0, 0.8, 20), tool_mm=(0, 0, 200))
    ended, calls = run(milled.program("py"), tmp_path, 360)
    assert ended.returncode == 1 and "10.000 mm" in ended.stderr and "Nothing was made" in ended.stderr, ended.stderr
    assert not calls


def test_a_trajectory_takes_as_long_as_the_path_at_its_feed(tmp_path):
    file = tmp_path / "path.yaml"
    stiffarm.mill("line:0.1", KUKA, force_n=400, feed_mm_per_min=600, at=(1.7, 0, 0.8, 20), tool_mm=(0, 0, 200), output=file)
    points = [line for line in file.read_text().splitlines() if line.startswith("  - ")]
    sec, nanosec = (int(points[-1].split(key)[1].split(",")[0].rstrip("}")) for key in ("sec: ", "nanosec: "))
    first_sec, first_nanosec = (int(points[1].split(key)[1].split(",")[0].rstrip("}")) for key in ("sec: ", "nanosec: "))
    assert sec - first_sec + (nanosec - first_nanosec) / 1e9 == pytest.approx(10, abs=1e-6)


def test_the_notebook_for_compas_runs_against_the_server(tmp_path, monkeypatch, capsys):
    import compas

    notebook = json.loads((EXAMPLES / "compas.ipynb").read_text())
    assert all(not cell.get("outputs") for cell in notebook["cells"])
    monkeypatch.chdir(tmp_path)
    with subprocess.Popen([path_of_program(), "serve"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as server:
        try:
            line = server.stdout.readline()
            monkeypatch.setenv("STIFFARM_SERVER", line[line.index("http://") :].split()[0].rstrip("/"))
            names: dict[str, object] = {}
            for i, cell in enumerate(cell for cell in notebook["cells"] if cell["cell_type"] == "code"):
                exec(compile("".join(cell["source"]), f"cell {i}", "exec"), names)
        finally:
            server.terminate()
    found = compas.json_load(tmp_path / "place.json")
    assert found["zone"].area() == pytest.approx(0.24, rel=1e-9)
    best = stiffarm.place(KUKA, task="rect:0.6x0.4", tolerance_mm=2, **SPACE)
    assert max(found["zone"].vertices_attribute("deflection_mm")) == pytest.approx(best.deflection_mm, rel=1e-3)
    assert f"{best.deflection_mm:.3f} mm at worst" in capsys.readouterr().out
