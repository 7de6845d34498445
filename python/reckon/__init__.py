# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""DIS traffic, dead reckoning, scenes and federates of Reckon, from Python.

SI units. Frame W is geocentric (ECEF, WGS84), frame S a scene's (east, north, up at its origin), frame B a body's
(forward, right, down). Names of PDUs, records and fields are those of IEEE 1278.1.
"""
import importlib

TYPE_CHECKING = False  # as typing.TYPE_CHECKING, which would take longer than all of this
if TYPE_CHECKING:
    from reckon._captures import Capture, CaptureError, Datagram, States, read_capture
    from reckon._federates import Entity, Exercise, Federate, RemoteEntity, heading
    from reckon._native import decode, decode_datagram, encode
    from reckon._pdus import *
    from reckon._pdus import __all__ as _pdu_names
    from reckon._prediction import Poses, predict
    from reckon._records import DecodeError, Pdu, Record
    from reckon._scenes import SceneError, SceneRun, run_scene
    from reckon._studies import StudyError, study

    __all__ = [
        "Capture", "CaptureError", "Datagram", "DecodeError", "Entity", "Exercise", "Federate", "Pdu", "Poses", "Record",
        "RemoteEntity", "SceneError", "SceneRun", "States", "StudyError", "decode", "decode_datagram", "encode", "heading",
        "predict", "read_capture", "run_scene", "study",
    ]
    __all__ += _pdu_names

# Each part is loaded when one of its names is first used. The classes of PDUs are in _pdus, which other parts import as needed.
_PARTS = {
    "_captures": ("Capture", "CaptureError", "Datagram", "States", "read_capture"),
    "_federates": ("Entity", "Exercise", "Federate", "RemoteEntity", "heading"),
    "_prediction": ("Poses", "predict"),
    "_records": ("DecodeError", "Pdu", "Record"),
    "_pdus": ("decode", "decode_datagram", "encode"),
    "_scenes": ("SceneError", "SceneRun", "run_scene"),
    "_studies": ("StudyError", "study"),
}
_PART_OF = {name: part for part, names in _PARTS.items() for name in names}


def __getattr__(name: str) -> object:
    if name.startswith("_") and name != "__all__":
        raise AttributeError(f"module 'reckon' has no attribute {name!r}")
    part = importlib.import_module("reckon." + _PART_OF.get(name, "_pdus"))
    if name == "__all__":
        globals()[name] = [*_PART_OF, *part.__all__]
    elif hasattr(part, name):
        globals()[name] = getattr(part, name)
    else:
        raise AttributeError(f"module 'reckon' has no attribute {name!r}")
    return globals()[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *__getattr__("__all__")})
