"""Recordings of `ostium run` as tables."""

from __future__ import annotations

from os import PathLike
from typing import Any, Iterable, Iterator, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._ostium import RecordingFile


class Table:
    """Columns with names, as pandas has them: table["wire.tip_x_mm"] is one of them, (rows); it iterates over names."""

    def __init__(self, names: Iterable[str], numbers: ArrayLike) -> None:
        self.names, self.numbers = list(names), np.asarray(numbers)

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.names:
            raise KeyError(f'there is no column "{name}"; there are {", ".join(self.names)}')
        return self.numbers[:, self.names.index(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __len__(self) -> int:
        return len(self.numbers)

    def __repr__(self):
        return f"<ostium.Table of {len(self)} rows: {', '.join(self.names)}>"

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """{name: column}, which pandas.DataFrame takes."""
        return {name: self.numbers[:, i] for i, name in enumerate(self.names)}


class Recording:
    """A recording: run.h5. Raises OstiumError for a file that is damaged, or is none of this version.

    signals  Table of what was measured, a hundred times a second; signals["time_s"] is the first column
    inputs   Table of what the operator did, one row a step
    events   list of dict: time_s, name, tool (None: of none), value
    tools, branches   names by index, as signals have them (tip_branch)
    setup    dict: case, script, instruments, seed;  end: dict of outcome, reason, metrics, or None if it was cut off
    """

    def __init__(self, path: Union[str, PathLike[str]]) -> None:
        self._file = RecordingFile(path)
        self.path, self.software = self._file.path, self._file.software
        self.setup, self.end = self._file.setup, self._file.end
        self.step_s, self.steps = self._file.step_s, self._file.steps
        self.tools, self.branches = self._file.tools, self._file.branches

    @property
    def signals(self) -> Table:
        return Table(self._file.signal_names, self._file.signals)

    @property
    def inputs(self) -> Table:
        return Table(self._file.input_names, self._file.inputs)

    @property
    def events(self) -> list[dict[str, Any]]:
        names = self._file.event_names
        return [{"time_s": step * self.step_s, "name": names[int(code)] if names else int(code),
                 "tool": self.tools[int(tool)] if self.tools and tool >= 0 else None, "value": value}
                for step, code, tool, value in self._file.events]

    def shapes(self, tool: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """(times (n) s, points (n, nodes, 3) m, hub to tip, NaN outside the body), of a run with --record shapes."""
        steps, points = self._file.shapes(tool)
        return steps * self.step_s, points

    @property
    def hashes(self) -> NDArray[np.uint64]:
        """(steps) uint64, of the state after each step."""
        return self._file.hashes

    def __repr__(self):
        return f"<ostium.Recording {self.path}: {self.steps * self.step_s:.1f} s>"
