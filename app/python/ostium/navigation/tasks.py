"""The tasks: vessel, instruments, where to, what counts. One entry of TASKS each.

Numbers of tasks that others published are theirs, so that results can be laid side by side; the vessels are ours.
"""

from dataclasses import dataclass, field
from typing import Callable, Mapping, Optional, Sequence, Tuple

import numpy as np

# The brachiocephalic trunk is the first part of the right subclavian artery here.
ARCH = ("right subclavian", "right carotid", "left carotid", "left subclavian")


VACUUM_PA = 0.8e5  # drawn on a balloon to empty it


@dataclass(frozen=True)
class Moment:
    """What a reward is computed from, after one step of the environment."""

    left_m: float  # way along the tree from the tip to the target
    came_m: float  # by how much that has become less in this step; negative: more
    distance_m: float  # straight from the tip to the target
    reached: bool
    peak_wall_N: float  # largest sum of the walls' forces on a tool within the step


def steve(m: Moment) -> float:
    """Karstensen et al. 2025, stEVE, BasicWireNav: +1 on arrival, -0.005 a step, 0.001 a millimetre of way."""
    return float(m.reached) - 0.005 + 0.001 * 1e3 * m.came_m


def treated(signals) -> bool:
    """Angiographic success: less than 20 % of the diameter is missing anywhere in the lesions, stents cover them, and the
    balloon is empty. (20 % under a stent: Levine et al. 2011, guideline for PCI, 5.1.)"""
    return (signals["stenosis_worst_percent"] < 20 and signals["stent_margin_least_mm"] >= 0
            and signals["balloon_atm"] < 0.1)


def cathsim(m: Moment) -> float:
    """Jianu et al. 2024, CathSim: minus the distance in metres, +10 within 4 mm."""
    return 10.0 if m.reached else -m.distance_m


@dataclass(frozen=True)
class Task:
    """What an environment plays. SI units."""

    tools: Sequence[Tuple[str, str]]  # (name, instrument), outermost first
    title: str
    case: str = "rca-mid-focal"
    # Drawn by the seed of a reset; None: the case's own, the only one of an imported mesh.
    persons: Sequence[Optional[int]] = (0,)
    begin: Optional[str] = None  # artery before whose ostium it begins; None: at the access
    targets: Sequence[str] = ARCH  # branches, or places ("RCA+40"): drawn by the seed of a reset
    beyond_m: Tuple[float, float] = (0.005, 0.04)  # of a branch: how far into it a target may lie
    leader: Optional[str] = None  # the tool that has to arrive; None: the innermost
    lead_m: float = 0.0  # which point of it, from its tip: a balloon's middle
    moves: Optional[Sequence[str]] = None  # the tools that actions move, in this order; None: all
    # Done before an episode begins: (tool, feed m/s, turn rad/s, seconds), one after the other. Then the seed decides
    # for how much of a beat all is left alone; without preparation, how the tools are rolled as they come in.
    prepared: Sequence[Tuple[str, float, float, float]] = ()
    reach_m: float = 5e-3  # the target is reached within
    max_feed_m_s: float = 0.035
    max_turn_rad_s: float = 3.14
    step_s: float = 0.132
    max_gauge_Pa: float = 0.0  # of the inflation device, one more action where it is above 0
    goal: Optional[Callable[[Mapping[str, float]], bool]] = None  # of signals by name: success instead of the reach
    steps: int = 1000  # then an episode is truncated
    reward: Callable[[Moment], float] = steve
    safe_wall_N: float = 2.0  # a step is safe up to this force (CathSim's threshold)

    def __post_init__(self):
        for name in ("tools", "persons", "targets", "moves", "prepared", "along", "beyond_m"):
            of = getattr(self, name)
            if of is not None:  # hashable, whatever sequences were given
                of = tuple(tuple(one) if isinstance(one, list) else one for one in of)
                object.__setattr__(self, name, of)
        if not self.max_gauge_Pa >= 0:
            raise ValueError(f"max_gauge_Pa is {self.max_gauge_Pa}; expected 0 or more")
        for name in ("tools", "persons", "targets", "along"):
            if not getattr(self, name):
                raise ValueError(f"{name} is empty; expected one at least")
        for name in ("reach_m", "max_feed_m_s", "max_turn_rad_s", "step_s", "steps"):
            if not getattr(self, name) > 0:
                raise ValueError(f"{name} is {getattr(self, name)}; expected more than 0")
        known = [name for name, _ in self.tools]
        for name in (*(self.moves or ()), *([self.leader] if self.leader else [])):
            if name not in known:
                raise ValueError(f'there is no tool "{name}"; expected one of {", ".join(known)}')

    @property
    def moved(self):
        """(name, instrument) of the tools that actions move."""
        return [tool for name in self.moves or [n for n, _ in self.tools] for tool in self.tools if tool[0] == name]

    @property
    def limits(self):
        """(least, most) of each action: m/s and rad/s for each tool that moves, and Pa."""
        most = [self.max_feed_m_s, self.max_turn_rad_s] * len(self.moved)
        least = [-x for x in most]
        if self.max_gauge_Pa > 0:
            least, most = [*least, -VACUUM_PA], [*most, self.max_gauge_Pa]
        return np.array(least), np.array(most)

    def as_unit(self, drives):
        """Inputs as actions from -1 to 1."""
        least, most = self.limits
        return np.where(drives < 0, -drives / least, drives / most).astype(np.float32)

    along: Sequence[float] = field(default=(0.0, 0.02, 0.04))  # m from the tip: the points that are observed


