# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs fuzz targets, two at a time, and prints a table: run.py FOLDER [TARGET..] [--for 60s] [--of NAME] [--with LINE] [--without NUMBER] [--strict] [--replay LINE] [--first N] [--seeds N] [--plant].
Called by ./run fuzz; FOLDER is the build. All are libFuzzer's but touch, which climbs, and peers, leaders and unplugs, which run seeds: these lie in the release build. Exit 0 without a finding, 1 with one, 2 on wrong usage.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import seeds  # noqa: E402
from search import plant  # noqa: E402

# Greatest input size of each target [octets]; a time limit would fail on a busy machine, so it is large.
MOST_OCTETS = {"pdu": 4096, "bundle": 4096, "force_model": 2048, "filter": 600, "scene": 1 << 20,
               "capture": 8192, "fragments": 600, "envelope": 600, "key_file": 1024, "compression": 1400, "assured": 2048, "ownership": 2048,
               "presence": 2048, "tracker": 2048, "membership": 8192, "leading": 4096, "unicast": 2048,
               "viewer": 16384, "image": 4096, "mesh": 4096, "track": 4096, "density": 4096, "descriptor": 65536, "falcon": 512, "polhem": 512, "serial": 1024, "hid": 1024}
SECONDS_FOR_ONE_INPUT = 60
TOUCH, PEERS, LEADERS, UNPLUGS = "touch", "peers", "leaders", "unplugs"
SEEDED = (PEERS, LEADERS, UNPLUGS)
SEEDS = 10_000
TOUCH_AIMS = ["energy", "meter", "rate", "wrong", "hiccup", "rows", "unseen", "model_energy", "model_meter", "dead", "liar"]
TARGETS = [*MOST_OCTETS, TOUCH, *SEEDED]


def duration(text):
    match = re.fullmatch(r"(\d+)(s|m|min|h)?", text)
    if not match:
        raise argparse.ArgumentTypeError(f"'{text}' is no time; write 60s or 30m")
    return int(match[1]) * {"s": 1, "m": 60, "min": 60, "h": 3600}[match[2] or "s"]


def say(text):
    print(f"reckon: {text}", file=sys.stderr, flush=True)


def touch_program(folder):
    return folder.parent / "release" / "tests" / "fuzz" / "touch" / "touch_search"


def seeded_program(target, folder):
    return plant.program_of(target, folder.parent / "release")


def run_seeds(target, folder, first, number):
    """Runs `count` seeds from the first in two processes; returns the same as run(), without files."""
    folder.mkdir(parents=True, exist_ok=True)
    logs = [folder / f"{target}.{half}.log" for half in (1, 2)]
    halves = []
    for skipped, log in enumerate(logs):
        with log.open("w") as out:
            halves.append(subprocess.Popen(
                ["nice", "-n", "19", str(seeded_program(target, folder)), "--first", str(first + skipped),
                 "--seeds", str(number - skipped), "--every", "2"], stdout=out, stderr=out))
    broken = sum(half.wait() != 0 for half in halves)
    text = "".join(log.read_text(errors="replace") for log in logs)
    cells = row(target, text, broken)
    for column in (1, 2):
        label = ("number_of_executed_units", "average_exec_per_sec")[column - 1]
        cells[column] = str(sum(map(int, re.findall(label + r": +(\d+)", text))))
    (folder / f"{target}.log").write_text(text)
    return cells, [], folder / f"{target}.log"


def run_touch(folder, seconds, options):
    """Searches and prints the worst result of each objective; returns the same as run(), without files."""
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / f"{TOUCH}.log"
    with log.open("w") as out:
        status = subprocess.run(["nice", "-n", "19", str(touch_program(folder)), "--for", str(seconds),
                                 *(["--of", options.only] if options.only else []),
                                 *(["--with", options.fixed] if options.fixed else []),
                                 *(["--without", *options.without] if options.without else []),
                                 *(["--strict"] if options.strict else [])],
                                stdout=out, stderr=out, check=False).returncode
    text = log.read_text(errors="replace")
    for line in re.findall(r"^worst .*\n", text, re.M):
        print(line, end="", flush=True)
    return row(TOUCH, text, int(status != 0)), [], log


def run(folder, target, options):
    """Runs one target; returns its row of the table and the files that caused a fault."""
    seconds = options.seconds
    if target == TOUCH:
        return run_touch(folder, seconds, options)
    if target in SEEDED:
        return run_seeds(target, folder, options.first, options.number)
    corpus, findings = folder / "corpus" / target, folder / "findings" / target
    for path in (corpus, findings):
        path.mkdir(parents=True, exist_ok=True)
    before = set(findings.iterdir())
    command = ["nice", "-n", "19", str(folder / "targets" / target), str(corpus),
               str(folder / "seeds" / target), f"-max_total_time={seconds}",
               f"-max_len={MOST_OCTETS[target]}", f"-timeout={SECONDS_FOR_ONE_INPUT}",
               "-print_final_stats=1", f"-artifact_prefix={findings}/"]
    if (folder / f"{target}.dict").exists():
        command.append(f"-dict={folder / target}.dict")
    log = folder / f"{target}.log"
    with log.open("w") as out:
        status = subprocess.run(command, stdout=out, stderr=out, check=False).returncode
    # The engine also reports slow inputs, but only a time-out is a fault.
    found = sorted(p for p in set(findings.iterdir()) - before if not p.name.startswith("slow-"))
    return row(target, log.read_text(errors="replace"), len(found) or int(status != 0)), found, log


