"""What goes wrong with what people bring: files, names."""

import re


class OstiumError(Exception):
    """A file or a name that cannot be used, or a file that cannot be written. `file` and `line` say where, as far as it is known; else None."""

    def __init__(self, message=""):
        super().__init__(message)
        found = re.match(r"(?P<file>[^\n:]+\.\w+):(?:(?P<line>\d+):)? ", str(message))
        self.file = found["file"] if found else None
        self.line = int(found["line"]) if found and found["line"] else None
