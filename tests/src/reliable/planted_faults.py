# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Plants faults in copies of src/reliable and src/objects, one at a time. The tests of these rooms must find each one.
This is `./run soak planted`.

  planted_faults.py BUILD [NAME]  builds in BUILD/planted on BUILD/release, prints a table; status 1 if a fault was not found
  planted_faults.py --check       status 1, and a line for each, if the text that a fault replaces does not occur exactly once
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
FLAGS = ["-std=c++20", "-O1", "-DNDEBUG", "-DFMT_SHARED", "-ffp-contract=off", "-Wno-subobject-linkage"]
RECORDS, OBJECTS, PACKAGE, RECEIVER = ("reliable/shared_records_test.cpp", "objects/object_exchange_test.cpp",
                                       "objects/scene_package_test.cpp", "objects/scene_receiver_test.cpp")

# Name, tests that find it, file of src, text that occurs once, replacement.
PLANTS = [
    ("older version wins", RECORDS, "reliable/shared_records.cpp", "row->version >= record.version", "row->version < record.version"),
    ("writer decides nothing", RECORDS, "reliable/shared_records.cpp", "row->version >= record.version", "row->version.counter >= record.version.counter"),
    ("counter stays", RECORDS, "reliable/shared_records.cpp", "before->version.counter + 1, epoch_", "before->version.counter, epoch_"),
    ("lost write never requested", RECORDS, "reliable/shared_records.cpp", "    if (writer.ask_at == kNever) writer.ask_at = now + timer_.draw(kLongestWait);\n    writer.missing_since", "    writer.missing_since"),
    ("request sent once", RECORDS, "reliable/shared_records.cpp", "    writer.ask_at = now + writer.pause;\n", "    writer.ask_at = kNever;\n"),
    ("list never repeated", RECORDS, "reliable/shared_records.cpp", "  serials_at_ = now + pause_ + (is_at_rest", "  serials_at_ = kNever - pause_ - (is_at_rest"),
    ("prior always 0", RECORDS, "reliable/shared_records.cpp", "  std::uint32_t prior = row->serials.before(serial);\n  for", "  std::uint32_t prior = row->serials.before(serial);\n  if (prior == 0) return 0;\n  for"),
    ("unknown serials called replaced", RECORDS, "reliable/written_serials.hpp", "return ranges_[i].first - 1;", "return 0;"),
    ("end of a repair not sent", RECORDS, "reliable/shared_records.cpp", "  if (has_last) return;\n", "  if (true) return;\n"),
    ("last write not announced", RECORDS, "reliable/shared_records.cpp", "note_exists(row.last)", "note_exists(row.serial)"),
    ("ranges not joined", RECORDS, "reliable/written_serials.hpp", "ranges_[0].first <= known_ + 1", "ranges_[0].first <= known_"),
    ("only the writer repairs", RECORDS, "reliable/shared_records.cpp", "    repair(row, now);\n", "    if (row.writer == epoch_) repair(row, now);\n"),
    ("digest not compared", RECORDS, "reliable/shared_records.cpp", "if (ours.digest != row.digest) other = row.writer;", "if (false) other = row.writer;"),
    ("lists never suppressed", RECORDS, "reliable/shared_records.cpp", "now - listed_ < kMostPeriods * Nanoseconds(kPeriod)", "false"),
    ("missing writes never given up", RECORDS, "reliable/shared_records.cpp", "now - writer.missing_since > kGivesUp", "false"),
    ("own record after a newer one", RECORDS, "reliable/shared_records.cpp", "  row->due = kNever;\n  if (!std::exchange", "  if (!std::exchange"),
    ("length of a record not checked", RECORDS, "reliable/shared_records.cpp", "if (!fits || head.writer == 0", "if (head.writer == 0"),
    ("chunk of any length", OBJECTS, "objects/object_fetch.cpp", " || octets.size() != layout_.length(index)) {", ") {"),
    ("blocks not checked", OBJECTS, "objects/object_fetch.cpp", "hash_of_block(block_) != list_[block]", "false"),
    ("hash list not checked", OBJECTS, "objects/object_fetch.cpp", "hash_of_object(layout_.size(), list_) != object_", "false"),
    ("forged for ever", OBJECTS, "objects/object_fetch.cpp", "++counts_.forged >= kMostForged", "++counts_.forged == 0"),
    ("sent again while under way", OBJECTS, "objects/object_server.cpp", "if (!is_under_way) served", "if (true) served"),
    ("every holder serves", OBJECTS, "objects/object_server.cpp", "  served->waiting.until = kNever;\n  if (served->serves && epoch < epoch_) stop(*served);\n", ""),
    ("deaf server believed", OBJECTS, "objects/object_server.cpp", "  if (!sends) return;\n", ""),
    ("no other server", OBJECTS, "objects/object_server.cpp", "if (served.waiting.until <= now)", "if (served.waiting.until <= now && served.waiting.request.server == 0)"),
    ("server never stops", OBJECTS, "objects/object_server.cpp", "now - served.requested > kUnwanted", "false"),
    ("rate ignored", OBJECTS, "objects/object_server.cpp", "if (credit_ < static_cast<double>(length)) return false;", ""),
    ("nobody silent after a request", OBJECTS, "objects/object_fetch.cpp", "  if (next < layout_.chunks()) return;\n  asked_ = now;\n  ask_at_ = now + kPeriod;\n", ""),
    ("no random wait", OBJECTS, "objects/object_fetch.cpp", "Nanoseconds(timer_.draw(kLongestWait))", "Nanoseconds(0)"),
    ("serial ignored at a new server", OBJECTS, "objects/object_fetch.cpp", "if (epoch != server_ || is_newer) seen_ = serial;", "if (is_newer) seen_ = serial;"),
    ("kept chunks forgotten", RECEIVER, "objects/chunk_store.cpp", "(words[i / 64] >> (i % 64) & 1) != 0", "false"),
    ("kept chunks misplaced", RECEIVER, "objects/chunk_store.cpp", "static_cast<off_t>(offset + done)", "static_cast<off_t>(done)"),
    ("path leads out", PACKAGE, "objects/scene_package.cpp", "    if (part == \"..\") return \"leads out of the folder\";\n", ""),
    ("absolute path", PACKAGE, "objects/scene_package.cpp", "  if (path.front() == '/') return \"is absolute\";\n", ""),
    ("scene not compared", RECEIVER, "objects/scene_receiver.cpp", "hash != offer.scene_hash", "false"),
    ("scene reads any file", RECEIVER, "objects/scene_receiver.cpp", "load_received_scene(scene.file)", "load_scene_file(scene.file)"),
    ("cache not checked", RECEIVER, "objects/scene_receiver.cpp", "object_of_file(path)->hash() == file.hash", "true"),
]


