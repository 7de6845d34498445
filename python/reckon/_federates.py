# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Federates of an exercise."""
from __future__ import annotations

import math
import os
import typing
import weakref

import reckon._pdus  # the classes of what callbacks are given
from reckon import _native
from reckon._native import RemoteEntity
from reckon._records import Pdu

STILL = (0.0, 0.0, 0.0)
Id = typing.Tuple[int, int, int]
Vector = typing.Sequence[float]
P = typing.TypeVar("P", bound=Pdu)


class Exercise(typing.NamedTuple):
    """Plain DIS on 239.192.1.0:3000: its number, and the origin of frame S [degrees]."""

    number: int = 1
    latitude_deg: float = 0.0
    longitude_deg: float = 0.0


def heading(degrees: float) -> tuple[float, float, float, float]:
    """A level body's orientation w, x, y, z (B to S), clockwise from north [degrees]."""
    # Forward is (sin h, cos h, 0), right (cos h, -sin h, 0), down (0, 0, -1): half a turn about the axis between both.
    half = math.radians(90.0 - degrees) / 2.0
    return (0.0, math.cos(half), math.sin(half), 0.0)


def heading_of(velocity: Vector) -> tuple[float, float, float, float]:
    """A level body's orientation along a velocity in frame S; east if the velocity is zero."""
    return heading(math.degrees(math.atan2(velocity[0], velocity[1])) if any(velocity) else 90.0)


class Entity:
    """An entity of the program, see Federate.own()."""

    def __init__(self, session: _native.Session, number: int) -> None:
        self._session, self._number = session, number

    @property
    def id(self) -> Id:
        """(site, application, entity); it changes if another peer uses the same."""
        return self._session.id_of(self._number)

    def move(self, position: Vector, velocity: Vector = STILL, orientation: Vector | None = None,
             acceleration: Vector = STILL, angular_velocity: Vector = STILL) -> None:
        """Sets its true state, at any rate; the thresholds decide when an update is sent.

        position [m], velocity [m/s], acceleration [m/s^2]: frame S; orientation: w, x, y, z, B to S, by default level
        and along the velocity; angular_velocity: frame B [rad/s]
        """
        faces = heading_of(velocity) if orientation is None else orientation
        self._session.move(self._number, _native.Motion(position, velocity, acceleration, faces, angular_velocity))

    def show(self, appearance: int) -> None:
        """Sets the bits of its appearance, as on the wire."""
        self._session.set_appearance(self._number, appearance)

    def remove(self) -> None:
        """Removes it from the exercise."""
        self._session.remove(self._number)


class Federate:
    """Takes part in an exercise from construction to the end of a `with` block.

        with reckon.Federate(reckon.Exercise(1, 47.05, 8.31), iface="lo") as federate:
            truck = federate.own("TRUCK1", type="1.1.225.7")
            federate.on(reckon.Fire, lambda fire, owns: print(fire.firing_entity_id))
            while True:
                truck.move(position=(0.0, 0.0, 0.0))
                federate.tick()
                time.sleep(0.01)

    One thread makes all calls. Callbacks run within tick(), on that thread, and may call anything except tick() and
    resign(); tick() raises their exceptions. Frame S: east, north, up from the origin of the scene [m].
    """

    def __init__(self, scene: Exercise | str | os.PathLike[str] = Exercise(), iface: str = "", name: str = "federate",
                 site: int | None = None, application: int | None = None, effects: object = None) -> None:
        """scene: a scene file, or an Exercise; iface: name, address or index, "": chosen; name: of this peer

        site, application: of its entities' IDs, by default free ones; effects: as for run_scene(). Raises RuntimeError or
        ValueError with the remedy if it cannot join.
        """
        plain = scene if isinstance(scene, Exercise) else Exercise()
        path = "" if isinstance(scene, Exercise) else os.fspath(scene)
        self._session = _native.Session(path, plain.number, math.radians(plain.latitude_deg),
                                        math.radians(plain.longitude_deg), iface, name, site, application, effects)
        self._end = weakref.finalize(self, self._session.resign)

    def __enter__(self) -> Federate:
        return self

    def __exit__(self, *_: object) -> None:
        self.resign()

    def resign(self) -> None:
        """Leaves the exercise: deactivates its entities and announces the end. No call may follow."""
        self._end()

    def own(self, marking: str, type: str = "1.1", position: Vector = STILL, force_id: int = 0,
            velocity: Vector = STILL, orientation: Vector | None = None) -> Entity:
        """Registers an entity of this federate and returns it.

        marking: at most 11 ASCII characters; type: kind.domain.country.category.. of SISO-REF-010; force_id: 1 friendly,
        2 opposing, 3 neutral; the others: as for Entity.move()
        """
        faces = heading_of(velocity) if orientation is None else orientation
        motion = _native.Motion(position, velocity, STILL, faces, STILL)
        return Entity(self._session, self._session.own(marking, type, force_id, motion))

    def on_discover(self, callback: typing.Callable[[RemoteEntity], object]) -> None:
        """Sets the callback for each new RemoteEntity."""
        self._session.on_discover(callback)

    def on_update(self, callback: typing.Callable[[RemoteEntity], object]) -> None:
        """Sets the callback for each updated RemoteEntity, once a tick()."""
        self._session.on_update(callback)

    def on_remove(self, callback: typing.Callable[[RemoteEntity, str], object]) -> None:
        """Sets the callback for each removed RemoteEntity, with its last state and the reason: "deactivated", "owner left",
        "owner changed", "out of sight", "silent" or "no room"."""
        self._session.on_remove(callback)

    def on(self, kind: type[P], callback: typing.Callable[[P, bool], object]) -> None:
        """Sets the callback for each PDU of a class, such as reckon.Fire, and whether its sender owns the issuing entity.

        A PDU in the name of another owner's entity is refused. A second call replaces the first.
        """
        self._session.on_interaction(kind().header.pdu_type, callback)

    def send(self, pdu: Pdu) -> None:
        """Sends a PDU and sets its exercise and timestamp. A PDU with a location goes to peers with that location in reach."""
        self._session.send(pdu)

    def tick(self) -> None:
        """Runs due work and the callbacks. Never waits: call it at 30 Hz or more."""
        self._session.tick()

    def entities(self) -> list[RemoteEntity]:
        """All remote entities as RemoteEntity, at their present shown poses."""
        return self._session.entities()

    def find(self, entity_id: Id) -> RemoteEntity | None:
        """The RemoteEntity of this ID (site, application, entity), or None."""
        return self._session.find(entity_id)

    def utc(self) -> float:
        """[s] since 1970, without the jumps of the host's clock."""
        return self._session.utc()

    def position(self, latitude_deg: float, longitude_deg: float, height: float = 0.0) -> Vector:
        """A position in frame S [m]. height: above the ellipsoid [m]"""
        return self._session.position(math.radians(latitude_deg), math.radians(longitude_deg), height)

    def world(self, position: Vector) -> Vector:
        """A position of frame S in frame W [m], as in PDUs."""
        return self._session.world(position)
