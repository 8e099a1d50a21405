"""What is run in both builds, and how its results are read."""
import csv
import io
import json
import os
import subprocess
from dataclasses import dataclass, field

from made_up_sets import write_sets

CHECKOUT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))


@dataclass
class Program:
    name: str
    arguments: list  # "OUT" stands for a folder of its own
    files: list = field(default_factory=list)  # of that folder, read beside what is printed
    printed: bool = True  # JSON on the standard output


def measured_sets():
    """Beside the checkout; none where they are not."""
    folder = os.environ.get("OSTIUM_MEASURED", os.path.join(os.path.dirname(CHECKOUT), "shared", "measured"))
    names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
    return [os.path.join(folder, n) for n in names if os.path.isfile(os.path.join(folder, n, "measurement.json"))][:3]


def programs(folder, quick):
    """In the order in which they run; made-up sets are written below `folder`."""
    made_up = write_sets(os.path.join(folder, "sets"))
    procedure = ["run", "rca-mid-focal", "--script", "pci-rca-mid-focal", "--json", "--out", "OUT"]
    out = [Program("default run", procedure + (["--seconds", "20"] if quick else []), ["metrics.json"]),
           Program("verify", ["verify", "--json"] + (["--quick"] if quick else []))]
    for path in made_up[:1] if quick else made_up + measured_sets():
        out.append(Program(f"explain {os.path.basename(path)}", ["explain", path, "--json", "-o", "OUT"]))
    if not quick:
        for case, script in (("rca-mid-focal", "aorta-arch-wire"), ("lcx-tubular", "iliac-wire")):
            out.append(Program(f"sweep {case} {script}", ["sweep", case, "--script", script, "--seeds", "1..3",
                                                          "--seconds", "8", "-o", "OUT/table.csv"], ["table.csv"], False))
    return out


def parsed(text, name=""):
    """JSON with its numbers as they are written, a table as its rows, anything else as its lines."""
    if name.endswith(".csv"):
        return list(csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#")))
    try:
        return json.loads(text, parse_float=str, parse_int=str)
    except json.JSONDecodeError:
        return text.splitlines()


def results(program, build, folder):
    """{"exit", "printed", "said", and each file}: what one build makes of it."""
    os.makedirs(folder, exist_ok=True)
    arguments = [a.replace("OUT", folder) if a.startswith("OUT") else a for a in program.arguments]
    done = subprocess.run([os.path.join(build, "ostium"), *arguments], capture_output=True, text=True, check=False)
    out = {"exit": done.returncode}
    if program.printed:
        out["printed"] = parsed(done.stdout.replace(folder, "OUT"))
    if done.returncode not in (0, 1):
        out["said"] = done.stderr.replace(folder, "OUT").splitlines()
    for name in program.files:
        path = os.path.join(folder, name)
        if os.path.isfile(path):
            with open(path, encoding="utf-8") as file:
                out[name] = parsed(file.read(), name)
            os.remove(path)  # or the next program would be taken to have written it
    return out
