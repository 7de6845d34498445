#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""`reckon bench` in a build folder without reckon-bench: on a terminal it offers to build it, else it names the command. The
folder is moved: its scenes are found beside it.

    missing_program.py RECKON RECKON-PEER
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from pseudo_terminal import Terminal  # noqa: E402

CMAKE = """#!/bin/sh
echo "cmake $*"
printf '#!/bin/sh\\necho "got: $*"\\n' > "$2/reckon-bench"
chmod +x "$2/reckon-bench"
"""


def main():
    with tempfile.TemporaryDirectory() as root:
        root = pathlib.Path(root)
        build = root / "build/release"
        tools = root / "tools"
        for folder in (build, tools, root / "scenes"):
            folder.mkdir(parents=True)
        for program in sys.argv[1:]:
            shutil.copy(program, build)
        reckon = build / "reckon"
        (tools / "cmake").write_text(CMAKE)
        (tools / "cmake").chmod(0o755)
        environment = {**os.environ, "PATH": f"{tools}:/usr/bin:/bin"}

        def said(*words):
            done = subprocess.run([reckon, *words], cwd=tools, env=environment, capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL)
            return done.returncode, done.stdout + done.stderr

        status, text = said("bench")
        assert status == 3 and "not installed: the Debian package reckon" in text, text
        (build / "CMakeCache.txt").touch()
        status, text = said("bench")
        assert status == 3 and f"cmake --build {build} --target reckon-bench builds it" in text, text
        (root / "run").write_text("")
        (root / "run").chmod(0o755)
        assert f"{root}/run build reckon-bench builds it" in said("bench")[1]
        (root / "scenes/only_here.toml").write_text('[scene]\nname = "moved"\n')
        status, text = said("scene", "check", "scenes/only_here.toml")
        assert status == 0 and str(root / "scenes/only_here.toml") in text, text

        for answer, wanted, code in (("n", "not built", 3), ("y", "got: bench scale", 0)):
            terminal = Terminal([str(reckon), "bench", "scale"], environment)
            terminal.expect("reckon-bench is not built; build it now")
            terminal.press(answer + "\n")
            seen = terminal.expect_end(drawn=False)
            assert wanted.encode() in seen and terminal.process.returncode == code, (answer, seen)
        assert f"cmake --build {build} --target reckon-bench".encode() in seen, seen
    print("good")


if __name__ == "__main__":
    main()
