# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the Debian packages of a build and looks into them. package.py BUILD; status 77 where dpkg-deb is missing."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HOLDS = {  # package: some of its files, and what none of its files may match
    "reckon": (["usr/bin/reckon", "usr/bin/reckon-peer", "usr/bin/reckon-inspect", "usr/bin/reckon-bench", "usr/share/man/man1/reckon.1.gz",
                "usr/share/man/man1/reckon-bench.1.gz", "usr/share/reckon/scenes/two_hands.toml", "usr/share/reckon/devices/falcon.toml",
                "usr/share/bash-completion/completions/reckon", "usr/lib/systemd/system/reckon-record.service",
                "usr/share/doc/reckon/copyright"], r"\.hpp$|\.a$|/docs/"),
    "reckon-dev": (["usr/include/reckon/peer/federate.hpp", "usr/lib/libreckon_peer.a", "usr/lib/pkgconfig/reckon-pdu.pc",
                    "usr/lib/cmake/reckon/reckonConfig.cmake", "usr/share/doc/reckon-dev/examples/truck.cpp", "usr/share/doc/reckon-dev/copyright"], r"usr/bin|/docs/"),
    "reckon-doc": (["usr/share/doc/reckon/README.md", "usr/share/doc/reckon/docs/README.md",
                    "usr/share/doc/reckon/docs/first_steps/programmer.md", "usr/share/doc/reckon-doc/copyright"],
                   r"usr/bin|\.hpp$"),
    "python3-reckon": (["usr/lib/python3/dist-packages/reckon/__init__.py", "usr/lib/python3/dist-packages/reckon/py.typed",
                        "usr/lib/python3/dist-packages/reckon/_pdus.pyi", "usr/share/doc/python3-reckon/copyright"],
                       r"usr/bin|\.hpp$|/docs/|__pycache__"),
}
# What lintian may say: the project has no mail address, its libraries are not in a folder by architecture, and its site has Sphinx's
# scripts, because it opens from disk anywhere.
STATED = ("bogus-mail-host", "pkg-config-unavailable-for-cross-compilation", "embedded-javascript-library")


def problems_of(package, path):
    files, never = HOLDS[package]
    listed = [line.split()[5].removeprefix("./") for line in
              subprocess.run(["dpkg-deb", "-c", path], capture_output=True, text=True, check=True).stdout.splitlines()]
    yield from (f"{package} lacks {file}" for file in files if file not in listed)
    yield from (f"{package} holds {file}" for file in listed if re.search(never, file))
    yield from (f"{package} puts {file} outside /usr" for file in listed if file and not file.startswith("usr"))
    if package == "python3-reckon":
        depends = subprocess.run(["dpkg-deb", "-f", path, "Depends"], capture_output=True, text=True, check=True).stdout
        if not re.search(r"python3 \(>= 3\.\d+~\), python3 \(<< 3\.\d+\), python3-numpy", depends):
            yield f"python3-reckon does not say which Python it is for: {depends}"
        if not any(re.search(r"/reckon/_native\.cpython-3\d+-.*\.so$", file) for file in listed):
            yield "python3-reckon holds no compiled part"
    if package == "reckon":
        depends = subprocess.run(["dpkg-deb", "-f", path, "Depends"], capture_output=True, text=True, check=True).stdout
        yield from (f"reckon depends on a development package: {name}" for name in re.findall(r"\S+-dev\b", depends))
        if "libarchive13" not in depends:
            yield f"reckon does not depend on the library that it loads for compressed captures: {depends}"
        if "libc6" not in depends:
            yield f"reckon does not say what it depends on: {depends}"
    if shutil.which("lintian"):
        said = subprocess.run(["lintian", path], capture_output=True, text=True).stdout
        yield from (line for line in said.splitlines() if not any(tag in line for tag in STATED))


def with_site(build):
    """The site of ./run docs is in reckon-doc where it was made."""
    if (build.parent / "docs/index.html").exists():
        HOLDS["reckon-doc"][0].extend(f"usr/share/doc/reckon/html/{file}" for file in ("index.html", "searchindex.js", "docs/viewer.html"))


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    if not shutil.which("dpkg-deb") or not shutil.which("dpkg-shlibdeps") or not (build / "CPackConfig.cmake").exists():
        print("skipped: dpkg-deb, dpkg-shlibdeps or CPackConfig.cmake is not there")
        sys.exit(77)
    with_site(build)
    if not shutil.which("lintian"):
        print("lintian is not there and says nothing")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["cpack", "--config", build / "CPackConfig.cmake", "-B", folder], cwd=build, check=True,
                       stdout=subprocess.DEVNULL)
        made = {path.name.split("_")[0]: path for path in pathlib.Path(folder).glob("*.deb")}
        with_python = (build / "python/reckon/_pdus.pyi").exists()
        problems = [f"no package {package}" for package in HOLDS
                    if package not in made and (with_python or package != "python3-reckon")]
        for package, path in made.items():
            problems += problems_of(package, path)
    print("\n".join(problems) or f"{len(made)} packages hold what they are to hold")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
