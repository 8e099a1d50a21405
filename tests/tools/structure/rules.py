"""The rules of the house, each a function from sources to findings."""
import os
from collections import defaultdict
from dataclasses import dataclass
from fnmatch import fnmatchcase

LONGEST = 400  # lines of a file that is no table


@dataclass
class Finding:
    path: str
    line: int
    what: str
    cure: str

    def __str__(self):
        return f"{self.path}:{self.line}: {self.what}\n  cure: {self.cure}"


def read_layers(path):
    """{folder: {name in it: level}}; the files that may be long; the names that may lie at the top."""
    layers, section = {}, None
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.split("#")[0].strip()
            if line.startswith("["):
                section = layers.setdefault(line.strip("[]"), {})
            elif line:
                level = 1 + max(section.values(), default=-1)
                section.update({name: level for name in line.split()})
    tables, top = set(layers.pop("tables", {})), set(layers.pop("top", {}))
    return layers, tables, top | set(layers["."])


def edges(sources):
    """(source, line, included path) of all includes of one another that leave their folder."""
    known = {source.path for source in sources}
    for source in sources:
        for line, path in source.includes:
            if path in known and os.path.dirname(path) != source.folder:
                yield source, line, path


def part_in(section, folder):
    """The part of a section that a folder belongs to: a folder's name, or "." for the section's own files."""
    below = folder if section == "." else folder[len(section) + 1 :]
    return below.split("/")[0] or "."


def common_section(a, b):
    """The lowest folder that holds both."""
    shared = []
    for x, y in zip(a.split("/"), b.split("/")):
        if x != y:
            break
        shared.append(x)
    return "/".join(shared) or "."


def unlisted(sources, layers):
    """Folders that have no place in the order."""
    seen = set()
    for source in sources:
        parts = source.folder.split("/")
        for depth in range(len(parts) + 1):
            section = "/".join(parts[:depth]) or "."
            part = part_in(section, source.folder) if section != source.folder else "."
            if section in layers and part not in layers[section] and (section, part) not in seen:
                seen.add((section, part))
                name = f"{section}/{part}" if part != "." else f"the files of {section} itself"
                yield Finding(source.path, 1, f"{name} has no place in the order of layers",
                              f"move it to a folder that has one, or add it to [{section}] of layers.txt")


def standing(folder, to, layers):
    """The folder that an include is judged as coming from: of a library's tests, the library."""
    parts = folder.split("/")
    is_test_of_library = parts[0] == "tests" and len(parts) > 1 and parts[1] in layers.get(".", {})
    return parts[1] if is_test_of_library and to.split("/")[0] != "tests" else folder


def arrows(sources, layers):
    """Includes that go up or sideways."""
    for source, line, path in edges(sources):
        to = os.path.dirname(path)
        folder = standing(source.folder, to, layers)
        section = common_section(folder, to)
        order = layers.get(section, {})
        x, y = (part_in(section, f) if f != section else "." for f in (folder, to))
        if x != y and x in order and y in order and order[x] <= order[y]:
            way = "up" if order[x] < order[y] else "sideways"
            where = "" if section == "." else f" of {section}"
            yield Finding(source.path, line, f'"{path}" goes {way}: {x} may not include {y}{where}',
                          f"put what {x} needs of it into a header of {x} or below, or pass it in from above")


def shortest_ring(graph, start, inside):
    """The folders of a shortest ring through `start` that stays inside a set."""
    before, todo = {start: None}, [start]
    for folder in todo:
        for to in sorted(graph[folder]):
            if to == start:
                ring = [folder]
                while before[ring[-1]] is not None:
                    ring.append(before[ring[-1]])
                return ring[::-1]
            if to in inside and to not in before:
                before[to] = folder
                todo.append(to)
    return []


def rings(sources):
    """Folders that include each other, directly or over others; each ring once, by its shortest round."""
    graph, reason = defaultdict(dict), {}
    for source, line, path in edges(sources):
        to = os.path.dirname(path)
        graph[source.folder].setdefault(to, None)
        reason.setdefault((source.folder, to), (source.path, line, path))

    def reached(start):
        seen, todo = set(), [start]
        while todo:
            for to in graph.get(todo.pop(), {}):
                if to not in seen:
                    seen.add(to)
                    todo.append(to)
        return seen

    reach = {folder: reached(folder) for folder in list(graph)}
    done = set()
    for folder in sorted(graph):
        if folder in done or folder not in reach[folder]:
            continue
        together = {other for other in reach[folder] if folder in reach.get(other, ())}
        done |= together
        ring = shortest_ring(graph, folder, together)
        steps = [reason[a, b] for a, b in zip(ring, ring[1:] + ring[:1])]
        told = "; ".join(f'{path}:{line} includes "{included}"' for path, line, included in steps)
        what = f"folders in a ring: {', '.join(sorted(together))}. One round of it: {told}"
        yield Finding(steps[0][0], steps[0][1], what, "cut one of these includes: move what it needs below both folders")


def long_files(sources, tables):
    long = {source.path for source in sources if source.lines > LONGEST}
    for source in sources:
        if source.path in long - tables:
            yield Finding(source.path, source.lines, f"{source.lines} lines, more than {LONGEST}",
                          "divide it into what it consists of; a mere table goes on the list [tables] of layers.txt")


def lost_files(sources):
    """Comments that send their reader to a file that is not there."""
    for source in sources:
        for line, path in source.lost:
            yield Finding(source.path, line, f"the comment names {path}, which is not there", "name where it is today")


def twins(sources):
    """Types of one name in one namespace: in one program that is undefined behaviour (one definition rule)."""
    defined = defaultdict(dict)
    for source in sources:
        for kind in source.types:
            if not kind.anonymous or source.is_header:
                defined[kind.name].setdefault(source.path, kind.line)
    for name, places in sorted(defined.items()):
        if len(places) > 1:
            (path, line), *others = sorted(places.items())
            also = ", ".join(f"{other}:{at}" for other, at in others)
            yield Finding(path, line, f"{name} is defined here and in {also}",
                          "give one another name or namespace; what one source alone uses goes into its own "
                          "namespace without a name")


def strays(names, ignored, top):
    """Of the names at the top of the checkout, those that do not belong there."""
    made = [pattern.strip("/") for pattern in ignored]
    for name in sorted(names):
        if name not in top and name[0] != "." and not any(fnmatchcase(name, pattern) for pattern in made):
            yield Finding(name, 1, "has strayed to the top of the checkout",
                          "move it where it belongs, or add it to [top] of layers.txt; what a program makes is named "
                          "in .gitignore")


def all_findings(sources, layers, tables):
    return [*rings(sources), *unlisted(sources, layers), *arrows(sources, layers),
            *long_files(sources, tables), *lost_files(sources), *twins(sources)]
