"""Writes validation/rs274_cases.txt: small G-code programs, and how LinuxCNC's interpreter rs274 moves the tool.

Programs are written here by hand, one for each thing that readers get wrong, or drawn from a fixed seed. Each begins with a rapid
move that names X, Y and Z: where the tool comes from is not in a file. What is recorded is in mm, from the origin of the work offset,
with G52 and G92 added: `rapid x y z`, `feed x y z f`, `arc x y z f plane a b turns` with the centre along the first and second axis of
the plane and turns begun, negative clockwise. Moves that go nowhere are left out. `refused` is recorded where rs274 stops with an error.

rs274 prints four decimals of mm or inches, so that what it tells is within 0.05 um or 1.3 um.
"""

from __future__ import annotations

import math
import pathlib
import random
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGET = ROOT / "validation/rs274_cases.txt"
INCH = 25.4
# An empty answer comes now and then: it is asked again.
TRIES = 5

# rs274 takes F in the unit before that of its block; G99 is in force where nothing is said, on other controls G98.
MM, IN = "G21 G90 G17 F100", "G20 G90 G17\nF10."
START = "G0 X0 Y0 Z5"

# Name, lines of a program. A name that ends in `pecks` is compared by the ends of its feed moves: how far the tool goes back between pecks
# differs between makers.
WRITTEN: list[tuple[str, str]] = [
    ("lower case without blanks", f"{MM}\n{START}\ng1x10y-.5z0f200\nx+20.25\nn40y1.\nm2"),
    ("blanks within words", f"{MM}\n{START}\nG 1 X 1 0 . 5 F 1 2 0\nY - 3\nM2"),
    ("remarks everywhere", f"(head)\n{MM} (a) ; b\n{START}\nG1 (x) X10 (y) Y5 ; Z-9\nM2"),
    ("percent signs", f"%\n{MM}\n{START}\nG1 X10\n%"),
    ("block numbers and programs", f"O7 (name)\nN10 {MM}\nN20 {START}\nN30 G1 X5\nN40 Y5\nN50 M30"),
    ("words in any order", f"{MM}\n{START}\nF150 Y3 X4 G1\nX8 F80 Y6 G1 Z1\nM2"),
    ("feed before inches", f"F250.\nG20 G90 G17\n{START}\nG1 X1\nM2"),
    ("feed before millimetres", f"G20\nF10.\nG21 G90 G17\n{START}\nG1 X1\nM2"),
    ("inches to millimetres and back", f"{IN}\n{START}\nG1 X1.\nG21\nX50.8\nG20 Y2.\nF5. X0\nM2"),
    ("incremental moves", f"{MM}\n{START}\nG91 G1 X1 Y2\nX1\nZ-3\nG90 X0\nM2"),
    ("incremental inches", f"{IN}\n{START}\nG91\nG1 X.1\nG21 X2.54\nG90 X0\nM2"),
    ("a dwell in the block of a motion", f"{MM}\n{START}\nG1 X10\nG4 P1 G1 X50\nG4 P.5 X60\nM2"),
    ("a dwell by itself", f"{MM}\n{START}\nG1 X10\nG4 P1\nX20\nM2"),
    ("G52", f"{MM}\n{START}\nG52 X1 Y2\nG1 X5 Y0\nG52 X0 Y0\nG1 X5\nM2"),
    ("G52 and G92.1", f"{MM}\n{START}\nG1 X1\nG52 X5\nG1 X1\nG92.1\nG1 X2\nM2"),
    ("G92", f"{MM}\n{START}\nG1 X10\nG92 X0 Y1\nG1 X5 Y2\nG92.1\nG1 X20 Y0\nM2"),
    ("G92 suspended", f"{MM}\n{START}\nG1 X1\nG92 X5\nG1 X1\nG92.2\nG1 X2\nG92.3\nX3\nM2"),
    ("G92 in inches", f"{IN}\n{START}\nG1 X1\nG92 X0 Z0\nG1 X1 Z-1\nM2"),
    ("G92 of all at once, again", f"{MM}\n{START}\nG92 X0 Y0 Z0\nG1 X5\nG92 X1\nG1 X0\nM2"),
    ("a quarter by centre", f"{MM}\n{START}\nG1 X10 Z0\nG3 X0 Y10 I-10 J0\nM2"),
    ("three quarters by centre", f"{MM}\n{START}\nG1 X10 Z0\nG2 X0 Y10 I-10 J0\nM2"),
    ("a full circle", f"{MM}\n{START}\nG1 X10 Z0\nG2 I-10\nG3 X10 Y0 I5 J0\nM2"),
    ("half a circle without a word", f"{MM}\n{START}\nG2 X10 I5\nX20\nM2".replace("\nX20", "\nX20 I5")),
    ("arcs by radius", f"{MM}\n{START}\nG2 X10 Y10 R10\nG3 X0 Y0 R-10\nG2 X4 Y0 R2\nM2"),
    ("arcs by radius in inches", f"{IN}\n{START}\nG3 X1. Y1. R1.\nG2 X2. Y0 R-1.5\nM2"),
    ("a helix", f"{MM}\n{START}\nG1 X10 Z0\nG3 X-10 Z-3 I-10 J0\nG3 X10 Z-6 I10 J0\nM2"),
    ("a helix of turns", f"{MM}\n{START}\nG1 X10 Z0\nG3 X-10 Z-3 I-10 J0 P3\nG2 X10 Z0 I10 P2\nM2"),
    ("a full helix", f"{MM}\n{START}\nG1 X10 Z0\nG2 Z-2 I-10 J0\nZ-4 I-10\nM2"),
    ("arcs in ZX", f"{MM}\n{START}\nG1 Z10\nG18 G2 X10 Z0 I0 K-10\nG3 X0 Z10 R-10\nM2"),
    ("arcs in YZ", f"{MM}\n{START}\nG1 Z10\nG19 G2 Y10 Z0 J0 K-10\nG3 Y0 Z10 R10\nM2"),
    ("a helix in ZX", f"{MM}\n{START}\nG18 G3 X5 Y2 Z10 I0 K5\nG17 G2 X9 Y2 I2\nM2"),
    ("absolute centres", f"{MM}\n{START}\nG90.1\nG1 X10 Z0\nG2 X20 Y10 I20 J0\nG91.1\nG3 X30 Y20 I0 J10\nM2"),
    ("arcs of an inch of four decimals", f"{IN}\n{START}\nG1 X.7071\nG3 X0 Y.7071 I-.7071 J0\nG2 X.5 Y1.2071 I.5 J0\nM2"),
    ("an arc that misses by a thousandth of two inches", f"{IN}\n{START}\nG2 Y4.001 I0 J2.\nM2"),
    ("an arc that misses by 0.01 mm", f"{MM}\n{START}\nG2 X10.01 I5\nM2"),
    ("arcs under G91", f"{MM}\n{START}\nG91 G2 X10 I5\nG3 X5 Y5 R5\nG90 G1 X0\nM2"),
    ("an arc from G0 and back", f"{MM}\n{START}\nG0 X10\nG2 X20 I5\nG0 X0\nG1 Y1\nM2"),
    ("inverse time", f"{MM}\n{START}\nG93 G1 X30 F20\nY40 F10\nG3 X20 Y30 I0 J-10 F5\nG94 F100 G1 X0\nM2"),
    ("drilling", f"{MM}\n{START}\nG98 G81 X10 Y10 Z-3 R1\nX20\nY20\nG80\nG0 Z9\nM2"),
    ("drilling back to R", f"{MM}\n{START}\nG99 G81 X10 Y10 Z-3 R1\nX20\nX30 Y0\nG80\nM2"),
    ("drilling from below R", f"{MM}\nG0 X0 Y0 Z0\nG98 G81 X10 Z-3 R2\nX20\nM2"),
    ("drilling deeper", f"{MM}\n{START}\nG98 G81 X10 Z-3 R1\nX20 Z-5\nX30 R3\nM2"),
    ("boring back to R", f"{MM}\n{START}\nG99 G85 X10 Z-3 R1\nG89 X20 Z-4 R1 P.1\nG82 X30 Z-2 R1 P.2\nM2"),
    ("drilling under G91 with repeats", f"{MM}\n{START}\nG91 G98 G81 X1 Y1 Z-2 R-1 L3\nG90 G80 G0 X0\nM2"),
    ("drilling under G91 with repeats, back to R", f"{MM}\n{START}\nG91 G99 G81 X1 Z-2 R-1 L3\nG80 G90 G0 X0\nM2"),
    ("drilling under G91, block after block", f"{MM}\n{START}\nG91 G99 G81 X1 Z-2 R-1\nX2\nY1 L2\nM2"),
    ("drilling with repeats", f"{MM}\n{START}\nG98 G81 X10 Z-3 R1 L2\nM2"),
    ("drilling in inches", f"{IN}\nG0 X0 Y0 Z1.\nG98 G81 X1. Y1. Z-.5 R.1\nX2.\nG80\nM2"),
    ("drilling in ZX", f"{MM}\nG0 X0 Y5 Z0\nG18 G98 G81 X10 Z10 Y-3 R1\nZ20\nG80\nM2"),
    ("drilling in YZ", f"{MM}\nG0 X5 Y0 Z0\nG19 G98 G81 Y10 Z10 X-3 R1\nZ20\nM2"),
    ("drilling under G52", f"{MM}\n{START}\nG52 X5 Z1\nG98 G81 X10 Z-3 R1\nX20\nM2"),
    ("deep drilling, pecks", f"{MM}\n{START}\nG98 G83 X10 Z-3 R1 Q1.5\nX20\nM2"),
    ("deep drilling to a rest, pecks", f"{MM}\n{START}\nG98 G83 X10 Z-3.7 R1 Q2\nM2"),
    ("a cycle after a cycle", f"{MM}\n{START}\nG98 G81 X10 Z-3 R1\nG85 X20 Z-2 R1\nG0 X0\nG81 X5 Z-1 R0\nM2"),
    ("G80 and a motion behind it", f"{MM}\n{START}\nG98 G81 X10 Z-3 R1\nG80\nG0 X20\nG1 Z0\nM2"),
    ("openings with modes", f"G17 G20 G40 G49 G80 G90 G94\n{START}\nG1 X1. F10.\nM2"),
    ("look-ahead and exact stops", f"{MM}\nG64 P0.01\n{START}\nG61 G1 X1\nG61.1 X2\nG64 X3\nM2"),
    ("spindle, coolant and tools", f"{MM}\nT1 M6\nG43 H1\nM3 S1000\nM8\n{START}\nG1 X5\nM9 M5\nM2"),
    ("a length offset with a place", f"{MM}\nT2 M6\n{START}\nG43 H2 Z3\nG1 Z0\nG49\nX5\nM2"),
    ("stops that go on", f"{MM}\n{START}\nG1 X5\nM1\nX6\nM2"),
    ("nothing behind the end", f"{MM}\n{START}\nG1 X5\nM2\nG1 X99"),
    ("a program called twice", f"{MM}\n{START}\nM98 P100 L2\nM2\nO100\nG91 G1 X1\nG90\nM99"),
    ("programs that call one another", f"{MM}\n{START}\nM98 P2\nG90 X0\nM2\nO2\nG91 G1 X1\nM98 P3\nX1\nM99\nO3\nY2\nM99"),
    ("subs", f"o100 sub\nG91 G1 X1\nG90\no100 endsub\n{MM}\n{START}\no100 call\no100 call\nG1 X0\nM2"),
    ("subs by name", f"o<row> sub\nG1 Y1\nX0\no<row> endsub\n{MM}\n{START}\nG1 X5\no<row> call\nG1 X7\nM2"),
    ("a sub that returns early", f"o1 sub\nG1 X1\no1 return\nG1 X9\no1 endsub\n{MM}\n{START}\no1 call\nG1 Y1\nM2"),
    ("numbers of many digits", f"{MM}\n{START}\nG1 X1.23456789 Y-0000.5\nX12.000000001\nM2"),
    ("feed in its own block", f"{MM}\n{START}\nF50\nG1 X5\nF60\nX6\nF70 X7\nM2"),
    ("rapids between feeds", f"{MM}\n{START}\nG1 Z0\nX5\nG0 Z5\nX10 Y10\nG1 Z-1 F50\nG0 Z5\nM2"),
    ("work offset named again", f"{MM} G54\n{START}\nG54 G1 X5\nG54\nX6\nM2"),
    # What rs274 refuses.
    ("refused: two units", f"G20 G21\n{START}\nM2"),
    ("refused: two planes", f"{MM}\n{START}\nG17 G18\nM2"),
    ("refused: two motions", f"{MM}\n{START}\nG0 G1 X5\nM2"),
    ("refused: an arc that misses", f"{MM}\n{START}\nG2 X10.1 I5\nM2"),
    ("refused: an arc that misses by 0.05 in", f"{IN}\n{START}\nG2 X20.2 I10.\nM2"),
    ("refused: a radius too small", f"{MM}\n{START}\nG2 X10 R4\nM2"),
    ("refused: a full circle by radius", f"{MM}\n{START}\nG2 X0 R4\nM2"),
    ("refused: an arc without centre", f"{MM}\n{START}\nG2 X5\nM2"),
    ("refused: feed of 0", f"G21 G90\n{START}\nG1 X5 F0\nM2"),
    ("refused: no feed", f"G21 G90\n{START}\nG1 X5\nM2"),
    ("refused: no feed under G93", f"{MM}\n{START}\nG93\nG1 X5\nM2"),
    ("refused: a word twice", f"{MM}\n{START}\nG1 X5 X6\nM2"),
    ("refused: a comment without end", f"{MM}\n{START}\nG1 X5 (a\nM2"),
    ("refused: a comment within a comment", f"{MM}\n{START}\nG1 X5 (a (b) c)\nM2"),
    ("refused: an exponent", f"{MM}\n{START}\nG1 X1.5E-5\nM2"),
    ("refused: a cycle above R", f"{MM}\n{START}\nG81 X1 Z3 R1\nM2"),
    ("refused: a cycle without R", f"{MM}\n{START}\nG81 X1 Z-3\nM2"),
    ("refused: no motion at the beginning", f"{MM}\nX5\nM2"),
    ("refused: repeats of nothing", f"{MM}\n{START}\nL3\nM2"),
    ("refused: a sub that is not there", f"{MM}\n{START}\no5 call\nM2"),
]


