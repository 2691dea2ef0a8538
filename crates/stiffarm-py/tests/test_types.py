"""What the types promise is what the answers hold."""

import os
import subprocess
import sys
import typing
from pathlib import Path

import numpy as np
import pytest
import stiffarm

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[2] / "docs/examples"
JOINTS = np.random.default_rng(3).uniform(-90, 90, (4, 6))
SPACE = {"model": "spatial", "tool_mm": (100, 0, 200), "roll_deg": 0}
ALONG = {"process": EXAMPLES / "endmill.toml", "tool_mm": (0, 0, 200), "step_mm": 20}
ON_PATH = {"at": (1.8, 0, 0.8), **ALONG}
ANSWERS = {
    "place": lambda: stiffarm.place("BT200L", task="B:0.3", tolerance_mm=2, within_m="0.5..,0.."),
    "no place": lambda: stiffarm.place("BT200L", task="A:9"),
    "in space": lambda: stiffarm.place("KR 210 R2700 extra", task="circle:0.3", **SPACE),
    "in a cell": lambda: stiffarm.place("KR 210 R2700 extra", task="circle:0.3", mount="pedestal:0.4", **SPACE),
    "a part": lambda: stiffarm.place("KR 210 R2700 extra", task="box:0.3x0.2x0.1", faces="top", angle=0, model="spatial"),
    "under a force": lambda: stiffarm.place("KR 210 R2700 extra", task="circle:0.2", force_n=(300, 100, 50), feed_deg=20, **SPACE),
    "rank": lambda: stiffarm.rank(tasks=["A:0.3", "A:9"], tolerance_mm=2),
    "rank in space": lambda: stiffarm.rank("KR 210 R2700 extra", tasks="circle:0.3", **SPACE),
    "cell": lambda: stiffarm.rank(tasks="A:0.3").cell("BT200L", "A:0.3"),
    "study": lambda: stiffarm.study(sizes=[0.2, 3]),
    "map": lambda: stiffarm.map("BT200L", size=12, zone="B:0.3"),
    "directed": lambda: stiffarm.map("BT200L", size=12, direction_deg=20),
    "section": lambda: stiffarm.map("BT200L", size=6, model="spatial"),
    "posture": lambda: stiffarm.compliance("BT200L", joints_deg=JOINTS[0]),
    "posture under a force": lambda: stiffarm.compliance("BT200L", joints_deg=JOINTS[0], force_n=(1, 2, 3)),
    "by the prior": lambda: stiffarm.rank(["KR 210 R2700 extra", "KR 210 R2700-2"], tasks=["A:0.3", "A:9"], stiffness="prior"),
    "identify": lambda: stiffarm.identify(EXAMPLES / "fanuc_r2000ic.csv", robot=EXAMPLES / "fanuc_r2000ic.toml", model="base-and-tool"),
    "modes": lambda: stiffarm.modes("KR 210 R2700-2", joints_deg=(0, -90, 90, 0, 45, 0), tool_mass_kg=60, tool_com_mm=(0, 0, 200)),
    "modes over a zone": lambda: stiffarm.modes("KR 210 R2700-2", task="circle:0.2", at=(1.5, 1.0), tool_mass_kg=60, tool_com_mm=(0, 0, 200)),
    "chatter": lambda: stiffarm.chatter(EXAMPLES / "endmill.toml", "KR 210 R2700-2", joints_deg=(0, -90, 90, 0, 90, 0), feed=(1, 0, 0)),
    "calibrate": lambda: stiffarm.calibrate("KR 210 R2700 extra", EXAMPLES / "tracker.csv", at=(1.8, 0, 0.8)),
    "verify": lambda: stiffarm.verify("KR 210 R2700 extra", EXAMPLES / "pendant.csv"),
    "verify measured": lambda: stiffarm.verify("KR 210 R2700-2", EXAMPLES / "tracker.csv"),
    "verify any": lambda: stiffarm.verify(None, EXAMPLES / "pendant.csv", any=True),
    "measure": lambda: stiffarm.measure("KR 210 R2700 extra", runs=6, candidates=200),
    "measure to calibrate": lambda: stiffarm.measure("KR 210 R2700 extra", geometry=True, runs=8, candidates=40),
    "compare": lambda: stiffarm.compare("BT200L", "KR 210 R2700-2", task="A:0.3"),
    "force": lambda: stiffarm.force(EXAMPLES / "endmill.toml"),
    "path": lambda: stiffarm.mill("circle:0.3", dry=True),
    "mill": lambda: stiffarm.mill("circle:0.1", "KR 210 R2700 extra", **ON_PATH),
    "mill, compensated": lambda: stiffarm.mill("circle:0.1", "KR 210 R2700 extra", compensate=True, tolerance_mm=1, **ON_PATH),
    "rank on a path": lambda: stiffarm.mill("line:0.05", robots=["KR 210 R2700-2"], within_m="1.6..1.7,0.8..0.8", roll=0, **ALONG),
    "validate": lambda: stiffarm.validate(),
}
CLASSES = [kind for kind in vars(stiffarm).values() if isinstance(kind, type) and issubclass(kind, stiffarm.Answer) and kind is not stiffarm.Answer]
KEYS = {kind.__name__: typing.get_args(kind.__orig_bases__[0])[0] for kind in CLASSES}


