# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Output of `--metrics` on loopback, read by independent parsers: Prometheus' own client library parses the text as
OpenMetrics, and promtool reports unusual metrics.
  metrics.py CASE --reckon PROGRAM --scenes FOLDER     CASE: peer, record or view
Status 77: neither is installed (apt-get install prometheus python3-prometheus-client)."""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

try:
    from prometheus_client.openmetrics.parser import text_string_to_metric_families
except ImportError:
    text_string_to_metric_families = None

PATIENCE = 30  # [s], for a busy machine


def fail(text):
    sys.exit(f"metrics: {text}")


class Program:
    """A program that serves metrics at a port of its own until the block ends."""

    def __init__(self, words):
        self.process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        told = []
        self.address = None
        for line in self.process.stderr:
            told.append(line)
            found = re.match(r"metrics: (http://\S+)$", line)
            if found:
                self.address = found[1]
                return
        fail(f"no address: {''.join(told)}")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate(timeout=PATIENCE)

    def text(self):
        with urllib.request.urlopen(self.address, timeout=PATIENCE) as answer:
            kind = answer.headers["Content-Type"]
            if kind != "application/openmetrics-text; version=1.0.0; charset=utf-8":
                fail(f"Content-Type: {kind}")
            return answer.read().decode()


def values_in(text):
    """Sample with its labels -> value, with the client library; its parser is strict."""
    values = {}
    for family in text_string_to_metric_families(text):
        if not family.documentation:
            fail(f"{family.name} has no HELP")
        for sample in family.samples:
            key = (sample.name, *sorted(sample.labels.items()))
            if key in values:
                fail(f"{key} comes twice")
            values[key] = sample.value
    return values


def plain_values_in(text):
    """The same without the library: the values that this test needs."""
    values = {}
    for line in text.splitlines():
        found = re.fullmatch(r"([a-z_]+)(?:\{(.*)\})? (\S+)", line)
        if found:
            labels = re.findall(r'([a-z_]+)="((?:[^"\\]|\\.)*)"', found[2] or "")
            values[(found[1], *sorted(labels))] = float(found[3])
    return values


def lint(text):
    """promtool reads the older text format, in which the name of a counter has its _total in TYPE and HELP too."""
    counters = re.findall(r"^# TYPE (\S+) counter$", text, re.M)
    for name in counters:
        text = re.sub(rf"^# (TYPE|HELP) {name} ", rf"# \1 {name}_total ", text, flags=re.M)
    result = subprocess.run(["promtool", "check", "metrics"], input=text, capture_output=True, text=True, check=False)
    if result.returncode != 0 or result.stderr or result.stdout:
        fail(f"promtool: {result.stdout}{result.stderr}")


def wait_for(program, is_there):
    """Returns the values as soon as they fulfil the condition."""
    end = time.monotonic() + PATIENCE
    while True:
        text = program.text()
        values = (values_in if text_string_to_metric_families else plain_values_in)(text)
        if is_there(values):
            break
        if time.monotonic() > end:
            fail(f"what is waited for does not come:\n{text}")
        time.sleep(0.1)
    if shutil.which("promtool"):
        lint(text)
    return values


def peers(reckon, scenes, count):
    """Peers of a scene on loopback; the first one serves the metrics."""
    words = [reckon, "peer", str(scenes / "two_hands.toml"), "--iface", "lo", "--json", "--metrics", "0", "--operator"]
    return [Program([*words, str(number + 1)]) for number in range(count)]


def check_peer(reckon, scenes, _):
    first, second = peers(reckon, scenes, 2)
    with first, second:
        values = wait_for(first, lambda all: all.get(("reckon_entities",), 0) > 0
                          and all[("reckon_servo_steps_total",)] > 0)
        if values[("reckon_peers",)] < 1 or values[("reckon_datagrams_received_total",)] < 1:
            fail(f"hears nobody: {values}")
        for name in (("reckon_datagrams_refused_total", ("cause", "version")), ("reckon_link_kernel_drops_total",),
                     ("reckon_updates_sent_by_reason_total", ("reason", "heartbeat")),
                     ("reckon_port_energy_joules", ("hand", "1")), ("reckon_servo_steps_missed_total",),
                     ("reckon_servo_lateness_seconds", ("quantile", "0.99")), ("reckon_write_overflow_total",)):
            if name not in values:
                fail(f"{name} is missing in {sorted(values)}")
        later = wait_for(first, lambda all: all[("reckon_uptime_seconds",)] > values[("reckon_uptime_seconds",)])
        fallen = [name for name, value in values.items()
                  if name[0].endswith(("_total", "_count")) and later[name] < value]
        if fallen:
            fail(f"counters fell: {fallen}")


def check_record(reckon, scenes, folder):
    words = [reckon, "record", str(folder / "a.pcapng"), str(scenes / "two_hands.toml"), "--iface", "lo", "--metrics", "0"]
    with Program(words) as recorder, peers(reckon, scenes, 1)[0]:
        values = wait_for(recorder, lambda all: all.get(("reckon_recorded_datagrams_total",), 0) > 3)
        if values[("reckon_recorded_bytes_total",)] < 12 * values[("reckon_recorded_datagrams_total",)]:  # a header each
            fail(f"octets: {values}")
        if values[("reckon_interface_datagrams_received_total", ("interface", "lo"))] < 1:
            fail(f"nothing came over lo: {values}")


def check_view(reckon, scenes, _):
    words = [reckon, "view", str(scenes / "two_hands.toml"), "--iface", "lo", "--port", "0", "--metrics", "127.0.0.1:0"]
    with Program(words) as viewer, peers(reckon, scenes, 1)[0]:
        values = wait_for(viewer, lambda all: all.get(("reckon_source_datagrams_received_total",), 0) > 3)
        if values[("reckon_page_tabs_open",)] != 0:
            fail(f"tabs: {values}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("case", choices=("peer", "record", "view"))
    parser.add_argument("--reckon", required=True)
    parser.add_argument("--scenes", type=Path, required=True)
    given = parser.parse_args()
    if not text_string_to_metric_families and not shutil.which("promtool"):
        print("skipped: no parser of metrics here; apt-get install prometheus python3-prometheus-client")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        check = {"peer": check_peer, "record": check_record, "view": check_view}[given.case]
        check(given.reckon, given.scenes, Path(folder))
    print(f"{given.case}: read by {'the client library' if text_string_to_metric_families else 'a plain reader'}"
          f"{' and promtool' if shutil.which('promtool') else ''}")


if __name__ == "__main__":
    main()
