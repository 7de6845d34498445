# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the site of ./run docs: make.py ROOT HTML. A warning is an error.

Needs Debian's python3-sphinx, python3-myst-parser, furo, python3-breathe and doxygen. With ROOT/build/python, the venv of
./run python, the site has the Python module too.
"""
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys

import stage

NORMALIZE = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
# The filter indents examples as Markdown has code.
DOXYFILE = """PROJECT_NAME = Reckon
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
EXTRACT_ALL = YES
QUIET = YES
WARNINGS = NO
WARN_IF_DOC_ERROR = NO
WARN_IF_INCOMPLETE_DOC = NO
HAVE_DOT = NO
MARKDOWN_SUPPORT = YES
AUTOLINK_SUPPORT = NO
FULL_PATH_NAMES = YES
INPUT_FILTER = "sed -E 's,^( *///)   ,\\1      ,'"
"""


def simplify(xml):
    """Takes from Doxygen's XML what is private, and what breathe and Sphinx cannot read: values that are lambdas or requirements,
    partial specialisations, several exceptions of one sentence, types of C with two equal names, and equal IDs of overloads that
    differ by a concept. A file has no namespaces, which would be defined once for each."""
    for path in xml.glob("*.xml"):
        text = path.read_text(encoding="utf-8")
        if 'kind="file"' in text:
            text = re.sub(r"<innernamespace .*?</innernamespace>", "", text)
        text = re.sub(r'<sectiondef kind="private-.*?</sectiondef>', "", text, flags=re.S)
        text = re.sub(r"\s*<initializer>= *(\[\]|requires).*?</initializer>", "", text, flags=re.S)
        text = re.sub(r"<innerclass [^>]*>[^<]*&lt;.*?</innerclass>", "", text)
        text = re.sub(r'<memberdef kind="typedef"(?:(?!</memberdef>).)*?<definition>typedef struct (\w+) \1<.*?</memberdef>', "", text,
                      flags=re.S)
        text = re.sub(r"(</ref>)?</parametername>\s*<parametername>(<ref [^>]*>)?", ", ", text)
        seen = collections.Counter()

        def numbered(match):
            seen[match[1]] += 1
            return match[0] if seen[match[1]] == 1 else match[0].replace(match[1], f"{match[1]}_{seen[match[1]]}")
        path.write_text(re.sub(r'<memberdef kind="\w+" id="(\w+)"', numbered, text), encoding="utf-8")


def settle(static):
    """Mends Debian's furo for file://. Its style sheet loads a file of a web server and lacks the dark colours of the system's choice; its
    script is a module, which browsers refuse to load from a file."""
    style = static / "styles/furo.css"
    text = style.read_text(encoding="utf-8").replace("@import url(/javascript/normalize.css/normalize.css);", NORMALIZE.read_text(encoding="utf-8"))
    if "prefers-color-scheme" not in text:
        dark = re.search(r"@media not print \{\n  body\[data-theme=\"dark\"\].*?\}\s*\}\n", text, re.S)[0]
        text += dark.replace("not print", "screen and (prefers-color-scheme: dark)", 1).replace('[data-theme="dark"]', ':not([data-theme="light"])')
    style.write_text(text, encoding="utf-8")
    script, spy = static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    script.write_text(spy.read_text(encoding="utf-8") + re.sub(r"^import .*\n", "", script.read_text(encoding="utf-8")), encoding="utf-8")
    for unused in (spy, *(static / name for name in ("jquery.js", "underscore.js", "_sphinx_javascript_frameworks_compat.js"))):
        unused.unlink()


def main():
    root, html = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    work = html.with_name(html.name + ".work")
    for folder in (html, work):
        shutil.rmtree(folder, ignore_errors=True)
    site = stage.Site(root, work / "source")
    python = root / "build/python/bin/python"
    site.stage(python.exists())
    inputs = " ".join(f'"{header}"' for header in site.headers)
    (work / "Doxyfile").write_text(f"{DOXYFILE}OUTPUT_DIRECTORY = {work}\nSTRIP_FROM_PATH = {root}\nINPUT = {inputs}\n", encoding="utf-8")
    subprocess.run(["doxygen", work / "Doxyfile"], check=True)
    simplify(work / "xml")
    environment = dict(os.environ, RECKON_ROOT=str(root), RECKON_XML=str(work / "xml"), PYTHONDONTWRITEBYTECODE="1")
    done = subprocess.run([python if python.exists() else "/usr/bin/python3", "-m", "sphinx", "-W", "--keep-going", "-q", "-j", "auto", "-b", "html",
                           "-c", root / "docs/site", "-d", work / "doctrees", work / "source", html], env=environment)
    if done.returncode == 0:
        settle(html / "_static")
    sys.exit(done.returncode)


if __name__ == "__main__":
    main()