def complaints():
    """A line for each fault that cannot be planted."""
    for name, _, file, old, new in PLANTS:
        count = (ROOT / "src" / file).read_text(encoding="utf-8").count(old)
        if count != 1 or old == new:
            yield f"{name}: src/{file} has {count} of what it replaces: {old.splitlines()[0].strip()}"


def program_of(plant, folder, release):
    """The tests with copies of both rooms, one of which has the fault."""
    _, tests, file, old, new = plant
    rooms = folder.resolve() / "include/reckon/peer"
    units = []
    for room in ("reliable", "objects"):
        shutil.copytree(ROOT / "src" / room, rooms / room)
        units += sorted((rooms / room).glob("*.cpp"))
    faulty = rooms / file
    faulty.write_text(faulty.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    program = folder / "tests"
    libraries = [release / "src/libreckon_peer.a", release / "tests/libreckon_test_support.a"]
    libraries += [release / f"{name}/libreckon_{name}.a" for name in ("haptics", "aoim", "deadreckon", "pdu")]
    command = ["nice", os.environ.get("CXX", "c++"), *FLAGS, f"-I{folder / 'include'}", f"-I{release / 'include'}", "-isystem", "/usr/include/eigen3",
               ROOT / "tests/src" / tests, *units, "-Wl,--allow-multiple-definition", *libraries, "-lgtest", "-lgtest_main", "-lgmock", "-lfmt", "-lsodium",
               "-ltomlplusplus", "-lpthread", "-lOpenMeshCore", "-lode", "-lpng", "-lz", "-lzstd", "-lpcap", "-lusb-1.0", "-o", program]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"planted_faults.py: '{plant[0]}' does not compile:\n{done.stderr[:3000]}")
    return program


def hunt(plant, build):
    """Row of the table: the fault, and the first test that finds it."""
    program = program_of(plant, build / "planted" / plant[0].replace(" ", "_"), build / "release")
    try:
        told = subprocess.run(["nice", str(program), "--gtest_brief=1"], capture_output=True, text=True, check=False, timeout=300,
                              env=os.environ | {"RECKON_SOAK": "1"})
    except subprocess.TimeoutExpired:
        return plant[0], "a test that never ends"
    found = re.search(r"\[  FAILED  \] (\S+)", told.stdout)
    if found:
        return plant[0], found[1]
    return plant[0], f"signal {-told.returncode}" if told.returncode < 0 else "-"


def main(build, name=""):
    """`build` has release/, built from the current tree."""
    faults = list(complaints())
    for fault in faults:
        print(f"planted_faults.py: {fault}", file=sys.stderr)
    if faults:
        return 1
    shutil.rmtree(build / "planted", ignore_errors=True)
    print("| planted | found by |\n|---|---|", flush=True)
    plants = [plant for plant in PLANTS if name in plant[0]]
    missed = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for row in pool.map(lambda plant: hunt(plant, build), plants):
            print("| {} | {} |".format(*row), flush=True)
            missed += row[1] == "-"
    print(f"{len(plants) - missed} of {len(plants)} found")
    return 1 if missed else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        lines = list(complaints())
        print(*lines, sep="\n")
        sys.exit(1 if lines else 0)
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]), *sys.argv[2:3]))