WIRE = (("wire", "j-wire-035-150"),)
GUIDE_AND_WIRE = (("guide", "guide-jr4-6f"), ("wire", "j-wire-035-150"))
CORONARY_WIRE = (("wire", "wire-014-workhorse"),)
ENGAGED = (("guide", 0.01, 0.0, 2.3), ("wire", 0.02, 0.0, 1.0))  # from before the ostium into it, and a wire up to its tip
CROSSED = (*ENGAGED, ("wire", 0.025, 1.6, 4.5))  # then through the lesion
ACROSS = (*CROSSED, ("balloon", 0.02, 0.0, 1.5))  # and a balloon after it

TASKS = {
    "BasicWireNav": Task(WIRE, "a J wire from the groin into a branch of the arch; stEVE's numbers"),
    "ArchVariety": Task(WIRE, "the same in eight persons", persons=tuple(range(1, 9))),
    "DualDeviceNav": Task(GUIDE_AND_WIRE, "guide and wire from the groin into a branch of the arch"),
    "ArchTarget": Task(WIRE, "a J wire to the brachiocephalic or left carotid artery; CathSim's reward",
                       targets=("right subclavian+10", "left carotid+10"), reach_m=4e-3,
                       steps=300, reward=cathsim),
    "Engage": Task(GUIDE_AND_WIRE, "the guide's tip to the ostium of the right coronary artery", leader="guide",
                   targets=("RCA+0",), reach_m=4e-3, max_feed_m_s=0.1),
    "EngageLM": Task((("guide", "guide-jl4-6f"), ("wire", "j-wire-035-150")), case="lad-proximal-eccentric",
                     title="the guide's tip to the ostium of the left main", leader="guide", targets=("LM+0",),
                     reach_m=4e-3, max_feed_m_s=0.1),
    "CrossLesion": Task((("guide", "guide-jr4-6f"), *CORONARY_WIRE), "a coronary wire from a guide in the ostium across the lesion",
                        begin="RCA", prepared=ENGAGED, moves=("wire",), targets=("RCA+70",), max_feed_m_s=0.02,
                        steps=300),
    "PlaceBalloon": Task((("guide", "guide-jr4-6f"), ("balloon", "balloon-275x12"), *CORONARY_WIRE),
                         "a balloon's middle into the lesion, over a wire that lies across it", begin="RCA",
                         prepared=ACROSS, moves=("balloon", "wire"), leader="balloon", lead_m=0.011,
                         targets=("RCA+45",), reach_m=2e-3, max_feed_m_s=0.02, steps=300),
    "PCI": Task((("guide", "guide-jr4-6f"), ("stent", "stent-35x18"), *CORONARY_WIRE),
                "a stent into the lesion over a wire that lies across it, opened, its balloon emptied", begin="RCA",
                prepared=(*CROSSED, ("stent", 0.02, 0.0, 1.5)), moves=("stent", "wire"), leader="stent", lead_m=0.013,
                targets=("RCA+46.5",), max_feed_m_s=0.02, max_gauge_Pa=14 * 101325.0, goal=treated, steps=600),
}


def target_places(task: Task, vessel) -> list:
    """Every sphere number a target may be drawn from, in order."""
    found = []
    for name in task.targets:
        if "+" in name:
            found.append([vessel.sphere(name)])
            continue
        first = vessel.sphere(f"{name}+{1e3 * task.beyond_m[0]:g}")
        try:
            last = vessel.sphere(f"{name}+{1e3 * task.beyond_m[1]:g}")
        except ValueError:  # a short branch
            last = None
        branch = vessel.branch_of(first)
        inside = [s for s in range(first, first + 1000) if _in_branch(vessel, s, branch)]
        far = vessel.between(first, last) if last is not None else np.inf
        found.append([s for s in inside if vessel.between(first, s) <= far + 1e-9])
    return found


def _in_branch(vessel, sphere, branch):
    try:
        return vessel.branch_of(sphere) == branch
    except IndexError:
        return False
