# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Lays out the sources of the site for Sphinx: links to the Markdown files, and generated pages for the rest.

The generated pages are the table of contents (from the map of docs/README.md), one page for the public headers of each room, one for
the Python module, one for each folder and each file of text that a page links to.
"""
import os
import pathlib
import re

COMPONENTS = {"pdu": "pdu", "deadreckon": "deadreckon", "aoim": "aoim", "haptics": "haptics", "src": "peer"}
# What these include is the interface too: PDUs, and what a program hands to a federate or gets from it.
SHOWN = {"pdu_types.hpp", "federate.hpp", "federate_options.hpp", "wire_conversion.hpp"}
LINK = re.compile(r"(?<!!)\]\(([^)\s#]+)(#[^)\s]*)?\)")
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".h": "cpp", ".c": "c", ".ino": "cpp", ".py": "python", ".lua": "lua", ".xml": "xml",
             ".toml": "toml", ".sh": "bash"}


def markdown_pages(root):
    return [*sorted(root.glob("*.md")), *sorted((root / "docs").rglob("*.md"))]


def public_headers(root):
    """{folder: headers}: those directly in the folder, those that it lists as PUBLIC, and the types that headers of SHOWN include."""
    result = {}
    for folder, component in COMPONENTS.items():
        listed = re.findall(r"\bPUBLIC\s+((?:[\w/.]+\.hp?p?\s+)+)", (root / folder / "CMakeLists.txt").read_text(encoding="utf-8"))
        doors = {path.name for path in (root / folder).glob("*.hpp")} | {name for block in listed for name in block.split()}
        texts = [(root / folder / door).read_text(encoding="utf-8") for door in doors if door in SHOWN]
        included = {name for text in texts for name in re.findall(rf'#include "reckon/{component}/([^"]+)"', text)}
        result[folder] = sorted(doors | included)
    return result


def introduction(header):
    """The comment at the top of a header, without its licence."""
    lines = header.read_text(encoding="utf-8").split("#pragma once")[0].split("#ifndef")[0].splitlines()
    return " ".join(line[2:].strip() for line in lines if line.startswith("//") and "SPDX" not in line)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def titled(title, text):
    return f"{title}\n{'=' * len(title)}\n\n{text}\n"


def toctree(entries, caption="", hidden=False):
    options = (f"   :caption: {caption}\n" if caption else "") + ("   :hidden:\n" if hidden else "   :maxdepth: 1\n")
    return ".. toctree::\n" + options + "\n" + "".join(f"   {entry}\n" for entry in entries) + "\n"


def literal(text):
    """Plain text as reStructuredText; what is between backticks is code."""
    parts = text.split("`")
    if len(parts) % 2 == 0:
        return re.sub(r"([\\*`|_])", r"\\\1", text)
    return "".join(f"``{part}``" if place % 2 and part.strip() == part != "" else re.sub(r"([\\*|_])", r"\\\1", part)
                   for place, part in enumerate(parts))


class Site:
    def __init__(self, root, source):
        self._root, self._source = root, source
        self._pages = markdown_pages(root)

    def stage(self, with_python):
        for page in [*self._pages, *(self._root / "docs/figures").glob("*.*g")]:
            link = self._source / page.relative_to(self._root)
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(page)
        (self._source / "index.md").symlink_to(self._root / "README.md")
        (self._source / "README.md").unlink()
        self._write_linked()
        self._write_headers()
        if with_python:
            write(self._source / "api/python.rst", titled("Python module", ".. automodule:: reckon\n   :members:\n   :imported-members:\n"))
        write(self._source / "contents.txt", self._contents(with_python))

    def _write_linked(self):
        """Pages for folders and files outside the site that pages link to."""
        linked = {(page.parent / target).resolve() for page in self._pages for target, _ in LINK.findall(page.read_text(encoding="utf-8"))
                  if "://" not in target}
        for path in sorted(linked - set(self._pages)):
            if not path.is_relative_to(self._root) or not path.exists():
                continue
            name = path.relative_to(self._root).as_posix()
            page = self._source / "files" / f"{name}.rst"
            if path.suffix in (".svg", ".png"):
                continue
            if path.is_dir():
                inside = [page.stem for page in self._pages if page.parent == path]
                listing = toctree([f"/{name}/{stem}" for stem in inside]) if inside else "::\n\n" + "".join(
                    f"   {entry.name}\n" for entry in sorted(path.iterdir()))
                write(page, ":orphan:\n\n" + titled(literal(name) + "/", listing))
            else:
                include = f".. literalinclude:: {os.path.relpath(path, page.parent)}\n   :language: {LANGUAGES.get(path.suffix, 'text')}\n"
                write(page, ":orphan:\n\n" + titled(literal(name), include))

    def _write_headers(self):
        """A page for each room, and for the headers directly in the folder, the door."""
        self.headers, components = [], []
        for folder, names in public_headers(self._root).items():
            component = COMPONENTS[folder]
            rooms = {"": []}
            for name in names:
                rooms.setdefault(name.rpartition("/")[0], []).append(name)
            entries = []
            for room, headers in rooms.items():
                path = "/".join(filter(None, ["reckon", component, room]))
                sections = [self._header(folder, component, name) for name in headers]
                if sections:
                    page = f"{component}/{room or 'door'}"
                    entries.append(f"* :doc:`{path} <{page}>`: " + ", ".join(name.rpartition("/")[2] for name in headers) + "\n")
                    write(self._source / f"api/{page}.rst", ":orphan:\n\n" + titled(literal(path), "\n".join(sections)))
            write(self._source / f"api/{component}.rst", titled(f"reckon::{component}", "".join(entries)))
            components.append(component)
        write(self._source / "api/index.rst", titled("C++ headers", toctree(components)))

    def _header(self, folder, component, name):
        self.headers.append(self._root / folder / name)
        heading = literal(f"{component}/{name}")
        return (f"{heading}\n{'-' * len(heading)}\n\n{literal(introduction(self.headers[-1]))}\n\n"
                f".. doxygenfile:: {folder}/{name}\n")

    def _contents(self, with_python):
        """Tables of contents: the sections of docs/README.md, then pages that it does not name, then the API."""
        listed, result = {"README", "docs/README"}, toctree(["docs/README"], hidden=True)
        for section in (self._root / "docs/README.md").read_text(encoding="utf-8").split("\n## ")[1:]:
            entries = []
            for target, _ in LINK.findall(section):
                page = (self._root / "docs" / target).resolve()
                name = page.relative_to(self._root).with_suffix("").as_posix() if page in self._pages else None
                if name and name not in listed:
                    listed.add(name)
                    entries.append(name)
            result += toctree(entries, section.split("\n")[0].strip(), hidden=True) if entries else ""
        others = [name for page in self._pages if (name := page.relative_to(self._root).with_suffix("").as_posix()) not in listed]
        result += toctree(others, "More", hidden=True) if others else ""
        return result + toctree(["api/index", *(["api/python"] if with_python else [])], "Interfaces", hidden=True)