def fits(value, kind, where):
    """Is a value what an annotation says? A reading of its own: no type checker looks at values."""
    parts = typing.get_args(kind) if typing.get_origin(kind) is typing.Union or "UnionType" in type(kind).__name__ else (kind,)
    if value is None:
        assert type(None) in parts or kind is None, f"{where} is None; {kind} does not say so"
        return
    of_dict = [part for part in parts if typing.is_typeddict(part)]
    of_list = [part for part in parts if typing.get_origin(part) is list]
    if isinstance(value, dict):
        assert of_dict, f"{where}: {kind}"
        hints = typing.get_type_hints(of_dict[0])
        assert value.keys() <= hints.keys() and of_dict[0].__required_keys__ <= value.keys(), (where, value.keys() ^ hints.keys())
        for key, part in value.items():
            fits(part, hints[key], f"{where}.{key}")
    elif isinstance(value, list):
        assert of_list, f"{where}: {kind}"
        for item in value:
            fits(item, typing.get_args(of_list[0])[0], f"{where}[]")
    else:
        assert type(value) in parts, f"{where} is {value!r}; {kind}"


@pytest.mark.skipif(sys.version_info < (3, 10), reason="annotations with | are read from 3.10 on")
@pytest.mark.filterwarnings("ignore:.*beyond its limits")
@pytest.mark.filterwarnings("ignore:no load point is given")
@pytest.mark.parametrize("name", ANSWERS)
def test_answers_hold_what_their_types_say(name):
    answer = ANSWERS[name]()
    fits(answer.to_dict(), KEYS[type(answer).__name__], name)


@pytest.mark.parametrize("answer", KEYS)
def test_every_key_is_an_attribute(answer):
    """Type checkers know attributes by their annotations alone."""
    keys = typing.get_type_hints(KEYS[answer]).keys() - {"pass"} if sys.version_info >= (3, 10) else set()
    known = {name for kind in getattr(stiffarm, answer).__mro__ for name in kind.__dict__.get("__annotations__", ())}
    assert keys <= known, keys - known


def test_a_wrong_key_is_an_error_for_the_type_checker(tmp_path):
    config = HERE.parent / "pyproject.toml"
    command = [sys.executable, "-m", "mypy", "--config-file", str(config), "--cache-dir", str(tmp_path)]
    done = subprocess.run(
        [*command, str(HERE / "typed" / "wrong_keys.py")], capture_output=True, text=True, env={**os.environ, "MYPY_FORCE_COLOR": "0"}
    )
    assert done.returncode == 0, done.stdout + done.stderr
