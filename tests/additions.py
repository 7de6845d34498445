#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Adds one thing of each kind to a copy of the tree, builds and runs them, and counts the files that each edits.

  additions.py ROOT    status 1 where a thing does not work, or edits more than docs/architecture.md promises

New files, the row and the CMake line are free, and so is what a program prints into a page. Beside these the first six
edit nothing, and a field of a PDU at most two files. The copy is build/additions."""
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

CMAKE = "CMakeLists.txt"
TARGETS = ("reckon", "reckon-peer", "reckon-inspect", "reckon-bench", "reckon_lua_tables", "reckon_object_model", "pdu_tests")
DRIVER = """#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/threads/real_device.hpp"
namespace reckon::peer {
class Mock final : public RealDevice, haptics::HapticDevice {
 public:
  explicit Mock(double height) : height_(height) {}
  haptics::HapticDevice& device() noexcept override { return *this; }
  std::vector<std::string> take_notices() override { return {}; }
  haptics::DeviceLimits limits() const noexcept override { return {.max_force = 5.0, .damping = 1.0}; }
  haptics::DeviceSample read(std::chrono::nanoseconds) noexcept override { return {.position = {0.0, 0.0, height_}, .ok = true}; }
  void write(const Eigen::Vector3d&, std::chrono::nanoseconds) noexcept override {}
  double height_;
};
const Driver& mock_driver() {
  static const Driver kDriver{
      .name = "mock", .article = "a mock", .summary = "a handle that stands still",
      .keys = {{.key = "mock_height", .standard = 0.02, .unit = "m", .least = 0.0, .most = 0.1, .help = "of a mock: its height"}},
      .find = []() -> std::vector<AttachedDevice> { return {{"mock", "a handle", "it stands still", "", ""}}; },
      .open = [](const DeviceConfig& device, const DeviceOpening&) -> OpenedDevice {
        return {std::make_unique<Mock>(driver_value<double>(device, "mock_height")), "a mock is held"}; }};
  return kDriver;
}
}  // namespace reckon::peer
"""
ACTING = """#include "reckon/peer/loops/peer_hooks.hpp"
namespace reckon::peer {
PeerHooks refuse_kind(const ModelWiring&) {
  return {.arriving = [](const ArrivingPdu& one) { return one.pdu.header.pdu_type == pdu::PduType::attribute ? Verdict::refuse : Verdict::pass; }};
}
}  // namespace reckon::peer
"""
WATCHING = """#include <fmt/format.h>
#include <array>
#include <memory>
#include "reckon/peer/loops/peer_hooks.hpp"
namespace reckon::peer {
struct Sums {
  std::array<std::size_t, 256> octets{};
  ~Sums() {
    for (std::size_t type = 0; type < octets.size(); ++type)
      if (octets[type] > 0) fmt::print(stderr, "octets of type {}: {}\\n", type, octets[type]);
  }
};
PeerHooks octets_by_type(const ModelWiring&) {
  const auto add = [sums = std::make_shared<Sums>()](std::span<const std::byte> datagram) {
    for (const pdu::BundledPdu& one : pdu::BundleReader(datagram))
      sums->octets[static_cast<std::uint8_t>(one.header.pdu_type)] += one.bytes.size();
  };
  return {.received = add, .sent = add};
}
}  // namespace reckon::peer
"""
STUDY = """#include <cmath>
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study.hpp"
namespace reckon::bench {
class EulerStudy final : public Study {
  std::vector<Flag> flags() override { return {}; }
  StudyOutput run(const StudyCall&) override {
    return {.out = lines_of(shared_.json, std::vector{0.1, 0.01}, [](double h) {
      const double error = std::abs(std::exp(1) - std::pow(1 + h, 1 / h));
      return Fields("step").value("step_s", h).value("error", error).shown("ERROR", "error", error, fmt::format("{:.1e}", error));
    })};
  }
};
std::unique_ptr<Study> euler_study() { return std::make_unique<EulerStudy>(); }
}  // namespace reckon::bench
"""
EFFECT = """#pragma once
#include "reckon/haptics/effects/effect_hooks.hpp"
namespace reckon::haptics {
struct Thickness { double thickness = 2.0; };
class Molasses : public CountedEffect<Molasses> {
 public:
  using Parameters = Thickness;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "molasses", kKey = "molasses", kCost = "a multiplication";
  static constexpr std::array<EffectParameter<Thickness>, 1> kParameters{
      {{"thickness", "N s/m", &Thickness::thickness, 0.0, 10.0, 2.0, "Force against sliding per m/s."}}};
  explicit Molasses(const Thickness& given) : given_(given) { check_parameters(kParameters, given); }
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) noexcept {
    return contact.in_contact ? Eigen::Vector3d(-given_.thickness * contact.slip()) : Eigen::Vector3d::Zero();
  }
  [[nodiscard]] double damping() const noexcept { return 0.0; }
  [[nodiscard]] const Thickness& parameters() const noexcept { return given_; }
  Thickness given_;
};
}  // namespace reckon::haptics
"""
VERB = """#include <fmt/format.h>
#include "reckon/tools/command_line/verb_rows.hpp"
namespace reckon::tools::verb {
Verb greet() {
  return verb_of(verb_row("greet"), [](Arguments, const Console& console) { return fmt::print(console.out, "good day\\n"), 0; });
}
}  // namespace reckon::tools::verb
"""
HOOKS, STUDIES, EFFECTS = "src/loops/peer_hooks.cpp", "bench/verbs/bench.cpp", "haptics/effects/effect_types.hpp"
VERBS, FIELD = "tools/command_line/verb_rows.hpp", "pdu/reckon/time_exchange.hpp"
# Thing, a name that its printed lines have, new files, file of the row, and edits: file, what stands there, what then does.
THINGS = [
    ("driver", "mock", {"src/drivers/mock.cpp": DRIVER}, "src/drivers/drivers.cpp", [
        ("src/drivers/drivers.cpp", "const Driver& plugin_driver();", "const Driver& plugin_driver();\nconst Driver& mock_driver();"),
        ("src/drivers/drivers.cpp", "&plugin_driver()}", "&plugin_driver(), &mock_driver()}"),
        ("src/" + CMAKE, "drivers/plugin.cpp", "drivers/mock.cpp drivers/plugin.cpp")]),
    ("mechanism that acts", "refuse_kind", {"src/loops/refuse_kind.cpp": ACTING}, HOOKS, [
        (HOOKS, "namespace {\n", "PeerHooks refuse_kind(const ModelWiring& wiring);\nnamespace {\n"),
        (HOOKS, '    {"link", always, link}', '    {"refuse_kind", always, refuse_kind},\n    {"link", always, link}'),
        ("src/" + CMAKE, "SOURCES loops/", "SOURCES loops/refuse_kind.cpp loops/")]),
    ("mechanism that watches", "octets_by_type", {"src/loops/octets_by_type.cpp": WATCHING}, HOOKS, [
        (HOOKS, "namespace {\n", "PeerHooks octets_by_type(const ModelWiring& wiring);\nnamespace {\n"),
        (HOOKS, '    {"link", always, link}', '    {"octets_by_type", always, octets_by_type},\n    {"link", always, link}'),
        ("src/" + CMAKE, "SOURCES loops/", "SOURCES loops/octets_by_type.cpp loops/")]),
    ("study", "euler", {"bench/studies/euler/README.md": "# euler\n\nThe study of a step's error.\n", "bench/studies/euler/study.cpp": STUDY}, STUDIES, [
        (STUDIES, "std::unique_ptr<Study> latency_study();", "std::unique_ptr<Study> euler_study();\nstd::unique_ptr<Study> latency_study();"),
        (STUDIES, "kStudies{\n", 'kStudies{\n    StudyKind{"euler", "error of a step", "", "reckon bench euler --json", euler_study},\n'),
        ("bench/" + CMAKE, " studies/force/", " studies/euler/study.cpp\n  studies/force/")]),
    ("effect", "molasses", {"haptics/effects/molasses.hpp": EFFECT}, EFFECTS, [
        (EFFECTS, "#include <type_traits>\n", '#include <type_traits>\n#include "reckon/haptics/effects/molasses.hpp"\n'),
        (EFFECTS, "TapVibration>;", "TapVibration, Molasses>;"),
        ("haptics/" + CMAKE, "effects/skin.hpp", "effects/molasses.hpp effects/skin.hpp")]),
    ("verb", "greet", {"tools/verbs/greet.cpp": VERB}, VERBS, [
        (VERBS, "Verb zwidth();", "Verb zwidth();\nVerb greet();"),
        (VERBS, "  };\n}\n\ninline", '      row("greet", "greet", kInspectProgram, verb::greet),\n  };\n}\n\ninline'),
        ("tools/" + CMAKE, "verbs/info.cpp", "verbs/greet.cpp verbs/info.cpp")]),
    ("field of a PDU", "mark", {}, FIELD, [
        (FIELD, "  std::uint16_t padding = 0;\n", "  std::uint16_t padding = 0;\n  std::uint32_t mark = 0;\n"),
        (FIELD, '"padding", pdu.padding);\n', '"padding", pdu.padding);\n  visitor("mark", pdu.mark);\n'),
        (FIELD, "kFixedSize<TimeExchange> == 24", "kFixedSize<TimeExchange> == 28"),
        ("tests/support/wire_samples/make_samples.py", '143, 129, 24 + 24)', '143, 129, 28 + 24)'),
        ("tests/support/wire_samples/make_samples.py", '    exchange.octets("echo to 0x01', '    exchange.put("mark", "I", 0x0BADCAFE)\n    exchange.octets("echo to 0x01'),
        ("docs/wire_format.md", "| 24 | 12 n | records | echoes | epoch u32", "| 24 | 4 | u32 | mark | |\n| 28 | 12 n | records | echoes | epoch u32")]),
]


def git(copy, *words):
    return subprocess.run(["git", "-C", copy, "-c", "user.name=a", "-c", "user.email=a@b", *words], check=True, capture_output=True, text=True).stdout


def make_copy(root, copy):
    """The tree as it is now; the copy keeps its build folder."""
    copy.mkdir(parents=True, exist_ok=True)
    for old in copy.iterdir():
        if old.name != "build":
            shutil.rmtree(old) if old.is_dir() else old.unlink()
    for name in git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard").split("\0"):
        if name and (root / name).is_file():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, copy / name)
    git(copy, "init", "-q")
    git(copy, "add", "-A")
    git(copy, "commit", "-qm", "The tree")


def add(copy, new, edits):
    for path, text in new.items():
        (copy / path).parent.mkdir(exist_ok=True)
        (copy / path).write_text(text, encoding="utf-8")
    for path, there, then in edits:
        text = (copy / path).read_text(encoding="utf-8")
        if there not in text:
            sys.exit(f"{path}: has no {there!r} any more: adapt THINGS of tests/additions.py")
        (copy / path).write_text(text.replace(there, then, 1), encoding="utf-8")


def run(copy, *words):
    done = subprocess.run(words, cwd=copy, capture_output=True, text=True, timeout=600)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}: status {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done


def print_pages(copy, build):
    """What programs print into pages and samples."""
    keys = run(copy, build / "reckon", "scene", "keys").stdout
    page = copy / "docs/scene_files.md"
    text, lines = page.read_text(encoding="utf-8"), keys.strip().split("\n")
    begin, end = text.index(lines[0]), text.index(lines[-1]) + len(lines[-1])
    page.write_text(text[:begin] + keys.strip() + text[end:], encoding="utf-8")
    run(copy, sys.executable, "-B", "tests/support/wire_samples/make_samples.py")
    for program, path in (("reckon_lua_tables", "tools/wireshark/reckon.lua"), ("reckon_object_model", "docs/reckon_fom.xml")):
        words = [path] if program == "reckon_lua_tables" else []
        (copy / path).write_text(run(copy, next(build.rglob(program)), *words).stdout, encoding="utf-8")


def tests(copy, build):
    """Thing -> whether it works."""
    reckon = build / "reckon"
    scene = copy / "build/molasses.toml"
    scene.write_text(re.sub(r"(?m)^surface = ", "molasses = {thickness = 3}\nsurface = ", (copy / "scenes/stiff_wall.toml").read_text(encoding="utf-8"), 1), encoding="utf-8")
    peer = (reckon, "peer", "scenes/two_hands.toml", "--iface", "lo", "--for", "6s", "--json")
    with subprocess.Popen(peer, cwd=copy, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL):
        one = run(copy, *peer)
    held = run(copy, reckon, "demo", "--device", "mock", "--for", "2s", "--json")
    yield "driver", all(('"mock"' in run(copy, reckon, "devices", "--json").stdout, "mock_height" in run(copy, reckon, "scene", "keys").stdout, "a mock is held" in held.stderr))
    yield "mechanism that acts", max(map(int, re.findall(r'"acts_refuse_kind":(\d+)', one.stdout)), default=0) > 0
    yield "mechanism that watches", "octets of type 1: " in one.stderr
    study = run(copy, reckon, "bench", "euler", "--json").stdout
    yield "study", [json.loads(line)["step_s"] for line in study.splitlines()] == [0.1, 0.01]
    yield "effect", all(("molasses" in run(copy, reckon, "scene", "explain", scene).stdout, run(copy, reckon, "demo", scene, "--for", "2s")))
    yield "verb", run(copy, reckon, "greet").stdout == "good day\n" and "greet" in run(copy, reckon, "help").stdout
    passed = run(copy, build / "tests/pdu/pdu_tests", "--gtest_filter=*EveryPdu*time_exchange*:WireFormatDocument*").stdout
    yield "field of a PDU", bool(re.search(r"PASSED  \] [1-9]\d+ tests", passed))


def main(arguments):
    root = Path(arguments[0]).resolve()
    copy = root / "build/additions"
    build = copy / "build/release"
    make_copy(root, copy)
    for thing, _, new, _, edits in THINGS:
        add(copy, new, edits)
        git(copy, "add", "-A")
        git(copy, "commit", "-qm", thing)
    for check in ("names", "layering"):
        run(copy, sys.executable, "-B", f"tests/{check}.py", ".")
    os.environ.setdefault("CCACHE_BASEDIR", str(copy))
    subprocess.run([copy / "run", "build", *TARGETS], check=True)
    print_pages(copy, build)
    works = dict(tests(copy, build))
    printed = {path: git(copy, "diff", "-U0", "--", path) for path in git(copy, "diff", "--name-only").split()}

    good = True
    print("| thing | works | new files | row | CMake line | beside | printed | lines |\n|---|---|---|---|---|---|---|---|")
    for at, (thing, word, _, row, _) in enumerate(THINGS):
        commit = f"HEAD~{len(THINGS) - 1 - at}"
        edited = dict(line.split("\t")[::-1] for line in git(copy, "show", "--format=", "--name-status", commit).splitlines())
        lines = sum(int(line.split("\t")[0]) for line in git(copy, "show", "--format=", "--numstat", commit).splitlines())
        new = [path for path, letter in edited.items() if letter == "A"]
        beside = [path for path in edited if path not in (*new, row) and not path.endswith(CMAKE)]
        pages = [path for path, text in printed.items() if re.search(rf"(?m)^\+.*{word}", text)]
        good &= works[thing] and len(beside) <= (0 if thing != "field of a PDU" else 2)
        cells = [", ".join(new), row, ", ".join(path for path in edited if path.endswith(CMAKE)), f"{len(beside)} {', '.join(beside)}".strip(), ", ".join(pages), str(lines)]
        print(f"| {thing} | {'yes' if works[thing] else 'NO'} | {' | '.join(cells)} |")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
