#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Every file of `reckon figures` can be read by others, the page needs no other file, and the
pictures of docs/thesis.md are those that the program draws now.

  figures_files.py RECKON DOCS
"""
import csv
import json
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

SVG = "{http://www.w3.org/2000/svg}"
WIDTH = 760
# Of a letter of 12 px, on the wide side [px].
LETTER = 6.6


def check_svg(path, is_drawing):
    root = xml.parse(path).getroot()
    assert root.tag == SVG + "svg", path
    texts = [text.text or "" for text in root.iter(SVG + "text")]
    assert texts[0].startswith("Fig "), (path, texts[0])
    assert is_drawing == (", drawing: " in texts[0]), (path, texts[0])
    has_unit = any(re.fullmatch(r".+ \[.+\]", text) for text in texts)
    assert is_drawing or has_unit, f"{path}: no axis has a unit"
    for text in root.iter(SVG + "text"):
        x, wide = float(text.attrib["x"]), LETTER * len(text.text or "")
        is_middle = text.attrib.get("text-anchor") == "middle" and "transform" not in text.attrib
        low, high = (x - wide / 2, x + wide / 2) if is_middle else (x, x + wide)
        is_plain = is_middle or not text.attrib.keys() - {"x", "y"}
        assert not is_plain or 0 < low and high < WIDTH, f"{path}: leaves the picture: {text.text}"
    if is_drawing:
        check_labels(root, path)
    curves = list(root.iter(SVG + "polyline"))
    assert curves, f"{path}: no curve"
    for curve in curves:
        assert len(curve.attrib["points"].split()) > 1, f"{path}: a curve of one point"


def check_labels(root, path):
    """Boxes hold their texts, and no text lies on another."""
    drawing = root.find(SVG + "g")
    places = []
    for text in drawing.iter(SVG + "text"):
        x, y, wide = float(text.attrib["x"]), float(text.attrib["y"]), LETTER * len(text.text)
        left = x - wide / 2 if "text-anchor" in text.attrib else x
        for other, a, b, c in places:
            apart = a + b < left or left + wide < a or abs(c - y) > 11
            assert apart, f"{path}: '{text.text}' lies on '{other}'"
        places.append((text.text, left, wide, y))
        for box in drawing.iter(SVG + "rect"):
            at, size = float(box.attrib["x"]), float(box.attrib["width"])
            top, tall = float(box.attrib["y"]), float(box.attrib["height"])
            if box.attrib["class"] == "n" and at < x < at + size and top < y - 4 < top + tall:
                assert at < left and left + wide < at + size, f"{path}: '{text.text}' leaves its box"


def words_and_curves(path):
    root = xml.parse(path).getroot()
    points = [curve.attrib["points"].split() for curve in root.iter(SVG + "polyline")]
    places = [tuple(map(float, point.split(","))) for curve in points for point in curve]
    return [text.text for text in root.iter(SVG + "text")], places


def check_docs(drawn, kept):
    words, places = words_and_curves(drawn)
    kept_words, kept_places = words_and_curves(kept)
    # Another processor may round a place to the next tenth of a pixel.
    same = len(places) == len(kept_places) and all(
        abs(a - b) < 0.15 for pair in zip(places, kept_places) for a, b in zip(*pair))
    assert words == kept_words and same, \
        f"{kept} is behind the code; make it anew: reckon figures"


def main(reckon, docs):
    with tempfile.TemporaryDirectory() as folder:
        command = [reckon, "figures", "--json", "--out", folder]
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        figures = [json.loads(line) for line in lines.splitlines()]
        names = [figure["name"] for figure in figures]
        assert len(names) == 30, names
        for figure in figures:
            name = figure["name"]
            check_svg(Path(folder, f"figure_{name}.svg"), figure["drawing"])
            if figure["drawing"]:
                continue
            with open(Path(folder, f"figure_{name}.csv"), newline="") as file:
                rows = list(csv.reader(file))
            assert all(len(row) == 4 for row in rows), name
            assert all(float(row[2]) >= 0 and float(row[3]) is not None for row in rows[1:]), name
        kept = sorted(Path(docs, "figures").glob("thesis_*.svg"))
        assert len(kept) == 4, kept
        for path in kept:
            check_docs(Path(folder, path.name.replace("thesis_", "figure_")), path)
        page = Path(folder, "index.html").read_text()
        for address in re.findall(r'(?:src|href)="([^"]*)"', page):
            assert address.startswith("#") or Path(folder, address).is_file(), address
        assert page.count("<svg xmlns") == len(names)
    print(f"{len(names)} figures can be read")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
