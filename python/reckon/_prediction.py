# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Dead reckoning over arrays."""
from __future__ import annotations

import typing

import numpy

from reckon import _native
from reckon._captures import States

if typing.TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from reckon._pdus import EntityState


class Poses(typing.NamedTuple):
    """Poses by columns, frame W: location [m], orientation psi, theta, phi [rad], linear_velocity [m/s]; each (n, 3)."""

    location: NDArray[numpy.float64]
    orientation: NDArray[numpy.float64]
    linear_velocity: NDArray[numpy.float64]


def predict(states: States | EntityState, times: ArrayLike) -> Poses:
    """Poses at which receivers show entities, by the models of IEEE 1278.1, without convergence.

    states: rows of a capture (`States`); then `times` [s since 1970 UTC] is one number, or one for each row; for a
    single row, any number of times. Or one EntityState; then `times` [s] counts from its update.
    A state that receivers refuse (not finite, out of range) gives NaN. Other threads of Python run meanwhile.
    """
    at = numpy.asarray(times, dtype=float)
    if not isinstance(states, States):
        return Poses(*_native.predict_columns(*_columns_of(states), at.reshape(-1)))
    if at.ndim == 0:
        at = numpy.full(len(states), at)
    since = at - states.time if len(states) in (1, len(at)) else at
    return Poses(*_native.predict_columns(
        states.location, states.orientation, states.linear_velocity, states.linear_acceleration,
        states.angular_velocity, states.dead_reckoning_algorithm, states.appearance, since))


def _columns_of(state: EntityState) -> tuple[NDArray[typing.Any], ...]:
    """One EntityState as columns of one row."""
    def row(record: object, *names: str) -> NDArray[typing.Any]:
        return numpy.array([[getattr(record, name) for name in names]])

    moves = state.dead_reckoning_parameters
    return (row(state.entity_location, "x", "y", "z"), row(state.entity_orientation, "psi", "theta", "phi"),
            row(state.entity_linear_velocity, "x", "y", "z"), row(moves.entity_linear_acceleration, "x", "y", "z"),
            row(moves.entity_angular_velocity, "x", "y", "z"), row(moves, "dead_reckoning_algorithm").reshape(-1),
            row(state, "entity_appearance").reshape(-1))
