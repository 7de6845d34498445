# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Type, TypeVar, Union

import numpy
import numpy.typing

from reckon._records import Pdu, Record

Octets = Union[bytes, bytearray, memoryview]
Triple = Tuple[float, float, float]
Quadruple = Tuple[float, float, float, float]
Id = Tuple[int, int, int]
R = TypeVar("R", bound=Record)

def decode(octets: Octets) -> Pdu:
    """One PDU as an object of its class. DecodeError with the reason and the remedy if the octets are none."""

def decode_datagram(octets: Octets) -> List[Pdu]:
    """All PDUs of a datagram. DecodeError with the octet at the first that is damaged."""

def encode(pdu: Pdu) -> bytes:
    """The octets of a PDU. Length, type, family and the counts of its lists follow what it holds.

    ValueError or TypeError with the field where a value does not fit.
    """

def trailing(octets: Octets) -> bytes:
    """The octets of a PDU behind its last field; b"" if there are none."""

def make_classes(base: Type[Record], pdu_base: Type[Pdu]) -> None: ...
def initial(kind: Type[R]) -> R: ...
def fields_of_classes() -> Dict[str, Dict[str, str]]: ...
def pdu_name(pdu_type: int) -> str: ...
def columns_of(path: str) -> Dict[str, Any]: ...
def predict_columns(
    location: numpy.typing.ArrayLike,
    orientation: numpy.typing.ArrayLike,
    velocity: numpy.typing.ArrayLike,
    acceleration: numpy.typing.ArrayLike,
    angular_velocity: numpy.typing.ArrayLike,
    algorithm: numpy.typing.ArrayLike,
    appearance: numpy.typing.ArrayLike,
    since: numpy.typing.ArrayLike,
) -> Tuple[
    numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]
]: ...
def run_scene(
    path: str, duration: float, seed: Optional[int], peers: int, impair: str, effects: object
) -> Tuple[Dict[str, Any], Dict[str, Any]]: ...

class Reader:
    def __init__(self, path: str) -> None: ...
    def next(self) -> Optional[Tuple[int, float, str, str, bytes]]: ...
    def problem(self) -> str: ...
    def decode(self, frame: int, octets: bytes) -> List[Pdu]: ...

class RemoteEntity:
    """A remote entity as of one instant. Frame S, SI units."""

    @property
    def id(self) -> Id:
        """(site, application, entity)"""
    @property
    def type(self) -> str:
        """kind.domain.country.category.. of SISO-REF-010"""
    @property
    def marking(self) -> str: ...
    @property
    def force_id(self) -> int:
        """1 friendly, 2 opposing, 3 neutral"""
    @property
    def appearance(self) -> int:
        """Bits as on the wire."""
    @property
    def position(self) -> Triple:
        """East, north, up [m]"""
    @property
    def velocity(self) -> Triple:
        """[m/s]"""
    @property
    def orientation(self) -> Quadruple:
        """w, x, y, z; B to S"""
    @property
    def age(self) -> float:
        """Since its last update [s]"""

class Motion:
    def __init__(
        self,
        position: Sequence[float],
        velocity: Sequence[float],
        acceleration: Sequence[float],
        orientation: Sequence[float],
        angular_velocity: Sequence[float],
    ) -> None: ...

class Session:
    def __init__(
        self,
        scene: str,
        exercise: int,
        latitude: float,
        longitude: float,
        interface: str,
        name: str,
        site: Optional[int],
        application: Optional[int],
        effects: object,
    ) -> None: ...
    def resign(self) -> None: ...
    def is_joined(self) -> bool: ...
    def own(self, marking: str, type: str, force_id: int, motion: Motion) -> int: ...
    def move(self, entity: int, motion: Motion) -> None: ...
    def set_appearance(self, entity: int, appearance: int) -> None: ...
    def remove(self, entity: int) -> None: ...
    def id_of(self, entity: int) -> Id: ...
    def on_discover(self, callback: Callable[[RemoteEntity], object]) -> None: ...
    def on_update(self, callback: Callable[[RemoteEntity], object]) -> None: ...
    def on_remove(self, callback: Callable[[Id], object]) -> None: ...
    def on_interaction(self, pdu_type: int, callback: Callable[[Any, bool], object]) -> None: ...
    def send(self, pdu: Pdu) -> None: ...
    def tick(self) -> None: ...
    def entities(self) -> List[RemoteEntity]: ...
    def find(self, id: Id) -> Optional[RemoteEntity]: ...
    def utc(self) -> float: ...
    def position(self, latitude: float, longitude: float, height: float) -> Triple: ...
    def world(self, at: Sequence[float]) -> Triple: ...
