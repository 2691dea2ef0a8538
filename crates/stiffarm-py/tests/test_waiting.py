"""Ctrl-C ends long calls soon, and a callable is given how far they are."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import stiffarm
from stiffarm import StiffarmError, _progress

# Of identification: where the load was hung is taken from the table's silence.
pytestmark = pytest.mark.filterwarnings("ignore:no load point is given")

#: Calls in turn, each of which takes minutes where nothing stops it; half a second after each has begun comes what Ctrl-C sends.
INTERRUPTED = """
import os, signal, sys, threading, time
import stiffarm

tool = {"model": "spatial", "tool_mm": "100,50,250,0,60,0", "angle": "free"}
robot = "KR 210 R2700 extra"
calls = {
    "place": lambda: [stiffarm.place(robot, task=f"rect:0.4x{0.3 + i / 1000}", **tool) for i in range(200)],
    "part": lambda: [stiffarm.place(robot, task=f"box:0.4x{0.3 + i / 1000}x0.1", **tool) for i in range(200)],
    "rank": lambda: stiffarm.rank("all", tasks="rect:0.4x0.3", **tool),
    "rank in the plane": lambda: stiffarm.rank("all", tasks=[f"rect:{0.3 + i / 1e5}x0.2" for i in range(4000)], angle="free"),
    "map": lambda: stiffarm.map(robot, size=2000, model="spatial", tool_mm=tool["tool_mm"]),
    "measure": lambda: stiffarm.measure(robot, candidates=1_000_000, runs=1000),
    "study": lambda: stiffarm.study(sizes=[i / 1000 for i in range(1, 1000)], ratios=[0.5 + i / 200 for i in range(160)]),
}
stiffarm.set_threads(int(sys.argv[1]) or None)
for name, call in calls.items():
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    begun = time.monotonic()
    try:
        timer.start()
        call()
    except KeyboardInterrupt:
        print(name, "is interrupted", f"{time.monotonic() - begun - 0.5:.2f} s later")
    else:
        print(name, "is answered")
    timer.join()
"""


@pytest.mark.parametrize("threads", ["0", "1"])
def test_ctrl_c_ends_every_call(threads):
    done = subprocess.run([sys.executable, "-c", INTERRUPTED, threads], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == 7 and all("is interrupted" in line for line in lines), done.stdout
    # Within a second where the machine does nothing else; here only that nobody has waited for the answer.
    assert all(float(line.split()[-3]) < 15 for line in lines), done.stdout


EXAMPLES = Path(__file__).parents[3] / "docs/examples"
CALLS = {
    "place": lambda **more: stiffarm.place("KR 210 R2700 extra", task="rect:0.8x0.5", angle="free", within_m="0.9..1.9,0..0.8", **more),
    "rank": lambda **more: stiffarm.rank(["BT200L", "KR 210 R2700 extra"], tasks=["A:0.1", "B:0.5", "A:9"], **more),
    "map": lambda **more: stiffarm.map("BT200L", size=300, **more),
    "study": lambda **more: stiffarm.study(**more),
    "compliance": lambda **more: stiffarm.compliance("BT200L", joints_deg=np.zeros((9000, 6)), **more),
    "identify": lambda **more: stiffarm.identify(EXAMPLES / "fanuc_r2000ic.csv", robot=EXAMPLES / "fanuc_r2000ic.toml", model="auto", **more),
    "measure": lambda **more: stiffarm.measure("KR 210 R2700 extra", candidates=400, **more),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("threads", [None, 1])
def test_a_callable_is_called_and_changes_nothing(call, threads):
    seen = []
    stiffarm.set_threads(threads)
    try:
        answer = CALLS[call](progress=lambda done, total: seen.append((done, total)))
    finally:
        stiffarm.set_threads(None)
    assert answer == CALLS[call]() == CALLS[call](progress=True) == CALLS[call](progress=False)
    done, total = seen[-1]
    if call in ("place", "measure"):
        assert 0 < done and total is None
    else:
        assert done == total == {"rank": 6, "compliance": 3, "identify": 5}.get(call, total)
    assert seen == sorted(seen, key=lambda one: one[0])


class Enough(Exception):
    pass


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("threads", [None, 1])
def test_what_a_callable_raises_ends_the_call(call, threads):
    def refuse(done, total):
        raise Enough(done)

    stiffarm.set_threads(threads)
    try:
        with pytest.raises(Enough):
            CALLS[call](progress=refuse)
        # And the next call is none the worse.
        assert CALLS[call]() is not None
    finally:
        stiffarm.set_threads(None)


def test_long_work_is_stopped_by_what_a_callable_raises():
    seen = []

    def refuse(done, total):
        seen.append((done, total))
        raise Enough

    for threads in (None, 1):
        stiffarm.set_threads(threads)
        try:
            with pytest.raises(Enough):
                stiffarm.rank("all", tasks="rect:0.4x0.3", model="spatial", tool_mm=(100, 50, 250), progress=refuse)
        finally:
            stiffarm.set_threads(None)
    assert len(seen) == 2 and all(done < total for done, total in seen)


def test_only_what_can_be_called_is_taken():
    for call in CALLS.values():
        with pytest.raises(StiffarmError, match="progress is a str; expected None, True or a callable"):
            call(progress="yes")


class Terminal:
    def __init__(self):
        self.text = ""

    def isatty(self):
        return True

    def write(self, text):
        self.text += text

    def flush(self):
        pass


def test_a_line_is_shown_on_terminals_alone_and_wiped(monkeypatch, capsys):
    CALLS["rank"](progress=True)
    assert capsys.readouterr().err == ""
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    CALLS["rank"](progress=True)
    assert "placing zones [##############################] 6/6" in terminal.text
    assert terminal.text.endswith("\r") and terminal.text.split("\r")[-2].strip() == ""
    CALLS["place"](progress=True)
    assert "searching places, 0 s" in terminal.text


def test_a_bar_is_as_full_as_the_work():
    assert [_progress.bar(done, 4).count("#") for done in range(5)] == [0, 7, 15, 22, 30]
    assert {len(_progress.bar(done, 4)) for done in range(5)} == {32} and _progress.bar(0, 0).count("#") == 0