def row(target, text, findings):
    def last(pattern):
        numbers = re.findall(pattern, text)
        return numbers[-1] if numbers else "-"
    return [target, last(r"number_of_executed_units: (\d+)"), last(r"average_exec_per_sec: +(\d+)"),
            last(r"cov: (\d+)"), last(r"corp: (\d+)"), last(r"peak_rss_mb: +(\d+)"), str(findings)]


def tell(target, found, log):
    """Describes a fault, and the command that reproduces it."""
    lines = log.read_text(errors="replace").splitlines()
    say(f"{target}: a finding; the whole story is in {log}")
    for line in [x for x in lines if re.search("reckon fuzz:|again:|ERROR:|runtime error|SUMMARY", x)][:6]:
        print("        " + line, file=sys.stderr)
    program = log.parent / "targets" / target
    for path in found:
        print(f"        again: {os.path.relpath(program)} {os.path.relpath(path)}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(prog="./run fuzz", description=__doc__.split(":")[0])
    parser.add_argument("folder", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=", ".join(TARGETS))
    parser.add_argument("--for", dest="seconds", type=duration, default=60, metavar="TIME",
                        help="of each target: 60s (default), 30m")
    parser.add_argument("--replay", metavar="LINE", help="with touch alone: a scenario as the search prints it; with peers, leaders or unplugs alone: a seed")
    parser.add_argument("--of", dest="only", choices=TOUCH_AIMS, help="with touch alone: makes that worse only")
    parser.add_argument("--with", dest="fixed", metavar="LINE", help="with touch alone: numbers of scenarios that stay as given, written as in a line: 'model=2 fault=8'")
    parser.add_argument("--without", action="append", default=[], metavar="NUMBER", help="with touch alone: a number of scenarios that stays out of play, as a line names it; may be given again")
    parser.add_argument("--strict", action="store_true", help="with touch alone: a wrong force is a finding even where the servo tells it")
    parser.add_argument("--first", type=int, default=1, metavar="N", help="of peers, leaders and unplugs: seed to begin with, 1 (default)")
    parser.add_argument("--seeds", dest="number", type=int, default=SEEDS, metavar="N", help=f"of peers, leaders and unplugs: {SEEDS} (default)")
    parser.add_argument("--plant", action="store_true", help="with peers or leaders alone: plants faults and wants each to be found")
    options = parser.parse_args()
    for target in options.targets:
        if target not in TARGETS:
            parser.error(f"no target '{target}'; there are {', '.join(TARGETS)}")
    if (options.only or options.fixed or options.without or options.strict) and options.targets != [TOUCH]:
        parser.error("--of, --with, --without and --strict go with touch alone")
    if options.number < 2:
        parser.error("--seeds needs 2 or more")
    if options.first < 1:
        parser.error("--first needs 1 or more")
    if options.first > 1 and (options.plant or not options.targets or not set(options.targets) <= set(SEEDED)):
        parser.error("--first goes with peers, leaders or unplugs, without --plant")
    if options.plant:
        if options.targets not in ([PEERS], [LEADERS]):
            parser.error("--plant goes with peers or leaders alone")
        return plant.main(options.folder.parent, options.number, options.targets[0])
    if options.replay is not None:
        target = options.targets[0] if len(options.targets) == 1 else None
        if target not in (TOUCH, *SEEDED):
            parser.error("--replay goes with touch, peers, leaders or unplugs alone; the others are shown again by their own programs")
        program = touch_program(options.folder) if target == TOUCH else seeded_program(target, options.folder)
        return subprocess.run([program, "--replay", options.replay, *(["--strict"] if options.strict else [])], check=False).returncode
    targets = options.targets or TARGETS
    if set(targets) & set(MOST_OCTETS):
        seeds.main(options.folder)
    say(f"targets: {len(targets)}, {options.seconds} s each, two at a time"
        if not set(targets) <= set(SEEDED) else f"seeds {options.first} to {options.first + options.number - 1}, in two processes")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda t: run(options.folder, t, options), targets))
    head = ["target", "executions", "exec/s", "edges", "corpus", "MiB", "findings"]
    for cells in [head] + [result[0] for result in results]:
        print("{:<12}{:>12}{:>9}{:>8}{:>8}{:>6}{:>10}".format(*cells))
    bad = [result for result in results if result[0][-1] != "0"]
    for cells, found, log in bad:
        tell(cells[0], found, log)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
