# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the container image of a build and runs its programs. container.py ROOT BUILD; status 77 without mmdebstrap, buildah,
dpkg-shlibdeps or Debian's mirror."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.request

MIRROR = "http://deb.debian.org/debian/dists/stable/Release"


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)


def main():
    root, build = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    for program in ("mmdebstrap", "buildah", "dpkg-shlibdeps"):
        if not shutil.which(program):
            skip(f"{program} is missing")
    try:
        urllib.request.urlopen(MIRROR, timeout=10).close()
    except OSError as error:
        skip(f"{MIRROR}: {error}")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([root / "cmake/container.sh", build, folder], check=True)
        buildah = ["buildah", "--root", f"{folder}/loaded", "--runroot", f"{folder}/loaded/run", "--storage-driver", "vfs"]

        def run(*words):
            return subprocess.run([*buildah, *words], capture_output=True, text=True)

        name = run("from", "--quiet", f"docker-archive:{folder}/reckon.tar").stdout.strip()
        for words, wanted in ((["--version"], "reckon 0."), (["scene", "check", "scenes/two_hands.toml"], ": good"),
                              (["inspect", "scenes/exercise.pcapng", "stats"], "entity_state"),
                              (["demo", "--simulated-time", "--for", "1s"], "packets")):
            done = run("run", "--isolation", "chroot", name, "--", "/usr/bin/reckon", *words)
            if wanted not in done.stdout:
                sys.exit(f"reckon {' '.join(words)} in the image: {done.stdout}{done.stderr}")
        run("rm", name)
        run("rmi", "--all", "--force")
    print("the image runs")


if __name__ == "__main__":
    main()
