# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the bill of materials of a build as SPDX 2.3 in JSON: the project, the Debian packages whose libraries the programs link, those
that the build needs, the libraries of the page, and the .deb files beside OUT. For ./run package, on Debian.

  sbom.py SOURCE BUILD OUT [PACKAGE..]      PACKAGE: Debian packages that the build needs
"""
import base64
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time
import uuid
from urllib.parse import quote

# Short names of Debian's copyright files that mean a licence of the SPDX list; any other name gives NOASSERTION.
LICENCES = {"expat": "MIT", "isc": "ISC", "boost": "BSL-1.0", "mpl-2": "MPL-2.0", "apache-2.0": "Apache-2.0", "zlib": "Zlib",
            "bsd-2-clause": "BSD-2-Clause", "bsd-3-clause": "BSD-3-Clause", "gpl-2": "GPL-2.0-only", "gpl-2+": "GPL-2.0-or-later",
            "gpl-3+": "GPL-3.0-or-later", "lgpl-2.1": "LGPL-2.1-only", "lgpl-2.1+": "LGPL-2.1-or-later"}


def output(*command):
    result = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    if result.returncode != 0:
        sys.exit(f"{command[0]} failed, {result.stderr.strip()}; ./run packages installs what is missing")
    return result.stdout


# Debian packages of libraries that the programs load when they need them.
LOADED = ("libarchive13",)


def spdx_id(kind, name):
    return f"SPDXRef-{kind}-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def programs(build):
    return [path for path in (*(build / name for name in ("reckon", "reckon-peer", "reckon-inspect", "reckon-bench")), *build.glob("python/reckon/_native*.so")) if path.exists()]


def linked_packages(program):
    """Debian packages of the libraries that a program names itself."""
    needed = re.findall(r"\(NEEDED\).*\[(.+)\]", output("readelf", "-dW", program))
    paths = {path.rpartition("/")[2]: path for path in re.findall(r"(/\S+) \(0x", output("ldd", program))}
    for library in needed:
        merged = "/" + paths[library].lstrip("/").removeprefix("usr/")  # dpkg knows files by /lib or by /usr/lib
        found = subprocess.run(["dpkg-query", "-S", merged, "/usr" + merged], capture_output=True, text=True).stdout
        if not found:
            sys.exit(f"{paths[library]}, which {program.name} links, is of no Debian package: install Debian's, and build anew")
        yield found.split(":")[0]


def declared_licence(package):
    """The licence of "Files: *" in a machine-readable copyright file, as an SPDX expression."""
    file = pathlib.Path("/usr/share/doc", package, "copyright")
    text = file.read_text(errors="replace") if file.exists() else ""
    named = re.search(r"^Files:\s*\*\s*$(?:\n(?!\s*$).*)*?\nLicense:[ \t]*(.+)$", text, re.M)
    if not text.startswith("Format:") or not named:
        return "NOASSERTION"
    terms = re.split(r"\s+(or|and)\s+", named[1].strip().lower())
    licences = [LICENCES.get(term) for term in terms[::2]]
    if None in licences or len(set(terms[1::2])) > 1:
        return "NOASSERTION"
    return (f" {terms[1].upper()} " if terms[1:] else "").join(licences)


def package_entry(name, version, kind, purl, licence, **more):
    return {"SPDXID": spdx_id(kind, name), "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": licence, "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}], **more}


def debian_entry(name):
    version, architecture, supplier = output("dpkg-query", "-W", "-f", "${Version}\n${Architecture}\n${Maintainer}\n", name).splitlines()[:3]
    purl = f"pkg:deb/debian/{quote(name)}@{quote(version, safe='')}?arch={architecture}"
    return package_entry(name, version, "deb", purl, declared_licence(name), supplier=f"Organization: {supplier.split(' <')[0]}")


def page_entries(folder):
    """What SOURCES lists: npm packages by the digest of their archive, and files by their own."""
    lock = json.loads((folder / "package-lock.json").read_text())["packages"]
    for name, version, digest in (line.split() for line in (folder / "SOURCES").read_text().splitlines()):
        if version == "sha256":
            if hashlib.sha256((folder / name).read_bytes()).hexdigest() != digest:
                sys.exit(f"{folder / name} is not what SOURCES lists: node make.mjs in that folder makes both")
            continue
        value = base64.b64decode(digest.removeprefix("sha512-")).hex()
        yield package_entry(name, version, "npm", f"pkg:npm/{name}@{version}", lock[f"node_modules/{name}"]["license"],
                            checksums=[{"algorithm": "SHA512", "checksumValue": value}])


def file_entry(path, shown, licence):
    octets = path.read_bytes()
    return {"SPDXID": spdx_id("file", path.name), "fileName": f"./{shown}", "licenseConcluded": licence, "copyrightText": "NOASSERTION",
            "checksums": [{"algorithm": name.upper(), "checksumValue": hashlib.new(name, octets).hexdigest()} for name in ("sha1", "sha256")]}


def document(source, build, out, build_packages):
    version = re.search(r"^CMAKE_PROJECT_VERSION:\w+=(.+)$", (build / "CMakeCache.txt").read_text(), re.M)[1]
    ours = package_entry("reckon", version, "project", f"pkg:generic/reckon@{version}", "Apache-2.0",
                         supplier="Organization: The Reckon authors", primaryPackagePurpose="APPLICATION")
    linked = sorted({package for program in programs(build) for package in linked_packages(program)})
    needed = sorted({name for name in build_packages if name not in {*linked, *LOADED}})
    third_party = source / "tools/viewer/page/third_party"
    page = list(page_entries(third_party))
    libraries = file_entry(third_party / "libraries.js", "tools/viewer/page/third_party/libraries.js", "MIT")
    debs = [file_entry(path, path.name, "Apache-2.0") for path in sorted(out.parent.glob("*.deb"))]
    triples = [("SPDXRef-DOCUMENT", "DESCRIBES", ours["SPDXID"]), (ours["SPDXID"], "DEPENDS_ON", libraries["SPDXID"])]
    triples += [(ours["SPDXID"], "DYNAMIC_LINK", spdx_id("deb", name)) for name in linked]
    triples += [(spdx_id("deb", name), "RUNTIME_DEPENDENCY_OF", ours["SPDXID"]) for name in LOADED]
    triples += [(spdx_id("deb", name), "BUILD_DEPENDENCY_OF", ours["SPDXID"]) for name in needed]
    triples += [(entry["SPDXID"], "BUILD_TOOL_OF", libraries["SPDXID"]) if entry["name"] == "esbuild" else
                (libraries["SPDXID"], "GENERATED_FROM", entry["SPDXID"]) for entry in page]
    triples += [(entry["SPDXID"], "GENERATED_FROM", ours["SPDXID"]) for entry in debs]
    body = {"packages": [ours, *map(debian_entry, [*linked, *LOADED, *needed]), *page], "files": [libraries, *debs],
            "relationships": [{"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other} for one, kind, other in triples]}
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
    content = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(body))
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"reckon-{version}",
            "documentNamespace": f"https://spdx.org/spdxdocs/reckon-{version}-{content}",
            "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds)), "creators": ["Tool: reckon-sbom"]}, **body}


def main():
    source, build, out = map(pathlib.Path, sys.argv[1:4])
    out.write_text(json.dumps(document(source, build, out, sys.argv[4:]), indent=1) + "\n")


if __name__ == "__main__":
    main()
