# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Base classes of the classes made from the field tables."""
from __future__ import annotations

import typing

from reckon import _native

if typing.TYPE_CHECKING:
    from reckon._pdus import PduHeader

class DecodeError(ValueError):
    """Octets are not a PDU. `rule` is the reason, as in `reckon inspect`; `octet` is the start of the PDU."""

    rule = ""
    octet = 0


class Record:
    """A record of the wire format. Fields are attributes and can be set.

    Without arguments every field has its initial value:

        reckon.WorldCoordinates(x=4.2e6, y=1.7e5, z=4.7e6)
    """

    __slots__ = ("_form", "_padding")

    def __new__(cls, **fields: typing.Any) -> Record:
        self = _native.initial(cls)
        for name, value in fields.items():
            setattr(self, name, value)
        return self

    def _items(self) -> dict[str, typing.Any]:
        return {name: getattr(self, name) for name in type(self).__slots__ if hasattr(self, name)}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self._items().items())})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Record) or type(self) is not type(other):
            return NotImplemented
        return self._items() == other._items()

    __hash__ = None  # type: ignore[assignment]

    def __deepcopy__(self, memo: dict[int, typing.Any]) -> Record:
        made = _native.initial(type(self))
        for name in ("_form", "_padding", *type(self).__slots__):
            if hasattr(self, name):
                value = getattr(self, name)
                setattr(made, name, value if name == "_form" else _copied(value, memo))
        return made

    def __reduce__(self) -> typing.Any:
        raise TypeError(f"{type(self).__name__} cannot be pickled alone: pickle its PDU")


class Pdu(Record):
    """A PDU: header and fields."""

    __slots__ = ()
    header: PduHeader

    @property
    def trailing(self) -> bytes:
        """Octets after the last field; decode() keeps them and encode() writes them.

        A vendor extension, or data that a wrong count or length omits; b"" in nearly all PDUs.
        """
        return _native.trailing(_native.encode(self))

    def __repr__(self) -> str:
        text = super().__repr__()
        if not getattr(self, "_padding", b""):
            return text
        try:
            trailing = self.trailing
        except (TypeError, ValueError):  # a field holds what no octets say
            return text
        return f"{text[:-1]}, trailing={trailing!r})" if trailing else text

    def __reduce__(self) -> typing.Any:
        return _decoded, (_native.encode(self),)


def _decoded(octets: bytes) -> Pdu:
    import reckon._pdus  # the classes, where an object is unpickled first

    return _native.decode(octets)


def _copied(value: typing.Any, memo: dict[int, typing.Any]) -> typing.Any:
    if isinstance(value, list):
        return [_copied(item, memo) for item in value]
    return value.__deepcopy__(memo) if isinstance(value, Record) else value
