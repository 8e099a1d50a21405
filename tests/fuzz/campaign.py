#!/usr/bin/env python3
"""Fuzzes targets of ostium-fuzz one after another, and starts it again behind each mutant that ended it.

campaign.py PROGRAM [--seed N] [--seconds S | --minutes M] [TARGET ...]

--seconds is for each target, --minutes for all together; the loop then goes on from target to target until the time is
up, and each had its turn. Exit code 1 where something was found, or where less than a fifth of a mesh's mutants are
read: the fuzzer then only tries headers.
"""
import argparse
import os
import select
import signal
import subprocess
import sys
import time

PIECE = 2000  # mutants between two looks at the clock
SLOWEST = 20  # seconds of processor for one of them; ostium-reader's limit
LEAST_READ = 0.2
LEAST_TRIED = 20  # of a target, however little time there is


class Count:
    def __init__(self):
        self.next, self.taken, self.refused, self.died, self.slow, self.findings = 0, 0, 0, 0, 0, []
        self.contained = []  # indices of those that died or were slow

    def tried(self):
        return self.taken + self.refused + self.died + self.slow + len(self.findings)


def processor_seconds(process):
    """What it has used; a busy machine lets it wait."""
    try:
        with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
    except OSError:
        return 0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def lines_of(process, time_is_up):
    """Lines until the program ends or the time is up; None where a mutant takes too long."""
    left, used = b"", 0
    while True:
        ready, _, _ = select.select([process.stdout], [], [], SLOWEST)
        if not ready:
            if processor_seconds(process) - used >= SLOWEST:
                yield None
                return
            if time_is_up():
                return
            continue
        used = processor_seconds(process)
        block = os.read(process.stdout.fileno(), 65536)
        if not block:
            return
        *whole, left = (left + block).split(b"\n")
        yield from (line.decode(errors="replace") for line in whole)
        if time_is_up():
            return


def run_piece(program, target, apart, seed, time_is_up, count):
    """One start of the program: to the end of a piece, of the time, or of the program."""
    first = count.next
    command = [program, target, str(seed), str(first), str(first + PIECE)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    index, answered, slow = first, True, False
    for line in lines_of(process, time_is_up):
        if line is None:
            slow = True
        elif line.isdigit():
            index, answered = int(line), False
        else:
            answered = True
            count.taken += line == "t"
            count.refused += line == "r"
            if line.startswith("!"):
                count.findings.append((index, line[2:]))
    stopped = process.poll() is None and (slow or time_is_up())
    if stopped:
        process.kill()
    code = process.wait()
    count.next = index + 1
    if slow:
        if apart:
            count.slow += 1
            count.contained.append(index)
        else:
            count.findings.append((index, f"takes longer than {SLOWEST} s"))
    elif not stopped and code != 0:
        name = signal.Signals(-code).name if code < 0 else f"code {code}"
        if apart and not answered:
            count.died += 1
            count.contained.append(index)
        else:
            count.findings.append((index, f"ended by {name}"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("targets", nargs="*")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--minutes", type=float)
    options = parser.parse_intermixed_args()
    listed = subprocess.run([options.program, "--list"], check=True, capture_output=True, text=True).stdout
    known = {line.split()[0]: line.endswith(" apart") for line in listed.splitlines()}
    targets = options.targets or list(known)
    unknown = [t for t in targets if t not in known]
    if unknown:
        parser.error(f"there is no target {unknown[0]}; there are {', '.join(known)}")
    counts = {target: Count() for target in targets}
    end = time.monotonic() + 60 * (options.minutes or 0)
    each = 10 if options.minutes else options.seconds
    while True:
        for target in targets:
            count, until = counts[target], time.monotonic() + each

            def time_is_up(count=count, until=until):
                return time.monotonic() > until and count.tried() >= LEAST_TRIED

            while not time_is_up():
                run_piece(options.program, target, known[target], options.seed, time_is_up, count)
        if time.monotonic() >= end:
            break
    return report(counts, options.seed)


def report(counts, seed):
    print(f"seed {seed}\n{'target':<14}{'mutants':>9}{'read':>7}{'refused':>9}{'died':>6}{'slow':>6}{'found':>7}")
    bad = False
    for target, c in counts.items():
        share = c.taken / max(1, c.tried())
        print(f"{target:<14}{c.tried():>9}{share:>7.0%}{c.refused:>9}{c.died:>6}{c.slow:>6}{len(c.findings):>7}")
        if c.tried() == 0 or (target.startswith("mesh") and c.tried() > 100 and share < LEAST_READ):
            print(f"{target}: too few mutants were read")
            bad = True
    for target, c in counts.items():
        if c.contained:
            print(f"{target}: its reader's end, at index {', '.join(map(str, c.contained[:10]))}")
        for index, what in c.findings[:10]:
            print(f"{target}: seed {seed}, index {index}: {what}")
        bad = bad or bool(c.findings)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
