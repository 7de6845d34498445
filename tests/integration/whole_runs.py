# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""The program to its end: demo, peer and view of every shipped scene, ended by --for and by Ctrl-C, exit with status 0
and their summary. whole_runs.py --reckon RECKON --scenes SCENES [-v]"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

AT_ONCE = 4  # programs
START, END = 60, 60  # [s], longest time to the first output and from the end of the run to the exit
# A scene that a verb refuses: (scene, verb) -> (exit status, text of the reason). Currently none.
REFUSED = {}
SUMMARIES = {"demo": r"^What [\d.]+ s with \d+ peers? cost$", "peer": r"^What [\d.]+ s as [\d:]+ cost$",
             "view": r"^\d+ tabs? looked, \d+ pictures? sent$"}
# First output after which Ctrl-C is effective.
BEGUN = {"demo": r"in a browser|interface", "peer": r"interface", "view": r"http://"}


class Ports:
    """UDP ports of lo: only programs on the same port receive each other."""

    def __init__(self):
        self._lock, self._given = threading.Lock(), set()

    def take(self):
        """Returns a free port whose successor is also free, for a sealed exercise."""
        with self._lock:
            while True:
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
                    probe.bind(("", 0))
                    port = probe.getsockname()[1]
                if not {port, port + 1} & self._given and port < 65535:
                    self._given |= {port, port + 1}
                    return port


class Run:
    """One program; its lines are read as they arrive."""

    def __init__(self, verb, words):
        self.verb = verb
        self._begun = threading.Event()
        self.process = subprocess.Popen([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        stdin=subprocess.DEVNULL, text=True)
        self._texts = {}
        self._readers = [threading.Thread(target=self._read, args=(name,)) for name in ("stdout", "stderr")]
        for reader in self._readers:
            reader.start()

    def _read(self, name):
        lines = []
        for line in getattr(self.process, name):
            lines.append(line)
            if re.search(BEGUN[self.verb], line):
                self._begun.set()
        self._texts[name] = "".join(lines)
        self._begun.set()

    def wait_begun(self):
        self._begun.wait(START)

    def interrupt(self):
        """Ctrl-C; no effect on a program that has already ended."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)

    def end(self):
        """(exit status, stdout, stderr); a program that hangs is killed."""
        try:
            self.process.wait(START + END)
        except subprocess.TimeoutExpired:
            self.process.kill()
        for reader in self._readers:
            reader.join()
        return self.process.wait(), self._texts["stdout"], self._texts["stderr"]


def fault(scene, verb, is_json, result):
    """A fault of the way in which a program ended, or nothing."""
    status, out, errors = result
    wanted, why = REFUSED.get((scene, verb), (0, ""))
    tail = "\n".join((out + errors).splitlines()[-12:])
    if re.search("runtime error: |Sanitizer", errors):
        return f"a sanitizer reports\n{errors}"
    if status != wanted:
        return f"exit status {status}\n{tail}"
    if wanted != 0:
        return None if re.search(why, errors) else f"it does not say why\n{tail}"
    if not is_json:
        return None if re.search(SUMMARIES[verb], out + errors, re.M) else f"no summary\n{tail}"
    try:
        lines = [json.loads(line) for line in out.splitlines()]
    except ValueError as error:
        return f"a line is no JSON: {error}\n{tail}"
    return None if lines and isinstance(lines[-1], dict) and lines[-1] else f"no JSON object\n{tail}"


class Case:
    """Programs of one scene that run together: demo alone, or peer with a view that receives it."""

    def __init__(self, scene, verbs, ending, is_json):
        self.scene, self.verbs, self.ending, self.is_json = scene, verbs, ending, is_json

    def copy(self, scenes, folder, port, exercise):
        """A copy of the scene and of the files that it names, with a port of its own."""
        there = folder / f"{port}"
        shutil.copytree(scenes, there)
        path = there / self.scene
        text = path.read_text()
        if re.search(r"^\[network", text, re.M):
            sys.exit(f"{self.scene} has a [network] of its own: this test gives it one")
        path.write_text(f"{text}\n[network]\nport = {port}\nexercise = {exercise}\n")
        return path

    def run(self, reckon, path):
        """Faults, one text for each."""
        programs = []
        for verb in self.verbs:
            words = [reckon, verb, path, "--iface", "lo"]
            words += ["--port", "0"] if verb == "view" else ["--even-if-slow"]
            words += ["--for", "1s"] if self.ending == "--for" else []
            words += ["--json"] if self.is_json and verb != "view" else []
            programs.append(Run(verb, words))
        if self.ending != "--for":
            for program in programs:
                program.wait_begun()
            time.sleep(1.0)
            for program in programs:
                program.interrupt()
        faults = []
        for program in programs:
            found = fault(self.scene, program.verb, self.is_json and program.verb != "view", program.end())
            if found:
                faults.append(f"reckon {program.verb} {self.scene}, {self.ending}{' --json' * self.is_json}: {found}")
        return faults


def cases(scenes, verbs):
    """Each scene with both endings; one of them prints its summary as text, the other as JSON, alternately."""
    for number, path in enumerate(sorted(scenes.glob("*.toml"))):
        for turn, ending in enumerate(("--for", "Ctrl-C")):
            yield Case(path.name, verbs, ending, (number + turn) % 2 == 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--scenes", required=True, type=pathlib.Path)
    parser.add_argument("-v", action="store_true", help="say how long each took")
    arguments = parser.parse_args()
    ports, faults, count = Ports(), [], 0
    with tempfile.TemporaryDirectory(prefix="reckon_") as name:
        def run(case):
            start = time.monotonic()
            port = ports.take()
            path = case.copy(arguments.scenes, pathlib.Path(name), port, 1 + port % 255)
            found = case.run(arguments.reckon, path)
            if arguments.v:
                print(f"{time.monotonic() - start:5.1f} s  {' + '.join(case.verbs)} {case.scene} {case.ending}",
                      flush=True)
            return found

        for verbs in (("demo",), ("peer", "view")):
            with concurrent.futures.ThreadPoolExecutor(AT_ONCE // len(verbs)) as pool:
                for found in pool.map(run, cases(arguments.scenes, verbs)):
                    faults += found
                    count += len(verbs)
    for text in faults:
        print(f"FAILED: {text}")
    print(f"{count} runs, {len(faults)} faults")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
