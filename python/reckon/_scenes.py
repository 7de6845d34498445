# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes in simulated time."""
from __future__ import annotations

import dataclasses
import os
import typing

import numpy

from reckon import _native

if typing.TYPE_CHECKING:
    from numpy.typing import NDArray


class SceneError(ValueError):
    """A scene cannot be run: the message has file, line and column, the fault and the remedy."""


@dataclasses.dataclass(frozen=True)
class SceneRun:
    """Every servo step of every device, as `reckon demo --trace` writes it: n rows, SI units, frame S.

    time [s]; peer, device: from 1; contacts: hands touched; patch: of the object, below the surface point
    handle, surface_point [m], velocity [m/s], force and its parts from the object, from hands, and from hands by their force
    models [N]: (n, 3); of a device of six axes torque [N m], orientation (n, 4: w x y z, tool to S), turn_rate [rad/s], of
    others 0 and no turn; ledger, need, energy [J]
    numbers: costs of the whole run, by name: pose_error [m] and force_error [N] with p50, p99, max; datagrams, octets,
    hand_contact [s], scene_contact [s], peak_force [N], least_energy [J]
    """

    time: NDArray[numpy.float64]
    peer: NDArray[numpy.uint32]
    device: NDArray[numpy.uint32]
    handle: NDArray[numpy.float64]
    surface_point: NDArray[numpy.float64]
    velocity: NDArray[numpy.float64]
    force: NDArray[numpy.float64]
    mesh_force: NDArray[numpy.float64]
    hand_force: NDArray[numpy.float64]
    record_force: NDArray[numpy.float64]
    torque: NDArray[numpy.float64]
    orientation: NDArray[numpy.float64]
    turn_rate: NDArray[numpy.float64]
    ledger: NDArray[numpy.float64]
    need: NDArray[numpy.float64]
    energy: NDArray[numpy.float64]
    contacts: NDArray[numpy.uint32]
    patch: NDArray[numpy.uint32]
    numbers: dict[str, typing.Any]

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, rows: typing.Any) -> SceneRun:
        """The rows that a slice, a mask or an array of indices selects."""
        return dataclasses.replace(self, **{field.name: getattr(self, field.name)[rows]
                                            for field in dataclasses.fields(self) if field.name != "numbers"})


def run_scene(path: str | os.PathLike[str], duration: float, seed: int | None = None, peers: int = 2,
              impair: str = "", effects: object = None) -> SceneRun:
    """Runs a scene file as `reckon demo --simulated-time` does: without sockets and waiting, with the same result each time.

    duration [s]; seed: of the network impairment, which the scene or `impair` must have; peers: 1 to 64; impair: as the
    option of `reckon demo`, "delay=200ms jitter=100ms loss=20%"; effects: of your own module, which the scene may then
    declare. Other threads of Python run meanwhile, and Ctrl-C ends it. Raises SceneError if the scene or an argument
    is invalid.
    """
    try:
        columns, numbers = _native.run_scene(os.fspath(path), duration, seed, peers, impair, effects)
    except RuntimeError as error:
        raise SceneError(str(error)) from None
    return SceneRun(**columns, numbers=numbers)
