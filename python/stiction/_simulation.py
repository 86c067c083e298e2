# SPDX-License-Identifier: Apache-2.0
"""Scenes, stepped through time."""
from __future__ import annotations

import html
import json
from dataclasses import dataclass
from typing import Any, Mapping

import numpy as np
from numpy.typing import NDArray

from . import _stiction
from ._given import Path, path_text, real, require_text
from ._problem import Problem, parsed

Table = dict[str, NDArray[Any]]


@dataclass(frozen=True, repr=False)
class Simulation:
    """A run: what the tables of `stiction simulate` have, as arrays that cannot be written to.

    `bodies`, `contacts`, `energy`, `drift` and `motion` are columns by the names that the files have; units and what
    each column means are listed in corpus/formats/simulation_tables.md. Those of `bodies` are states x bodies, state 0
    the scene as given. The others have a number for each row: `contacts` one for each contact of each step, whose state
    is its column `step`. `reason` tells of the first problem that was not solved; it is empty if all were.
    A notebook shows it as a page that plays it.
    """

    name: str
    dimension: int
    bodies: Table
    contacts: Table
    energy: Table
    drift: Table
    motion: Table
    statistics: dict[str, int]
    reason: str
    asked: tuple[str, str, float | None, float | None, float, bool]  # text of the scene, its place, and what was asked

    def page(self) -> str:
        """A page that plays the run: HTML that needs nothing else. The run is made again for it."""
        return _stiction.simulation_page(*self.asked)

    def _repr_html_(self) -> str:  # a notebook shows the player
        return (f'<iframe srcdoc="{html.escape(self.page())}" style="width: 100%; height: 45em; border: 0" '
                f'title="{html.escape(self.name)}, stepped through time"></iframe>')

    def __repr__(self) -> str:
        states, bodies = self.bodies["time_s"].shape
        why = f", {self.reason}" if self.reason else ""
        return f"<stiction.Simulation of {self.name!r}, {states} states, {bodies} bodies{why}>"

    def _stacked(self, pattern: str, axes: str) -> NDArray[np.float64]:
        return _closed(np.stack([self.bodies[pattern.replace("%", axis)] for axis in axes], axis=-1))

    @property
    def _axes(self) -> str:
        return "xyz"[:self.dimension]

    @property
    def times(self) -> NDArray[np.float64]:
        """Of the states, in s."""
        return self.energy["time_s"]

    @property
    def positions(self) -> NDArray[np.float64]:
        """Of centres of mass in m: states x bodies x dimension."""
        return self._stacked("%_m", self._axes)

    @property
    def angles(self) -> NDArray[np.float64]:
        """In the plane, in rad from -pi to pi: states x bodies."""
        if self.dimension != 2:
            raise ValueError("angles: found a scene in space, expected one in the plane: quaternions")
        return self.bodies["angle_rad"]

    @property
    def quaternions(self) -> NDArray[np.float64]:
        """In space, w, x, y, z of length 1: states x bodies x 4."""
        if self.dimension != 3:
            raise ValueError("quaternions: found a scene in the plane, expected one in space: angles")
        return self._stacked("q%", "wxyz")

    @property
    def velocities(self) -> NDArray[np.float64]:
        """Of centres of mass in m/s, of the middle of the step before: states x bodies x dimension."""
        return self._stacked("v%_m_per_s", self._axes)

    @property
    def spins(self) -> NDArray[np.float64]:
        """In rad/s, likewise: states x bodies in the plane, states x bodies x 3 in space."""
        return self.bodies["spin_rad_per_s"] if self.dimension == 2 else self._stacked("spin_%_rad_per_s", "xyz")


def _closed(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array


def _column(numbers: NDArray[Any], words: list[str] | None) -> NDArray[Any]:
    column: NDArray[Any] = numbers if words is None else np.array(words, dtype=str)[numbers]
    return column


def _table(said: dict[str, tuple[NDArray[Any], list[str] | None]], states: int | None = None) -> Table:
    """With `states`, arrays of states x bodies."""
    columns = {name: _column(numbers, words) for name, (numbers, words) in said.items()}
    return {name: _closed(column if states is None else column.reshape(states, -1)) for name, column in columns.items()}


def _scene_text(scene: Path | Mapping[str, Any]) -> tuple[str, str]:
    """The text of a scene, and what it is called where it is refused."""
    if isinstance(scene, Mapping):
        return json.dumps(scene), "scene"
    source = path_text(scene)
    with open(source, encoding="utf-8") as file:
        return file.read(), source


def assemble(scene: Path | Mapping[str, Any], level: str = "forces", *, factors: bool = False,
             full: bool = False) -> list[Problem]:
    """The contact problems of a scene at its first instant, one for each group of bodies that contacts join, over
    rationals: those that `stiction assemble` writes.

    `scene` is a stiction-scene file, or a dictionary like one. `level`: 'forces', or 'impulses' of a collision. With
    `factors` problems hold J, M and w in place of A; `full` makes one problem of all, with redundant rows.
    """
    text, source = _scene_text(scene)
    require_text(level=level)
    for name, value in (("factors", factors), ("full", full)):
        if not isinstance(value, bool):
            raise TypeError(f"{name}: found {value!r}, expected True or False")
    return [parsed(problem, source) for problem in _stiction.assemble(text, source, level, factors, full)]


def simulate(scene: Path | Mapping[str, Any], seconds: float | None = None, step: float | None = None, *,
             rest: float | None = None, full: bool = False) -> Simulation:
    """Steps a scene through time, over doubles: what `stiction simulate` does, and with the same numbers.

    `scene` is a stiction-scene file, or a dictionary like one. `seconds` and `step`, in s, are the scene's unless they
    are given; `rest` and `full` are what `stiction simulate --help` says. Where a problem is not solved the best
    forces are taken, and `reason` tells. Ctrl-C is a KeyboardInterrupt.
    """
    text, source = _scene_text(scene)
    if not isinstance(full, bool):
        raise TypeError(f"full: found {full!r}, expected True or False")
    asked = (text, source, None if seconds is None else real("seconds", seconds),
             None if step is None else real("step", step), 0.0 if rest is None else real("rest", rest), full)
    said = _stiction.simulate(*asked)
    energy = _table(said["energy"])
    return Simulation(said["name"], said["dimension"], _table(said["bodies"], len(energy["time_s"])),
                      _table(said["contacts"]), energy, _table(said["drift"]), _table(said["motion"]),
                      said["statistics"], said["reason"], asked)