def drawn(seed: int) -> str:
    """A program of twenty blocks: lines, arcs by centre and radius, cycles, shifts, in any unit, plane and way of counting."""
    rng = random.Random(seed)
    is_inch = rng.random() < 0.4
    digits = 4 if is_inch else 3
    scale = 1 / INCH if is_inch else 1.0
    at = [0.0, 0.0, 5.0]
    lines = [f"{IN if is_inch else MM}", f"G0 X0 Y0 Z{5 * scale:.{digits}f}"]
    is_incremental = False

    def told(length: float) -> str:
        return f"{length * scale:.{digits}f}"

    def words(to: list[float], axes: str = "XYZ") -> str:
        """Words that lead from where the tool stands as the words so far have it, so that rounding does not add up."""
        out = []
        for i, axis in enumerate("XYZ"):
            if axis in axes:
                length = to[i] - at[i] if is_incremental else to[i]
                out.append(f"{axis}{told(length)}")
                rounded = float(told(length)) / scale
                at[i] = at[i] + rounded if is_incremental else rounded
        return " ".join(out)

    def place() -> list[float]:
        return [rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-5, 5)]

    for _ in range(20):
        kind = rng.choice(["line", "line", "rapid", "arc", "radius", "count", "feed", "drill"])
        if kind == "count":
            is_incremental = not is_incremental
            lines.append("G91" if is_incremental else "G90")
        elif kind == "feed":
            lines.append(f"F{rng.uniform(50, 900) * scale:.2f}")
        elif kind in ("line", "rapid"):
            axes = rng.choice(["XYZ", "XY", "X", "Y", "Z"])
            lines.append(f"{'G1' if kind == 'line' else 'G0'} {words(place(), axes)}")
        elif kind == "drill" and not is_incremental:
            x, y, _ = place()
            lines.append(f"{rng.choice(['G98', 'G99'])} G81 {words([x, y, 0], 'XY')} Z{told(-8)} R{told(6)}")
            lines.append("G80")
            lines.append(f"G0 Z{told(9)}")
            at[2] = float(told(9)) / scale
        elif kind == "arc":
            plane, (a, b) = rng.choice([("G17", (0, 1)), ("G18", (2, 0)), ("G19", (1, 2))])
            begin, radius = rng.uniform(0, 6.28), rng.uniform(2, 30)
            centre = [at[a] - radius * math.cos(begin), at[b] - radius * math.sin(begin)]
            end = begin + rng.uniform(0.3, 6)
            to = place()
            to[a], to[b] = centre[0] + radius * math.cos(end), centre[1] + radius * math.sin(end)
            offsets = [centre[0] - at[a], centre[1] - at[b]]
            letters = "IJK"
            axes = "XYZ" if rng.random() < 0.5 else "".join("XYZ"[i] for i in (a, b))
            ijk = f"{letters[a]}{told(offsets[0])} {letters[b]}{told(offsets[1])}"
            lines.append(f"{plane} {rng.choice(['G2', 'G3'])} {words(to, axes)} {ijk}")
            lines.append("G17")
        elif kind == "radius":
            to = place()
            half = math.hypot(to[0] - at[0], to[1] - at[1]) / 2
            radius = half * rng.uniform(1.05, 3) * rng.choice([1, -1])
            lines.append(f"{rng.choice(['G2', 'G3'])} {words(to, 'XY')} R{told(radius)}")
    return "\n".join([*lines, "M2"])


