"""Which robot is stiff enough for machining, where must the work stand, and how far is the tool pushed off there?

A robot and a task go in; each verb is one function:

============== ==========================================================
`compliance`   how compliant is an arm at one posture, or at a million?
`map`          how far is the tool pushed off, everywhere the arm reaches?
`place`        where must a zone stand, and who proves it?
`rank`         which robot holds the force best?
`study`        which architecture suits which link ratio and size?
`compare`      which of two setups is better, and is that proved?
`identify`     how stiff are the drives, by measured deflections?
`measure`      which postures and loads must be measured for that?
`calibrate`    how does this very arm differ from its drawing?
`verify`       does a robot file count the joints as the pendant does?
`modes`        how does an arm swing at one posture, or over a zone?
`chatter`      does a cut swing with the arm, and how deep may it go?
`force`        with what force does a process push on its tool?
`mill`         how far is the tool pushed off along a toolpath?
`validate`     is what the paper printed reproduced?
============== ==========================================================

Units stand in the names: ``force_n``, ``tool_mm``, ``deflection_mm``. The numbers are those of the program `stiffarm`, to
the last bit. What is not reached is ``nan`` in arrays and None elsewhere. Whatever is refused raises `StiffarmError`.

`stiffarm.plot` draws the answers; `stiffarm.cluster` asks many machines how sure a ranking is.

Long calls run without the interpreter's lock on all cores (`set_threads`); Ctrl-C ends them within a second, and
``progress=True`` says how far they are.
"""

from ._answers import (
    Answer,
    Calibration,
    CalibrationPlan,
    Chatter,
    Comparison,
    Compliance,
    Compliances,
    FittingRobots,
    Force,
    Identification,
    Ledger,
    Map,
    MeasurementPlan,
    Milled,
    Modes,
    ModesOverZone,
    PathRanking,
    Placement,
    Ranking,
    Study,
    Toolpath,
    Verification,
)
from ._stiffarm import Robot, StiffarmError, __version__, set_threads
from ._verbs import (
    calibrate,
    cell,
    chatter,
    compare,
    compliance,
    force,
    identify,
    map,
    measure,
    mill,
    modes,
    paper,
    place,
    rank,
    robots,
    study,
    validate,
    verify,
)

__all__ = [
    "Answer",
    "Calibration",
    "CalibrationPlan",
    "Chatter",
    "Comparison",
    "Compliance",
    "Compliances",
    "FittingRobots",
    "Force",
    "Identification",
    "Ledger",
    "Map",
    "MeasurementPlan",
    "Milled",
    "Modes",
    "ModesOverZone",
    "PathRanking",
    "Placement",
    "Ranking",
    "Robot",
    "StiffarmError",
    "Study",
    "Toolpath",
    "Verification",
    "__version__",
    "calibrate",
    "cell",
    "chatter",
    "compare",
    "compliance",
    "force",
    "identify",
    "map",
    "measure",
    "mill",
    "modes",
    "paper",
    "place",
    "rank",
    "robots",
    "set_threads",
    "study",
    "validate",
    "verify",
]
