"""What the verbs answer."""

from .base import Answer
from .chatter import Chatter
from .map import Map
from .measuring import Calibration, CalibrationPlan, FittingRobots, Identification, MeasurementPlan, Verification
from .milling import Force, Ledger, Milled, PathRanking, Toolpath
from .modes import Modes, ModesOverZone
from .placing import Comparison, Placement, Ranking, Study
from .posture import Compliance, Compliances

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
    "Study",
    "Toolpath",
    "Verification",
]
