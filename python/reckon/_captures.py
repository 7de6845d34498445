# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Captures: columns of Entity States, and datagrams one by one."""
from __future__ import annotations

import dataclasses
import os
import typing

import numpy

from reckon import _native
from reckon._records import Pdu

if typing.TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class CaptureError(RuntimeError):
    """A file is not a capture, or cannot be read: the message has its path and the remedy."""


@dataclasses.dataclass(frozen=True)
class States:
    """Entity States by columns: n rows, in the order of the capture. SI units.

    time: arrival [s since 1970 UTC]; frame: of the capture, from 1; timestamp: as on the wire
    entity_id: site, application, entity (n, 3); entity_type: kind, domain, country, .. extra (n, 7)
    location: frame W [m] (n, 3); orientation: psi, theta, phi [rad] (n, 3)
    linear_velocity [m/s], linear_acceleration [m/s^2] (n, 3): frame W, or B where the algorithm is 6 to 9
    angular_velocity: frame B [rad/s] (n, 3); dead_reckoning_algorithm: 0 to 9
    """

    time: NDArray[numpy.float64]
    frame: NDArray[numpy.uint64]
    exercise_id: NDArray[numpy.uint8]
    timestamp: NDArray[numpy.uint32]
    entity_id: NDArray[numpy.uint16]
    force_id: NDArray[numpy.uint8]
    entity_type: NDArray[numpy.uint16]
    location: NDArray[numpy.float64]
    orientation: NDArray[numpy.float32]
    linear_velocity: NDArray[numpy.float32]
    linear_acceleration: NDArray[numpy.float32]
    angular_velocity: NDArray[numpy.float32]
    dead_reckoning_algorithm: NDArray[numpy.uint8]
    appearance: NDArray[numpy.uint32]
    marking: NDArray[numpy.bytes_]
    pdus: int = 0
    damaged: int = 0
    problem: str = ""

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, rows: typing.Any) -> States:
        """The rows that a slice, a mask or an array of indices selects."""
        picked = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return States(**{name: column[rows] if isinstance(column, numpy.ndarray) else column
                         for name, column in picked.items()})

    def entities(self) -> list[tuple[int, int, int]]:
        """The ID of each entity, once, in order: (site, application, entity)."""
        return [(int(row[0]), int(row[1]), int(row[2])) for row in numpy.unique(self.entity_id, axis=0)]

    def of(self, entity_id: ArrayLike) -> States:
        """The rows of one entity. entity_id: (site, application, entity)"""
        return self[(self.entity_id == numpy.asarray(entity_id, dtype=numpy.uint16)).all(axis=1)]


def read_capture(path: str | os.PathLike[str]) -> States:
    """Reads all Entity States of a pcap or pcapng file, plain or compressed, by columns.

    Other threads of Python run meanwhile. Damaged PDUs are counted (`damaged`) and left out; if the file itself is
    damaged, `problem` has the place of the damage. Raises CaptureError if it is not a capture.
    """
    try:
        return States(**_native.columns_of(os.fspath(path)))
    except RuntimeError as error:
        raise CaptureError(str(error)) from None


class Datagram(typing.NamedTuple):
    """A datagram of a capture: frame from 1, arrival [s since 1970 UTC], addresses "10.0.0.1:3000", octets."""

    frame: int
    time: float
    source: str
    destination: str
    octets: bytes


class Capture:
    """A pcap or pcapng file, plain or compressed: iterate it for its datagrams, `pdus()` for their PDUs.

        for datagram, pdu in reckon.Capture("exercise.pcap").pdus(): ...
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self.problem = ""
        self._open()

    def _open(self) -> _native.Reader:
        try:
            return _native.Reader(self.path)
        except RuntimeError as error:
            raise CaptureError(str(error)) from None

    def __iter__(self) -> typing.Iterator[Datagram]:
        for _, datagram in self._datagrams():
            yield datagram

    def _datagrams(self) -> typing.Iterator[tuple[_native.Reader, Datagram]]:
        reader = self._open()
        while (row := reader.next()) is not None:
            yield reader, Datagram(*row)
        self.problem = reader.problem()

    def pdus(self) -> typing.Iterator[tuple[Datagram, Pdu]]:
        """(datagram, pdu) for each PDU. DecodeError, with path, frame and octet, at one that is damaged."""
        import reckon._pdus  # the classes

        for reader, datagram in self._datagrams():
            for pdu in reader.decode(datagram.frame, datagram.octets):
                yield datagram, pdu
