# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""DIS traffic, dead reckoning, scenes and federates of Reckon, from Python.

SI units. Frame W is geocentric (ECEF, WGS84), frame S a scene's (east, north, up at its origin), frame B a body's
(forward, right, down). Names of PDUs, records and fields are those of IEEE 1278.1.
"""
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
