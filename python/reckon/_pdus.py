# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The classes of all PDUs and records, made by the field tables of the library; _pdus.pyi lists them."""
from reckon import _native
from reckon._native import decode, decode_datagram, encode
from reckon._records import Pdu, Record

_native.make_classes(Record, Pdu)
__all__ = list(_native.fields_of_classes())
globals().update({name: getattr(_native, name) for name in __all__})
