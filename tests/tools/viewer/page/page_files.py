# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the files of the viewer's page against what they promise.

  page_files.py PAGE            status 1, and a line for each fault; PAGE is tools/viewer/page
  page_files.py PAGE --planted  plants a fault of each kind, in memory, and wants each to be found

  libraries  third_party/libraries.js is the file that SOURCES names, and has its licences beside it
  forbidden  nothing that runs text as code, writes markup or carries a style attribute, which the page's policy refuses
  bundle     imports and exports of the form that a saved page joins to one script, no name twice
  listed     each plot_*.js stands in plot_list.js, each drawn_*.js in drawn_list.js, by import and by row
  replaced   index.html has the places where a saved page puts its parts, each once
  size       at most 700 kB, 220 kB compressed
"""
import gzip
import hashlib
import re
import sys
from pathlib import Path

MOST_OCTETS = 700_000
MOST_COMPRESSED = 220_000
LIBRARIES = "third_party/libraries.js"
FORBIDDEN = {
    r"innerHTML|outerHTML|insertAdjacentHTML|document\.write": "text is written as markup",
    r"\beval\s*\(|new\s+Function|setTimeout\(\s*['\"`]": "text runs as code",
    r"\sstyle\s*=\s*[\"']|setAttribute\(\s*['\"]style": "a style attribute",
    r"\son[a-z]+\s*=\s*[\"']": "a handler in markup",
    r"https?://": "an address elsewhere",
}
IMPORT = re.compile(r"import \{ [\w, ]+ \} from '\./[a-z0-9_]+\.js';")
EXPORT = re.compile(r"export (async function|function|class|const) [\w{]")
NAMED = re.compile(r"(?:export )?(?:async )?(?:const|let|var|function|class) ([A-Za-z_$][\w$]*)")
PLACES = ['<link rel="stylesheet" href="page.css">', '<script type="module" src="main.js"></script>', "<title>Reckon</title>"]


def read(page):
    files = {path.name: path.read_bytes() for path in sorted(page.iterdir()) if path.suffix in (".js", ".css", ".html")}
    for path in sorted((page / "third_party").iterdir()):
        if path.is_file():
            files[f"third_party/{path.name}"] = path.read_bytes()
    return files


def check_libraries(files):
    sources = files.get("third_party/SOURCES", b"").decode()
    digest = hashlib.sha256(files[LIBRARIES]).hexdigest()
    if f"libraries.js sha256 {digest}\n" not in sources:
        yield "libraries", f"{LIBRARIES} is not the file of SOURCES: run make.mjs again"
    for name in ("three", "uplot", "esbuild"):
        if not re.search(rf"^{name} \d+\.\d+\.\d+ sha512-\S+$", sources, re.M):
            yield "libraries", f"SOURCES has no version and integrity of {name}"
    for name in ("LICENSE-three", "LICENSE-uplot"):
        if f"third_party/{name}" not in files:
            yield "libraries", f"third_party/{name} is missing"


def own(files):
    return {name: text.decode() for name, text in files.items() if "/" not in name}


def check_forbidden(files):
    for name, text in own(files).items():
        for number, line in enumerate(text.splitlines(), 1):
            for pattern, what in FORBIDDEN.items():
                if re.search(pattern, line):
                    yield "forbidden", f"{name}:{number}: {what}"


def top_level_names(files):
    for name, text in own(files).items():
        if name.endswith(".js"):
            for line in text.splitlines():
                if found := NAMED.match(line):
                    yield found[1], name
    for name in re.findall(r"^export const \{ (.*) \} = reckonLibraries;$", files[LIBRARIES].decode(), re.M)[-1].split(", "):
        yield name, LIBRARIES


def check_bundle(files):
    for name, text in {**own(files), LIBRARIES: files[LIBRARIES].decode()}.items():
        if not name.endswith(".js"):
            continue
        if "</script" in text or "<!--" in text:
            yield "bundle", f"{name} would end the script that it stands in"
        for number, line in enumerate(text.splitlines(), 1):
            if line.startswith("import") and not IMPORT.fullmatch(line):
                yield "bundle", f"{name}:{number}: write import {{ a, b }} from './name.js'; on one line"
            if line.startswith("export") and not EXPORT.match(line):
                yield "bundle", f"{name}:{number}: export a declaration"
            if found := re.match(r"import .* from '\./(\w+\.js)'", line):
                if found[1] not in files and found[1] != "libraries.js":
                    yield "bundle", f"{name}:{number}: there is no {found[1]}"
    first = {}
    for name, file in top_level_names(files):
        if name in first:
            yield "bundle", f"{file} and {first[name]} both have {name} at their top level"
        first.setdefault(name, file)


def check_listed(files):
    for kind in ("plot", "drawn"):
        rows = files[f"{kind}_list.js"].decode()
        for name in own(files):
            if name.startswith(f"{kind}_") and name != f"{kind}_list.js":
                said = kind + "".join(word.capitalize() for word in name[len(kind) + 1:-3].split("_"))
                if f"from './{name}'" not in rows or not re.search(rf"\[[^]]*\b{said}\b", rows.split("export const", 1)[1]):
                    yield "listed", f"{name}: {kind}_list.js has no import or no row of {said}"


def check_replaced(files):
    html = files["index.html"].decode()
    for place in PLACES:
        if html.count(place) != 1:
            yield "replaced", f"index.html has {place} {html.count(place)} times"


def check_size(files):
    served = {name: text for name, text in files.items() if "/" not in name or name == LIBRARIES}
    octets = sum(map(len, served.values()))
    compressed = sum(len(gzip.compress(text, 9)) for text in served.values())
    print(f"page: {octets} octets, {compressed} compressed, {len(served)} files")
    if octets > MOST_OCTETS:
        yield "size", f"{octets} octets are more than {MOST_OCTETS}"
    if compressed > MOST_COMPRESSED:
        yield "size", f"{compressed} compressed octets are more than {MOST_COMPRESSED}"


CHECKS = [check_libraries, check_forbidden, check_bundle, check_listed, check_replaced, check_size]


def faults(files):
    return [fault for check in CHECKS for fault in check(files)]


def planted(files):
    """Each single fault, and the expected message."""
    def changed(name, change):
        return {**files, name: change(files[name])}
    main = "main.js"
    yield "libraries", changed(LIBRARIES, lambda text: text + b"\n")
    yield "libraries", {name: text for name, text in files.items() if name != "third_party/LICENSE-three"}
    for line in (b"host.innerHTML = text;", b"eval(text);", b"new Function(text);", b"fetch('https://example.org');"):
        yield "forbidden", changed(main, lambda text, line=line: text + line + b"\n")
    yield "forbidden", changed("index.html", lambda text: text.replace(b"<main ", b'<main style="color: red" '))
    yield "bundle", changed(main, lambda text: text + b"import x from './words.js';\n")
    yield "bundle", changed(main, lambda text: text + b"import { x } from './none.js';\n")
    yield "bundle", changed(main, lambda text: text + b"export default 1;\n")
    yield "bundle", changed(main, lambda text: text + b"const Mesh = 1;\n")
    yield "bundle", changed(main, lambda text: text + b"const end = '</script>';\n")
    yield "listed", {**files, "plot_more.js": b"export const plotMore = {};\n"}
    yield "listed", changed("drawn_list.js", lambda text: text.replace(b"drawnFloor, ", b""))
    yield "replaced", changed("index.html", lambda text: text.replace(b"main.js", b"./main.js"))
    yield "size", changed(main, lambda text: text + b"//" + b"x" * MOST_OCTETS)


def main(arguments):
    files = read(Path(arguments[0]))
    if arguments[1:] == ["--planted"]:
        missed = [kind for kind, broken in planted(files) if kind not in {name for name, _ in faults(broken)}]
        print(f"not found: {missed}" if missed else "each planted fault is found")
        return 1 if missed else 0
    found = faults(files)
    for kind, text in found:
        print(f"{kind}: {text}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
