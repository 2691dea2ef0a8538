"""Are toolpaths and forces in Python those of the program?"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import stiffarm

ROOT = Path(__file__).parents[3]
PROCESS = ROOT / "docs/examples/endmill.toml"


def test_the_force_of_a_process_is_the_programs(program) -> None:
    force = stiffarm.force(PROCESS)
    assert force.to_dict() == program("force", str(PROCESS))
    assert np.all(force.min_n <= force.mean_n) and np.all(force.mean_n <= force.max_n)
    frame = force.to_pandas()
    # Evenly over a revolution: the mean of the columns is the mean that is given in closed form.
    assert np.allclose(frame[["feed_n", "across_n", "axial_n"]].mean(), force.mean_n, rtol=1e-4)


def test_a_measured_force_lies_beside_its_process(program, tmp_path: Path) -> None:
    (tmp_path / "f.csv").write_text("time_s,fx_n,fy_n,fz_n\n0,1,2,3\n5,1,2,3\n")
    process = tmp_path / "p.toml"
    process.write_text('[measured]\nfile = "f.csv"\non = "work"\n')
    force = stiffarm.force(process)
    assert force.to_dict() == program("force", str(process)) and list(force.mean_n) == [-1, -2, -3]


def test_a_path_is_understood_as_the_program_does(program) -> None:
    for path in ("circle:0.3", str(ROOT / "crates/stiffarm/tests/paths/contour_ij.nc")):
        assert stiffarm.mill(path, dry=True).to_dict() == program("mill", path, "--dry")
    assert stiffarm.mill("circle:0.3", dry=True).feed_length_m == pytest.approx(0.3 * np.pi, rel=1e-14)


def test_what_is_refused_says_line_and_word() -> None:
    path = ROOT / "crates/stiffarm/tests/paths/thread_mill_g91_g42_inch.gcode"
    with pytest.raises(stiffarm.StiffarmError, match="G42: cutter compensation"):
        stiffarm.mill(path, dry=True)
    assert stiffarm.mill(path, dry=True, cutter_compensation="centre").arcs == 10
    with pytest.raises(stiffarm.StiffarmError, match="robot is missing; .* `dry` none is needed"):
        stiffarm.mill("circle:0.3")
    with pytest.raises(stiffarm.StiffarmError, match="robot and dry exclude each other"):
        stiffarm.mill("circle:0.3", "KR 210 R2700 extra", dry=True)  # type: ignore[call-overload]
    with pytest.raises(stiffarm.StiffarmError, match="force_n"):
        stiffarm.mill("circle:0.3", "KR 210 R2700 extra")
    with pytest.raises(stiffarm.StiffarmError, match="expected True or False"):
        stiffarm.mill("circle:0.3", dry="yes")  # type: ignore[arg-type]


def test_a_milled_path_is_the_programs(program) -> None:
    options = {"tool": "spindle:250@90", "force_n": (300, -120, 80), "at": (1.7, 0, 0.8, 20), "roll": "constant"}
    milled = stiffarm.mill("circle:0.2", "KR 210 R2700 extra", tolerance_mm=0.3, compensate=True, **options)
    typed = ["--tool", "spindle:250@90", "--force-n", "300,-120,80", "--at", "1.7,0,0.8,20", "--roll", "constant"]
    answer = program("mill", "circle:0.2", "--robot", "KR 210 R2700 extra", *typed, "--tolerance-mm", "0.3", "--compensate")
    assert milled.to_dict() == answer
    frame = milled.to_pandas()
    assert len(frame) == milled.part["samples"] and frame["error_mm"].max() == milled.worst_mm
    assert milled.passes is False and milled.at_m.shape == (3,)
    assert np.allclose(frame[[f"q{i}_deg" for i in range(1, 7)]].iloc[milled.worst_sample], milled.worst_joints_deg)


def test_every_tool_of_a_path_has_its_process_and_its_length(program, tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    cut = "S12000 M3 F600\nG0 X0 Y0 Z5\nG1 Z0\nG1 X40\nG0 Z5\n"
    file.write_text(f"G17 G21 G90\nT1 M6\n{cut}T2 M6\n{cut}M30\n")
    options = {"tool": "spindle:250@90", "at": (1.7, 0, 0.8), "step_mm": 20}
    milled = stiffarm.mill(file, "KR 210 R2700 extra", process={1: PROCESS, 2: str(PROCESS)}, tool_lengths_mm={1: 82.5, 2: 140}, **options)
    typed = ["--tool", "spindle:250@90", "--at", "1.7,0,0.8", "--step-mm", "20", "--process", f"T1={PROCESS},T2={PROCESS}", "--tool-lengths-mm", "T1=82.5,T2=140"]
    assert milled.to_dict() == program("mill", str(file), "--robot", "KR 210 R2700 extra", *typed)
    assert milled.by_tool is not None and [one["tool_number"] for one in milled.by_tool] == [1, 2] and milled.worst_tool in (1, 2)
    as_texts = {"process": [f"T1={PROCESS}", f"T2={PROCESS}"], "tool_lengths_mm": {"T1": 82.5, "T2": 140}}
    assert stiffarm.mill(file, "KR 210 R2700 extra", **as_texts, **options) == milled
    one = stiffarm.mill(file, "KR 210 R2700 extra", process=PROCESS, only_tool=2, **options)
    assert one.worst_mm is not None and one.by_tool is None
    for given, says in [({"tool_lengths_mm": {1: "long"}}, "T1=long"), ({"process": {1: "none.toml"}, "only_tool": 1}, "none.toml")]:
        with pytest.raises(stiffarm.StiffarmError, match=says):
            stiffarm.mill(file, "KR 210 R2700 extra", **{"process": PROCESS, **given}, **options)  # type: ignore[arg-type]


def test_robots_ranked_on_a_path_are_the_programs(program) -> None:
    options = {"tool": "spindle:250@90", "force_n": 400, "step_mm": 50, "error": "across", "within_m": "1.4..1.8,0.6..0.9"}
    ranked = stiffarm.mill("line:0.1", robots=["KR 210 R2700 extra", "Staubli TX340 SH", "IRB 6650S*"], vendor="KUKA", tolerance_mm=2, **options)
    typed = ["--tool", "spindle:250@90", "--force-n", "400", "--step-mm", "50", "--error", "across", "--tolerance-mm", "2", "--within", "1.4..1.8,0.6..0.9"]
    names = "KR 210 R2700 extra,Staubli TX340 SH,IRB 6650S*"
    assert ranked.to_dict() == program("mill", "line:0.1", "--robots", names, "--vendor", "KUKA", *typed)
    assert len(ranked) == 1 and "best KR 210 R2700 extra" in repr(ranked)
    frame = ranked.to_pandas()
    assert frame["worst_mm"][0] == ranked.rows[0]["worst_mm"] and ranked.rows[0]["roll"]["mode"] == "free"


def test_who_mills_must_be_clear() -> None:
    kuka = "KR 210 R2700 extra"
    for given, match in [
        ({"robot": kuka, "robots": [kuka]}, "robot and robots exclude each other"),
        ({"robot": kuka, "vendor": "KUKA"}, "vendor and robot exclude each other"),
        ({"robots": "paper", "dry": True}, "robots and dry exclude each other"),
        ({"vendor": "nobody"}, "none of .* robots matches vendor nobody"),
        ({"robots": [kuka], "vendor": "ABB"}, "none of 1 robots matches vendor ABB"),
        ({"robots": []}, "robots"),
    ]:
        with pytest.raises(stiffarm.StiffarmError, match=match):
            stiffarm.mill("line:0.1", **given)  # type: ignore[call-overload]


@pytest.mark.filterwarnings("ignore:.*is read by controllers of")
def test_programs_and_rewritten_paths_are_the_programs(tmp_path: Path) -> None:
    """As the program writes them, at the place that the answer gives."""
    import os
    import subprocess

    file = tmp_path / "part.nc"
    file.write_text("G21 G90\nG0 X0 Y0 Z5\nG1 Z0 F600\nG1 X50\nG1 Y20\nM30\n")
    options = {"tool": "spindle:250@90", "force_n": (300, -120, 80), "at": (1.7, 0, 0.8, 20), "compensate": True}
    milled = stiffarm.mill(file, "KR 210 R2700 extra", **options)
    typed = ["--tool", "spindle:250@90", "--force-n", "300,-120,80", "--at", "1.7,0,0.8,20", "--compensate"]
    program = os.environ.get("STIFFARM_PROGRAM", str(ROOT / "target/debug/stiffarm"))
    for ending, text in [("src", milled.program("src")), ("mod", milled.program("mod")), ("ls", milled.program("ls")), ("nc", milled.rewritten())]:
        written = tmp_path / f"out.{ending}"
        asked = [program, "mill", str(file), "--robot", "KR 210 R2700 extra", *typed, "-o", str(written), "--quiet"]
        subprocess.run(asked, check=True, capture_output=True)
        assert text == written.read_text(), ending
    plain = stiffarm.mill("line:0.1", "KR 210 R2700 extra", feed_mm_per_min=600, force_n=400, at=(1.7, 0, 0.8, 20))
    assert plain.program("src").startswith("&ACCESS") or "DEF" in plain.program("src")
    for refused, says in [(plain.rewritten, "built in"), (lambda: plain.program("exe"), "expected src, mod, ls, py or yaml")]:  # type: ignore[arg-type]
        with pytest.raises(stiffarm.StiffarmError, match=says):
            refused()


def test_published_numbers_are_those_of_the_program(program) -> None:
    ledger = stiffarm.validate()
    assert ledger.to_dict() == program("validate")
    assert len(ledger) == len(ledger.to_pandas()) and "agree" in repr(ledger)