@dataclass
class Machine:
    """What the interpreter leaves in force, mm."""

    unit: float = 1.0
    plane: str = "XY"
    feed: float = 0.0
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    at: tuple[float, float, float] | None = None


CALL = re.compile(r"^\s*\d+\s+N\S+\s+(\w+)\((.*)\)\s*$")
PLANES = {"XY": (0, 1, 2), "XZ": (2, 0, 1), "YZ": (1, 2, 0)}


def moves(output: str) -> Iterator[str]:
    """The canonical calls of the interpreter as moves in mm."""
    machine = Machine()
    for line in output.splitlines():
        found = CALL.match(line)
        if not found:
            continue
        name, rest = found.groups()
        numbers = [float(part) for part in rest.split(",") if re.fullmatch(r"\s*-?\d+(\.\d+)?\s*", part)]
        if name == "USE_LENGTH_UNITS":
            machine.unit = {"CANON_UNITS_MM": 1.0, "CANON_UNITS_INCHES": INCH}[rest]
        elif name == "SELECT_PLANE":
            machine.plane = rest.removeprefix("CANON_PLANE_")
        elif name == "SET_FEED_RATE":
            machine.feed = numbers[0] * machine.unit
        elif name == "SET_G92_OFFSET":
            machine.shift = tuple(x * machine.unit for x in numbers[:3])
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            to = placed(numbers[:3], machine)
            is_rapid = name == "STRAIGHT_TRAVERSE"
            if to != machine.at:
                yield f"{'rapid' if is_rapid else 'feed'} {shown(to)}" + ("" if is_rapid else f" {machine.feed:.4f}")
            machine.at = to
        elif name == "ARC_FEED":
            a, b, n = PLANES[machine.plane]
            first, second, centre_a, centre_b, turns, along = numbers[:6]
            ends, centre = [0.0] * 3, [0.0] * 3
            ends[a], ends[b], ends[n] = first, second, along
            centre[a], centre[b] = centre_a, centre_b
            to, middle = placed(ends, machine), placed(centre, machine)
            yield f"arc {shown(to)} {machine.feed:.4f} {'XYZ'[a]}{'XYZ'[b]} {middle[a]:.4f} {middle[b]:.4f} {turns:.0f}"
            machine.at = to


