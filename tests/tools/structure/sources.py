"""What the check knows of a C++ source: its includes, its length and the types it defines."""
import os
import re
from dataclasses import dataclass, field

LIBRARIES = ("core", "vascular", "fluoro", "device", "data", "app", "tests")
SUFFIXES = (".h", ".hpp", ".cpp", ".c")

NAMED = re.compile(r"(?<![\w./])(?:core|vascular|fluoro|device|data|app|tests)/[\w/-]+\.(?:h|cpp|c|py|sh|md|def|txt)\b")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
# Comments and literals: they may hold braces and words that are no code.
NO_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Za-z_])\'(?:\\.|[^\'\\\n])+\'', re.S)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", re.M)
# What stands between one brace or semicolon and the brace after it.
NAMESPACE = re.compile(r"^(?:inline\s+)?namespace\b\s*([\w:]*)$")
TYPE = re.compile(
    r"(?:^|\s)(?:struct|class|union|enum(?:\s+(?:class|struct))?)\s+(?:alignas\s*\([^)]*\)\s*|\[\[.*?\]\]\s*)*"
    r"(\w+)(?:\s+final)?\s*(?::[^:].*)?$", re.S)


@dataclass
class Type:
    name: str  # with its namespaces, but for those without a name
    line: int
    anonymous: bool  # in a namespace without a name


@dataclass
class Source:
    path: str
    lines: int = 0
    includes: list = field(default_factory=list)  # (line, path)
    lost: list = field(default_factory=list)  # (line, path) of files that a comment names and that are not there
    types: list = field(default_factory=list)

    @property
    def folder(self):
        return os.path.dirname(self.path)

    @property
    def is_header(self):
        return self.path.endswith((".h", ".hpp"))


def blank(text, pattern):
    """The text with all matches blanked out, line ends kept."""
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def defined_types(text):
    """Types of namespace scope and those nested in them; not those of functions."""
    code = blank(blank(text, NO_CODE), DIRECTIVE)
    types, scopes, begin = [], [], 0  # of scopes: (kind, name)
    for match in re.finditer(r"[{};]", code):
        head, at = code[begin:match.start()].strip(), match.start()
        begin = match.end()
        if match.group() == "}":
            if scopes:
                scopes.pop()
        elif match.group() == "{":
            scope = ("block", "")
            if namespace := NAMESPACE.match(head):
                scope = ("namespace", namespace.group(1))
            elif (found := TYPE.search(head)) and not re.search(r"[()=]\s*$", head[: found.start()]):
                scope = ("type", found.group(1))
                if all(kind != "block" for kind, _ in scopes):
                    names = [name for _, name in scopes if name] + [scope[1]]
                    types.append(Type("::".join(names), code.count("\n", 0, at) + 1, ("namespace", "") in scopes))
            scopes.append(scope)
    return types


def read(root):
    """All sources below the libraries' folders, in order of their paths."""
    sources = []
    for library in LIBRARIES:
        for folder, _, names in os.walk(os.path.join(root, library)):
            for name in names:
                if name.endswith(SUFFIXES):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8", errors="replace") as file:
                        text = file.read()
                    source = Source(os.path.relpath(path, root), len(text.splitlines()))
                    for number, line in enumerate(text.splitlines(), 1):
                        if match := INCLUDE.match(line):
                            source.includes.append((number, match.group(1)))
                        comment = line.partition("//")[2]
                        source.lost += [(number, named) for named in NAMED.findall(comment)
                                        if not os.path.exists(os.path.join(root, named))]
                    source.types = defined_types(text)
                    sources.append(source)
    return sorted(sources, key=lambda source: source.path)
