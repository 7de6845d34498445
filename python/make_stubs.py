#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes _pdus.pyi, the types of all PDUs and records, from the package itself: make_stubs.py FOLDER_OF_PACKAGE"""
import pathlib
import sys

HEAD = '''# Made by python/make_stubs.py. SI units; frames as docs/conventions.md has them.
from typing import List, Union

from reckon._records import Pdu, Record
'''


def hint(text):
    parts = text.split(" | ")
    items = [part[len("list["):-1] for part in parts if part.startswith("list[")]
    others = [part for part in parts if not part.startswith("list[")]
    if items:
        others.insert(0, f"List[{union_of(items)}]")
    return union_of(others)


def union_of(names):
    return names[0] if len(names) == 1 else f"Union[{', '.join(names)}]"


def stub_of(name, fields, is_pdu):
    lines = [f"class {name}({'Pdu' if is_pdu else 'Record'}):"]
    lines += [f"    {field}: {hint(text)}" for field, text in fields.items()]
    keywords = ", ".join(f"{field}: {hint(text)} = ..." for field, text in fields.items())
    lines.append(f"    def __new__(cls, *, {keywords}) -> {name}: ...")
    return "\n".join(lines)


def main(package):
    sys.path.insert(0, str(package.parent))
    sys.dont_write_bytecode = True
    import reckon._pdus  # makes the classes
    from reckon import _native
    classes = _native.fields_of_classes()
    stubs = [stub_of(name, fields, issubclass(getattr(reckon, name), reckon.Pdu)) for name, fields in classes.items()]
    names = ", ".join(f'"{name}"' for name in classes)
    (package / "_pdus.pyi").write_text("\n\n".join([HEAD + f"\n__all__ = [{names}]", *stubs]) + "\n")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())
