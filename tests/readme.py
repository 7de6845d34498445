# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs each line of the blocks of commands of the README and of docs/first_steps, once, as a reader pastes it: in a folder
with nothing but scenes/, with the built program in the PATH. readme.py ROOT RECKON [--planted]

What speaks to a network gets --iface lo if it has none, and what does not end by itself is interrupted. What only computes runs
behind the others. With --planted lines are added that a reader could not run, each of which is to be found."""
import concurrent.futures
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time

SKIP = {  # by the first two words: why a line is not run here
    "./run test": "would run this test",
}
SPEAKS = {"peer", "inspect", "record", "replay"}  # to a network; inspect not where it reads a file
ENDLESS = {"demo", "peer", "inspect", "record"}   # until they are interrupted; so is `view` without --save
LISTENS = {"inspect", "record"}                   # to somebody, who is started beside them
COMPUTES = {"bench", "figures"}                   # and needs nothing that another line leaves
SECONDS, LISTENED = 2, 3                          # that they are left running; where one listens
LONGEST = 900                                     # [s], of what ends by itself: on a busy machine
# Of this host the doctor may have findings.
STATUS = {"doctor": {0, 1}}

PLANTED = ["reckon inspect nowhere.pcap", "reckon demo --bogus", "reckon figrues", "./run dmeo"]


def lines_of(readme):
    """The lines of all blocks of shell commands, without their remarks."""
    for block in re.findall(r"^```sh\n(.*?)^```", readme, re.M | re.S):
        for line in block.splitlines():
            words = shlex.split(line, comments=True)
            if words:
                yield words


class Reader:
    def __init__(self, root, reckon, folder):
        self._root, self._folder = root, folder
        (folder / "scenes").symlink_to(root / "scenes")
        self._environment = dict(os.environ, PATH=f"{reckon.parent}:{os.environ['PATH']}", TERM="dumb")

    def start(self, words):
        return subprocess.Popen(words, cwd=self._folder, env=self._environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def try_line(self, words):
        """Why a reader cannot run this line; None if he can."""
        if words[0] == "export":
            return None if words[1].startswith("PATH=") else "no PATH"
        if words[0] == "./run":
            verbs = subprocess.run([self._root / "run", "help"], capture_output=True, text=True).stdout
            if not re.search(rf"^  {words[1]} ", verbs, re.M):
                return f"./run has no verb {words[1]}"
            words = ["reckon"] + words[1:]  # it builds the program, and then does this
        verb = words[1]
        reads = verb == "inspect" and len(words) > 2
        if verb in SPEAKS and not reads and "--iface" not in words:
            words = words + ["--iface", "lo"]
        beside = self.start(["reckon", "demo", "--for", f"{LISTENED + 3}s"]) if verb in LISTENS and not reads else None
        before = set(self._folder.iterdir())
        program = self.start(words)
        if verb in ENDLESS and not reads or verb == "view" and "--save" not in words:
            time.sleep(LISTENED if beside else SECONDS)
            program.send_signal(signal.SIGINT)
        try:
            out, err = program.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            program.kill()
            program.communicate()
            return f"it does not end in {LONGEST} s"
        if beside:
            beside.communicate(timeout=60)
        if program.returncode not in STATUS.get(verb, {0}):
            return f"exit status {program.returncode}\n{err[-2000:]}"
        if not out.strip() and set(self._folder.iterdir()) == before and "replay" not in words:
            return f"nothing comes of it\n{err[-2000:]}"
        if beside and re.search(r"no entity received|it has no entity|recorded 0 datagrams", out + err):
            return f"it heard nobody\n{out}{err[-2000:]}"
        return None


def main():
    root, reckon = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    pages = [root / "README.md", *sorted((root / "docs/first_steps").glob("*.md"))]
    lines = []
    for page in pages:
        lines += [words for words in lines_of(page.read_text()) if words not in lines]
    planted = [shlex.split(line) for line in PLANTED] if "--planted" in sys.argv else []
    if len(lines) < 15:
        sys.exit(f"failed: only {len(lines)} lines are found")
    failed = []
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as folder_behind:
        reader, reader_behind = (Reader(root, reckon, pathlib.Path(one)) for one in (folder, folder_behind))

        def try_one(reader, words):
            line, begun = shlex.join(words), time.monotonic()
            if " ".join(words[:2]) in SKIP:
                print(f"skipped: {line}: {SKIP[' '.join(words[:2])]}")
                return
            problem = reader.try_line(words)
            print(f"{time.monotonic() - begun:6.1f} s  {'FAILED' if problem else 'ok    '}  {line}"
                  + (f"\n{problem}" if problem else ""), flush=True)
            if problem:
                failed.append(words)

        with concurrent.futures.ThreadPoolExecutor(1) as behind:
            tried = []
            for words in planted or lines:
                if not planted and words[1] in COMPUTES:
                    tried.append(behind.submit(try_one, reader_behind, words))
                else:
                    try_one(reader, words)
            for one in tried:
                one.result()
    if planted:
        sys.exit(0 if failed == planted else "failed: a line that cannot be run was not found")
    sys.exit(f"failed: {len(failed)} of {len(lines)} lines" if failed else 0)


if __name__ == "__main__":
    main()
