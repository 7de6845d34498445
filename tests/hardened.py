# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Programs are hardened as RECKON_HARDENED says. hardened.py PROGRAM.. or --planted COMPILER; status 77 where readelf is missing."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

WANTED = {  # what readelf shows of a hardened program
    "late binding is on: no BIND_NOW": r"\(FLAGS\).*BIND_NOW|\(FLAGS_1\).*\bNOW\b",
    "no part becomes read-only: no GNU_RELRO": r"GNU_RELRO",
    "no stack protector: no __stack_chk_fail": r"__stack_chk_fail",
    "no checked call of the C library: no function .._chk": r"UND __(?!stack)\w+_chk\b",
    "no position-independent program": r"Type:\s+DYN",
    "the stack can be executed": r"GNU_STACK.* RW ",
}
FLAGS = ["-O1", "-fstack-protector-strong", "-D_FORTIFY_SOURCE=2", "-Wl,-z,relro,-z,now", "-fPIE", "-pie"]
OPPOSITE = ["-O0", "-fno-stack-protector", "-U_FORTIFY_SOURCE", "-Wl,-z,norelro,-z,lazy,-z,execstack", "-fno-pie", "-no-pie"]
SOURCE = "#include <cstring>\nint main(int n, char** s) { char t[9]; std::strcpy(t, s[n - 1]); return t[0]; }\n"


def faults(program):
    shown = subprocess.run(["readelf", "-hldsW", program], capture_output=True, text=True, check=True).stdout
    return [f"{program}: {fault}" for fault, pattern in WANTED.items() if not re.search(pattern, shown)]


def planted(compiler):
    """Each fault is found in a program that is built the opposite way, and none in one that is built right."""
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder, "main.cpp"), pathlib.Path(folder, "program")
        source.write_text(SOURCE)
        for flags, count in ((FLAGS, 0), (OPPOSITE, len(WANTED))):
            subprocess.run([compiler, *flags, source, "-o", program], check=True)
            if len(faults(program)) != count:
                yield f"{count} faults are there, found: {faults(program)}"


if not shutil.which("readelf"):
    print("skipped: readelf is not there")
    sys.exit(77)
problems = list(planted(sys.argv[2])) if sys.argv[1] == "--planted" else [fault for program in sys.argv[1:] for fault in faults(program)]
print("\n".join(problems) or "hardened")
sys.exit(1 if problems else 0)
