# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the bill of materials of a build and reads it as a scanner does. sbom.py SOURCE BUILD; status 77 where Debian's tools are missing."""
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

THIRD_PARTY = "tools/viewer/page/third_party"
# Clauses 6 and 7 of SPDX 2.3; the licences are optional there.
DOCUMENT = ("spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo")
PACKAGE = ("SPDXID", "name", "versionInfo", "downloadLocation", "filesAnalyzed", "licenseDeclared", "externalRefs")


def written(source, build, out):
    return subprocess.run([sys.executable, "-B", source / "cmake/sbom.py", source, build, out, "libc6-dev"], capture_output=True, text=True)


def form_problems(bill):
    yield from (f"the document lacks {key}" for key in DOCUMENT if not bill.get(key))
    yield from (f"{package.get('name')} lacks {key}" for package in bill["packages"] for key in PACKAGE if key not in package)
    ids = [entry["SPDXID"] for entry in (bill, *bill["packages"], *bill["files"])]
    yield from (f"{one} is there twice" for one in set(ids) if ids.count(one) > 1)
    yield from (f"{one} is no SPDX identifier" for one in ids if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", one))
    for relationship in bill["relationships"]:
        if not {relationship["spdxElementId"], relationship["relatedSpdxElement"]} <= set(ids):
            yield f"{relationship} names what is not there"


def library_problems(bill, program):
    ids = {entry["relatedSpdxElement"] for entry in bill["relationships"] if entry["relationshipType"] == "DYNAMIC_LINK"}
    linked = {package["name"] for package in bill["packages"] if package["SPDXID"] in ids}
    loaded = {entry["spdxElementId"] for entry in bill["relationships"] if entry["relationshipType"] == "RUNTIME_DEPENDENCY_OF"}
    if "libarchive13" not in {package["name"] for package in bill["packages"] if package["SPDXID"] in loaded}:
        yield "libarchive13, which the programs load for compressed captures, is not in the bill"
    shown = subprocess.run(["readelf", "-dW", program], capture_output=True, text=True, check=True).stdout
    for library in re.findall(r"\(NEEDED\).*\[(.+)\]", shown):
        owners = subprocess.run(["dpkg-query", "-S", f"*/{library}"], capture_output=True, text=True).stdout
        if not linked & {line.split(":")[0] for line in owners.splitlines()}:
            yield f"{library}, which {program.name} links, is of no package of the bill"
    yield from (f"{package['name']} has no package URL of Debian with its version" for package in bill["packages"]
                if package["name"] in linked and not package["externalRefs"][0]["referenceLocator"].startswith(
                    f"pkg:deb/debian/{package['name'].replace('+', '%2B')}@"))


def digest_problems(bill, source, folder):
    listed = (source / THIRD_PARTY / "SOURCES").read_text()
    for name in ("three", "uplot"):
        if not any(f"{name} {package['versionInfo']} " in listed for package in bill["packages"] if package["name"] == name):
            yield f"{name} is not in the bill with its version"
    if len(bill["files"]) != 2:
        yield "the files are not libraries.js and the package"
    for file in bill["files"]:
        octets = ((folder if file["fileName"].endswith(".deb") else source) / file["fileName"]).read_bytes()
        yield from (f"{file['fileName']} has another {digest['algorithm']}" for digest in file["checksums"]
                    if digest["checksumValue"] != hashlib.new(digest["algorithm"].lower(), octets).hexdigest())


def main():
    source, build = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    if not all(map(shutil.which, ("dpkg-query", "readelf", "ldd"))):
        print("skipped: dpkg-query, readelf or ldd is not there")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "some.deb").write_bytes(b"octets of a package")
        result = written(source, build, folder / "bill.json")
        if result.returncode != 0:
            sys.exit(result.stderr)
        bill = json.loads((folder / "bill.json").read_text())
        problems = [*form_problems(bill), *library_problems(bill, build / "reckon"), *digest_problems(bill, source, folder)]
        # A file that is not what SOURCES lists is not listed as if it were.
        for part in ("cmake", THIRD_PARTY):
            shutil.copytree(source / part, folder / part)
        with open(folder / THIRD_PARTY / "libraries.js", "a") as file:
            file.write("// changed")
        if "is not what SOURCES lists" not in written(folder, build, folder / "bill.json").stderr:
            problems.append("a changed library of the page is listed by its old digest")
    print("\n".join(problems) or f"{len(bill['packages'])} packages and {len(bill['files'])} files")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
