"""What differs between two results: trees of objects, lists, numbers and texts, as JSON has them."""
from dataclasses import dataclass

# What a machine took, not what was computed.
TIMES = {"step_ms", "overruns", "behind_most_ms", "wall_s", "took_s", "seconds_taken", "cpu_s", "clock_s", "version", "file"}
HASHES = {"hash", "state", "state_hash"}


@dataclass
class Difference:
    place: str  # such as "gates[3].value"
    old: object
    new: object
    is_hash: bool = False

    def __str__(self):
        return f"{'state hash ' if self.is_hash else ''}{self.place}: {self.old} -> {self.new}"


MISSING = "(missing)"


def differences(old, new, place=""):
    """All of them, in order. Numbers are texts here (programs.py reads them so), so that each digit counts."""
    if isinstance(old, dict) and isinstance(new, dict):
        found = []
        for key in [*old, *(key for key in new if key not in old)]:
            if key not in TIMES:
                found += differences(old.get(key, MISSING), new.get(key, MISSING), f"{place}.{key}" if place else key)
        return found
    if isinstance(old, list) and isinstance(new, list):
        found = []
        for n in range(max(len(old), len(new))):
            a, b = (items[n] if n < len(items) else MISSING for items in (old, new))
            found += differences(a, b, f"{place}[{n}]")
        return found
    if type(old) is type(new) and old == new:
        return []
    key = place.rsplit(".", 1)[-1].split("[")[0]
    return [Difference(place, old, new, key in HASHES and MISSING not in (old, new))]
