# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Sphinx's settings for the site, see make.py."""
import os
import pathlib
import re
import sys

import furo
from sphinx.domains.cpp import CPPDomain

ROOT = pathlib.Path(os.environ["RECKON_ROOT"])
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import stage  # noqa: E402

project = "Reckon"
release = re.search(r"project\(reckon VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
author = copyright = "The Reckon authors"
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
myst_heading_anchors = 6
breathe_projects = {"reckon": os.environ["RECKON_XML"]}
breathe_default_project = "reckon"
breathe_show_include = False
autodoc_member_order = "bysource"  # functions and federates, then the PDUs
html_theme = "furo"
html_title = f"Reckon {release}"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_show_search_summary = False  # reads pages by requests, which file:// refuses
# Code is shown as it stands, without hints about what a lexer does not know.
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]


def write_links_for_the_site(app, docname, source):
    """Links to files and folders outside the site go to their generated pages."""
    page = pathlib.PurePosixPath("README.md" if docname == "index" else f"{docname}.md")
    if not (ROOT / page).exists():
        return

    def written(match):
        target, anchor = match[1], match[2] or ""
        path = (ROOT / page.parent / target).resolve()
        if "://" in target or not path.exists():
            return match[0]
        up = "../" * (len(page.parts) - 1)
        name = path.relative_to(ROOT).as_posix()
        if name == "README.md":
            return f"]({up}index.md{anchor})"
        if (pathlib.Path(app.srcdir) / "files" / f"{name}.rst").exists():
            return f"]({up}files/{name}.rst)"
        return match[0]

    source[0] = stage.LINK.sub(written, source[0])
    if docname == "index":
        source[0] += "\n```{eval-rst}\n" + (pathlib.Path(app.srcdir) / "contents.txt").read_text(encoding="utf-8") + "```\n"


def leave_out_jquery(app, pagename, templatename, context, doctree):
    """No script of the theme, nor the search, needs it."""
    context["script_files"] = [file for file in context["script_files"] if not re.search("jquery|underscore|frameworks_compat", file)]


def write_docstring(app, what, name, obj, options, lines):
    """Docstrings are plain text: marks of reStructuredText mean themselves, and what is indented behind an empty line is code."""
    result, code = [], False
    for line in lines:
        indented = line.startswith("    ")
        if indented and not code and (not result or not result[-1].strip()):
            result += ["::", ""]
            code = True
        code = code and (indented or not line.strip())
        result.append(line if code else stage.literal(line.strip()))
    fields = getattr(obj, "__slots__", ()) if what == "class" else ()
    if fields and not fields[0].startswith("_"):
        result += ["", "Fields: " + ", ".join(f"``{field}``" for field in fields)]
    lines[:] = result


def leave_out_parameters(objects):
    """The search finds classes, functions and members, not their parameters."""
    return lambda domain: (found for found in objects(domain) if not found[2].endswith("Param"))


def share_navigation(compute):
    """Pages that the contents do not list have one navigation for each depth of folders. Furo computes it anew for each page."""
    known = {}

    def shared(context):
        name = context["pagename"]
        if not re.match("files/|api/.*/", name):
            return compute(context)
        depth = name.count("/")
        if depth not in known:
            known[depth] = compute(context)
        return known[depth]
    return shared


def setup(app):
    furo._compute_navigation_tree = share_navigation(furo._compute_navigation_tree)
    CPPDomain.get_objects = leave_out_parameters(CPPDomain.get_objects)
    app.connect("autodoc-process-docstring", write_docstring)
    app.connect("html-page-context", leave_out_jquery)
    app.connect("source-read", write_links_for_the_site)
