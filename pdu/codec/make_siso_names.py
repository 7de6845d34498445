#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Converts siso_names.txt to the C++ tables that siso_names.cpp includes.

  make_siso_names.py siso_names.txt siso_names_data.inc

The tables have no pointers. All names are in one text, in which a name that is part of another one
needs no room. A table without gaps stores no values. The same input gives the same output.
"""

import re
import sys

SECTION = re.compile(r"\[(\w+)\](?: (\d+))?( bits)?( all)?$")
ROW = re.compile(r"(\d+) (.+)$")
BIT_ROW = re.compile(r"(\d+) (\d+) (\w+) (\w+|-)$")


class BadLine(Exception):
    """A line of the input that breaks its rules."""


def printable(name):
    return all(" " <= letter <= "~" for letter in name) and len(name) < 256


def check_row(rows, row):
    if rows and row[0] <= rows[-1][0]:
        raise BadLine(f"value {row[0]} does not follow {rows[-1][0]}")
    if not printable(row[1]) or row[0] >= 1 << 32:
        raise BadLine("a name is at most 255 printable ASCII letters, a value has 32 bits")


def read_row(section, line):
    match = (BIT_ROW if section["bits"] else ROW).match(line)
    if match is None:
        raise BadLine("neither a section nor a row of one")
    if section["bits"]:
        return int(match[1]), int(match[2]), match[3], match[4]
    row = int(match[1]), match[2]
    check_row(section["rows"], row)
    return row


def read(path):
    """All sections of the file, in order."""
    sections = []
    with open(path, encoding="ascii") as lines:
        for number, line in enumerate(lines, 1):
            line = line.rstrip("\n")
            if not line or line.startswith("#"):
                continue
            match = SECTION.match(line)
            try:
                if match is not None:
                    sections.append({"name": match[1], "bits": bool(match[3]),
                                     "all": bool(match[4]), "rows": []})
                elif sections:
                    sections[-1]["rows"].append(read_row(sections[-1], line))
                else:
                    raise BadLine("a row before the first section")
            except BadLine as error:
                raise SystemExit(f"{path}:{number}: {error}: {line}") from error
    return sections


def without_parts(names):
    """The names that are not part of a longer one, in a fixed order."""
    kept, text = [], ""
    for name in sorted(set(names), key=lambda name: (-len(name), name)):
        if name not in text:
            kept.append(name)
            text += name + "\n"
    return kept


def chained(names):
    """One text with all names, in which the end of a name may be the beginning of the next."""
    follower, taken = {}, set()
    head_of = {name: name for name in names}  # of the chain that ends in this name
    for size in range(24, 0, -1):
        begins = {}
        for name in names:
            if name not in taken and len(name) > size:
                begins.setdefault(name[:size], []).append(name)
        for name in names:
            if name in follower or len(name) <= size:
                continue
            for other in begins.get(name[-size:], []):
                if other not in taken and head_of[name] != other:
                    follower[name] = (other, size)
                    taken.add(other)
                    end = other
                    while end in follower:
                        end = follower[end][0]
                    head_of[end] = head_of[name]
                    break
    text = []
    for name in names:
        if name in taken:
            continue
        text.append(name)
        while name in follower:
            name, size = follower[name]
            text.append(name[size:])
    return "".join(text)


def numbers(kind, name, values):
    """A constexpr array; one dummy element if there are no values."""
    text, line = [], "   "
    for value in values or [0]:
        if len(line) + len(str(value)) > 96:
            text.append(line)
            line = "   "
        line += f" {value},"
    text.append(line)
    return f"constexpr {kind} {name}[] = {{\n" + "\n".join(text) + "\n};\n"


def literal(name, text):
    lines = [text[at:at + 80] for at in range(0, len(text), 80)]
    quoted = ['    "' + line.replace("\\", "\\\\").replace('"', '\\"') + '"' for line in lines]
    return f"constexpr char {name}[] =\n" + "\n".join(quoted) + ";\n"


def value_places(tables):
    """Storage of each table's values: the 16-bit list, the 32-bit list, or none."""
    narrow, wide, places = [], [], []
    for table in tables:
        values = [row[0] for row in table["rows"]]
        if values == list(range(values[0], values[0] + len(values))):
            places.append(("dense", values[0]))
        elif values[-1] < 1 << 16:
            places.append(("narrow", len(narrow)))
            narrow += values
        else:
            places.append(("wide", len(wide)))
            wide += values
    return narrow, wide, places


def make(sections):
    tables = [section for section in sections if not section["bits"]]
    sets = [section for section in sections if section["bits"]]
    index = {table["name"]: place for place, table in enumerate(tables, 1)}
    index["-"] = 0
    names = [row[1] for table in tables for row in table["rows"]]
    text = chained(without_parts(names + [row[2] for group in sets for row in group["rows"]]))
    if len(text) >= 1 << 16:
        raise SystemExit(f"{len(text)} letters of names, offsets of 16 bits reach 65535")

    out = ["// Made from siso_names.txt by make_siso_names.py.\n", literal("kText", text)]
    narrow, wide, places = value_places(tables)
    out.append(numbers("std::uint16_t", "kOffsets", [text.index(name) for name in names]))
    out.append(numbers("std::uint8_t", "kLengths", [len(name) for name in names]))
    out.append(numbers("std::uint16_t", "kNarrowValues", narrow))
    out.append(numbers("std::uint32_t", "kWideValues", wide))
    out.append("constexpr Table kTables[] = {\n    {0, 0, Values::dense, 0},  // none\n")
    first = 0
    for table, (kind, place) in zip(tables, places):
        out.append(f"    {{{first}, {len(table['rows'])}, Values::{kind}, {place}}},"
                   f"  // {table['name']}\n")
        first += len(table["rows"])
    out.append("};\nconstexpr BitRow kBitRows[] = {\n")
    for row in (row for group in sets for row in group["rows"]):
        out.append(f"    {{{text.index(row[2])}, {len(row[2])}, {row[0]}, {row[1]}, {index[row[3]]}}},\n")
    out.append("};\nconstexpr BitSet kBitSets[] = {\n    {0, 0, false},  // none\n")
    first = 0
    for group in sets:
        out.append(f"    {{{first}, {len(group['rows'])}, {str(group['all']).lower()}}},"
                   f"  // {group['name']}\n")
        first += len(group["rows"])
    out.append("};\n")
    for kind, group in (("SisoTable", tables), ("SisoBits", sets)):
        for place, section in enumerate(group, 1):
            out.append(f"static_assert(std::size_t({kind}::{section['name']}) == {place});\n")
        out.append(f"static_assert(std::size_t({kind}::end_) == {len(group) + 1});\n")
    return "".join(out)


def main(arguments):
    if len(arguments) != 3:
        raise SystemExit(__doc__)
    made = make(read(arguments[1]))
    with open(arguments[2], "w", encoding="ascii") as output:
        output.write(made)


if __name__ == "__main__":
    main(sys.argv)
