#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Draws the rooms of each folder, from the include lines of the code itself:

    python3 docs/figures/make_rooms.py            writes rooms.svg beside this file
    python3 docs/figures/make_rooms.py --check    status 1 where the picture is behind the code

A box is a room, its README.md shows where the mouse rests; an arrow points at what is known. What follows from other arrows is left
out. The door of a folder, which knows all its rooms, is not drawn. Standard library only.
"""
import importlib.util
import pathlib
import sys
from html import escape

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# From the top down, panels of one row side by side.
SHEET = [["pdu"], ["deadreckon", "haptics", "src"], ["tools", "tools/inspect", "tools/viewer"], ["bench", "bench/studies"], ["python"]]
FILL = {"pdu": "#dbeafe", "deadreckon": "#ffedd5", "haptics": "#ffedd5", "src": "#ede9fe", "tools": "#eceff1", "bench": "#fef9c3", "python": "#dcfce7"}
ROW, BOX, GAP, MARGIN, HEAD = 78, 36, 20, 20, 52


def layering():
    spec = importlib.util.spec_from_file_location("layering", ROOT / "tests/layering.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def rooms_of(arrows, parent, folders):
    """Rooms directly in `parent`, each with the others of them that it knows."""
    def room(folder):
        if not folder.startswith(parent + "/"):
            return None
        return parent + "/" + folder[len(parent) + 1:].split("/")[0]

    knows = {room(folder): set() for folder in folders if room(folder)}
    for one, others in arrows.items():
        for other in others:
            if room(one) and room(other) and room(one) != room(other):
                knows[room(one)].add(room(other))
    return knows


def reach(knows, start):
    seen, todo = set(), list(knows[start])
    while todo:
        room = todo.pop()
        if room not in seen:
            seen.add(room)
            todo += knows[room]
    return seen


def reduced(knows):
    """Without the arrows that follow from others."""
    far = {room: reach(knows, room) for room in knows}
    return {room: {other for other in others if not any(other in far[via] for via in others)}
            for room, others in knows.items()}


def ranks_of(knows):
    """0 for what knows nothing, else one above the highest that it knows."""
    rank = {}

    def height(room):
        if room not in rank:
            rank[room] = 1 + max((height(other) for other in knows[room]), default=-1)
        return rank[room]

    for room in sorted(knows):
        height(room)
    return rank


def layered(knows, width_of):
    """Rows of nodes from the top down, and edges of nodes one row apart; an arrow over several rows goes by a node without a name
    in each row between."""
    rank = ranks_of(knows)
    top = max(rank.values())
    rows = [[] for _ in range(top + 1)]
    for room in sorted(knows):
        rows[top - rank[room]].append(room)
    edges = []
    for room in sorted(knows):
        for other in sorted(knows[room]):
            way = [room]
            for row in range(top - rank[room] + 1, top - rank[other]):
                via = (room, other, row)
                rows[row].append(via)
                way.append(via)
            edges.append(way + [other])
    steps = [pair for way in edges for pair in zip(way, way[1:])]
    for sweep in range(12):
        order = {node: i / max(len(row) - 1, 1) for row in rows for i, node in enumerate(row)}
        for row in rows if sweep % 2 else rows[::-1]:
            def middle(node):
                near = [order[b] for a, b in steps if a == node] + [order[a] for a, b in steps if b == node]
                return (sum(near) / len(near) if near else 0.5, str(node))
            row.sort(key=middle)
            order.update({node: i / max(len(row) - 1, 1) for i, node in enumerate(row)})
    widest = max(sum(width_of(node) + GAP for node in row) - GAP for row in rows)
    place = {}
    for i, row in enumerate(rows):
        spare = (widest - sum(width_of(node) for node in row)) / (len(row) + 1)
        x = spare
        for node in row:
            place[node] = (x + width_of(node) / 2, i * ROW)
            x += width_of(node) + spare
    return rows, edges, place, widest


def panel(files, parent, knows, x0, y0, fill):
    names = {room: room[len(parent) + 1:] for room in knows}

    def width_of(node):
        return 9 * len(names[node]) + 22 if isinstance(node, str) else 6

    rows, edges, place, widest = layered(reduced(knows), width_of)
    out = [f'<text x="{x0:.0f}" y="{y0 + 16}" font-weight="bold">{parent}/</text>']
    top = y0 + 30
    for way in edges:
        points = [place[node] for node in way]
        start, end = points[0], points[-1]
        data = f"M{x0 + start[0]:.0f} {top + start[1] + BOX}"
        last = (start[0], start[1] + BOX)
        for x, y in points[1:-1] + [(end[0], end[1] - 2)]:
            bend = (y - last[1]) / 2
            data += (f" C{x0 + last[0]:.0f} {top + last[1] + bend:.0f} {x0 + x:.0f} {top + y - bend:.0f} "
                     f"{x0 + x:.0f} {top + y:.0f}")
            last = (x, y)
        out.append(f'<path d="{data}" fill="none" stroke="#37474f" stroke-width="1.4" marker-end="url(#a)"/>')
    for room in sorted(knows):
        x, y = place[room]
        width = width_of(room)
        sign = files[f"{room}/README.md"].split("\n")[2]
        out.append(f'<g><title>{escape(sign)}</title><rect x="{x0 + x - width / 2:.0f}" y="{top + y}" width="{width}" '
                   f'height="{BOX}" rx="7" fill="{fill}" stroke="#546e7a" stroke-width="1.5"/><text x="{x0 + x:.0f}" '
                   f'y="{top + y + 23}" text-anchor="middle">{names[room]}</text></g>')
    return out, widest, 30 + (len(rows) - 1) * ROW + BOX


def picture(files, arrows):
    folders = {path.rsplit("/", 1)[0] for path in files if path.endswith((".cpp", ".hpp"))}
    out, y, width = [], HEAD, 0
    for row in SHEET:
        x, highest = MARGIN, 0
        for parent in row:
            knows = rooms_of(arrows, parent, folders)
            lines, wide, high = panel(files, parent, knows, x, y, FILL[parent.split("/")[0]])
            out += lines
            x += wide + 60
            highest = max(highest, high)
        width = max(width, x - 60 + MARGIN)
        y += highest + 34
    height = y - 34 + MARGIN
    title = "Rooms of Reckon: an arrow points at what is known"
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height}" width="{width:.0f}" height="{height}" '
        'font-family="DejaVu Sans, Verdana, sans-serif" font-size="14" fill="#1c2b33">',
        "<!-- SPDX-FileCopyrightText: 2026 The Reckon authors -->",
        "<!-- SPDX-License-Identifier: Apache-2.0 -->",
        f"<title>{title}</title>",
        '<defs><marker id="a" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
        'orient="auto-start-reverse"><path d="M0 0L10 5L0 10z" fill="#37474f"/></marker></defs>',
        f'<rect width="{width:.0f}" height="{height}" fill="#ffffff"/>',
        f'<text x="{MARGIN}" y="30" font-size="15" font-weight="bold">{title}</text>',
        *out, "</svg>", ""])


def main(arguments):
    rules = layering()
    files = rules.read(ROOT)
    text = picture(files, rules.arrows_of(files))
    path = HERE / "rooms.svg"
    if "--check" not in arguments:
        path.write_text(text, encoding="utf-8")
    elif not path.exists() or path.read_text(encoding="utf-8") != text:
        print("docs/figures/rooms.svg is behind the code; draw it anew: python3 docs/figures/make_rooms.py")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