def placed(numbers: list[float], machine: Machine) -> tuple[float, float, float]:
    x, y, z = (number * machine.unit + shift for number, shift in zip(numbers, machine.shift, strict=True))
    return (round(x, 6), round(y, 6), round(z, 6))


def shown(place: tuple[float, float, float]) -> str:
    return " ".join(f"{x + 0.0:.4f}" for x in place)


def recorded(program: str, folder: pathlib.Path, is_refused: bool) -> list[str]:
    """What the interpreter makes of a program."""
    (folder / "case.ngc").write_text(program + "\n")
    (folder / "case.tbl").write_text("".join(f"T{i} P{i} D6.0 Z0.0\n" for i in range(1, 10)))
    for _ in range(TRIES):
        (folder / "case.var").write_text("")
        command = [folder / "usr/bin/rs274", "-t", folder / "case.tbl", "-v", folder / "case.var", "-g", folder / "case.ngc"]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=20, stdin=subprocess.DEVNULL)
        if "USE_LENGTH_UNITS" not in done.stdout:
            continue
        is_done = done.returncode == 0 and ("PROGRAM_END" in done.stdout or program.endswith("%"))
        if is_done != is_refused:
            return ["refused"] if is_refused else list(moves(done.stdout))
        raise SystemExit(f"{'read' if is_done else 'refused'}:\n{program}\n{done.stdout[-600:]}{done.stderr[-600:]}")
    raise SystemExit(f"no answer:\n{program}")


def version(folder: pathlib.Path) -> str:
    package = next(folder.glob("linuxcnc-uspace_*.deb"))
    done = subprocess.run(["dpkg", "-f", str(package), "Version"], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    cases = [*WRITTEN, *((f"drawn {seed}", drawn(seed)) for seed in range(60))]
    text = [
        f"# recorded by scripts/rs274: rs274, the stand-alone interpreter of LinuxCNC (linuxcnc-uspace {version(folder)}).",
        "# mm, mm/min: rapid x y z; feed x y z f; arc x y z f plane, centre along its two axes, turns begun (negative: clockwise).",
    ]
    for name, program in cases:
        told = recorded(program, folder, name.startswith("refused"))
        text += [f"== {name}", program, "--", *told]
    TARGET.write_text("\n".join(text) + "\n")
    print(f"{len(cases)} programs in {TARGET.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
