#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds what has a row of its own to its own files: nothing else in product code names it.

  names.py ROOT            status 1, and a line for each fault: place, name, remedy
  names.py ROOT --planted  plants a fault of each kind, in memory, and wants each to be found

The names come from the rows in LISTS. They count as identifiers, literals and includes; comments do not count.
  driver     NAME_.. and Name..; "NAME", `driver = "NAME"`, `--device NAME`; headers of its rooms: haptics/NAME/ and those
             that it includes and no other room of haptics
  mechanism  its function if that has a file of its own, else the classes that it makes, and their headers; "acts_NAME"
  effect     its class and header; its kName if that has two words; a look-up of its kKey, as in has("border")
  study      NAME_study and NameStudy; headers of its folder; `bench NAME`. In its list's file `bench NAME` is in its row alone
bench/micro/ is free, as tests are: it measures single things."""
import re
import sys
from collections import Counter
from functools import cache
from pathlib import Path

PRODUCT = ("pdu", "aoim", "deadreckon", "haptics", "src", "tools", "bench", "python")
FREE = ("bench/micro/", "tools/viewer/page/third_party/")
# Kind -> file of the list, its text, a row, and the remedy where another names it.
LISTS = {
    "driver": ("src/drivers/drivers.cpp", r"kAll\{(.*?)\};", r"&(\w+)_driver\(\)",
               "give Driver (src/drivers/driver.hpp) a member and ask that"),
    "mechanism": ("src/loops/peer_hooks.cpp", r"kHookRows\[\]\{(.*?)\};", r'\{"(\w+)", \w+, \w+\}',
                  "leave it to its hooks, or share what is common in a file of its own"),
    "effect": ("haptics/effects/effect_types.hpp", r"EffectTypes = std::tuple<(.*?)>;", r"\w+",
               "give effect_hooks.hpp a concept and ask that"),
    "effect of a region": ("haptics/regions/region_types.hpp", r"RegionTypes = std::tuple<(.*?)>;", r"\w+",
                           "give region_hooks.hpp a concept and ask that"),
    "study": ("bench/verbs/bench.cpp", r"kStudies\{(.*?)\n\};", r'StudyKind\{\s*"(\w+)"',
              "ask the rows of kStudies, or move what is common to a room of its own"),
}
# File -> mentions of effects that it may have; they may only shrink. A study of effects gives each its values. Each
# surface has a spring and may have friction: patches, scene hash and page know both.
EXCEPTIONS = {
    "bench/studies/figures/interactions.cpp": 2, "bench/studies/touch/effects_axis.cpp": 22, "bench/studies/zwidth/device_border.cpp": 1,
    "haptics/contact/felt_object.cpp": 2, "haptics/scene/effect_plan.cpp": 2, "haptics/scene/surface_patches.cpp": 4,
    "haptics/servo/spring_scene.cpp": 1, "src/scene/object_section.cpp": 8, "src/scene/scene_hash.cpp": 2,
    "src/scene/scene_keys.cpp": 4, "tools/verbs/scene_stiffness.cpp": 1, "tools/viewer/scenery/solid_shapes.cpp": 2,
}
TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)|\#[ ]*include[ ]*"reckon/(?P<include>[^"]+)"|\b\d[\w.']*|visitor\("\w+\""""
    r"""|\b(?:has|table|require|problem)\(\s*"(?P<key>\w+)"|R"(?P<end>\w*)\((?P<raw>.*?)\)(?P=end)\""""
    r"""|"(?P<literal>(?:\\.|[^"\\\n])*)"|'(?P<short>(?:\\.|[^'\\\n])*)'|(?P<word>[A-Za-z_]\w*)""", re.S)


@cache
def tokens(text):
    """(kind, token) -> its lines."""
    found, line, at = {}, 1, 0
    for token in TOKEN.finditer(text):
        kind = token.lastgroup
        if kind not in (None, "comment"):
            line, at = line + text.count("\n", at, token.start()), token.start()
            found.setdefault(("literal" if kind in ("raw", "short") else kind, token[kind]), []).append(line)
    return found


@cache
def rooms_of(text):
    """The rooms that it includes."""
    return {token.split("/")[1] for kind, token in tokens(text) if kind == "include" and token.count("/") == 2}


def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


def driver(files, name):
    own = rf"src/drivers/{name}(_\w+)?\.[ch]pp"
    rooms, shared = {name}, set()  # rooms of haptics that its files include, and those that other rooms of haptics do
    for path, text in files.items():
        for room in rooms_of(text):
            if re.fullmatch(own, path):
                rooms.add(room)
            elif path.startswith("haptics/") and path.split("/")[1] != room:
                shared.add(room)
    rooms = "|".join({name, *(rooms - shared)})
    return rf"{own}|haptics/({rooms})/.*", {
        "word": rf"{name}_\w+|{camel(name)}[A-Z]\w*", "include": rf"haptics/({rooms})/.*|peer/drivers/{name}(_\w+)?\.hpp",
        "literal": rf'{name}|(.*[^\w])?(driver = \\?"|--device ){name}\b.*'}


def mechanism(files, name):
    hooks = files[LISTS["mechanism"][0]]
    function = re.search(rf'\{{"{name}", \w+, (\w+)\}}', hooks)[1]
    begin = re.compile(rf"^PeerHooks {function}\([^)]*\) \{{.*?^\}}", re.M | re.S)
    body = begin.search(hooks)
    words = set(re.findall(r"make_shared<(\w+)>", body[0])) if body else {function}
    stems = {re.sub(r"(?<=[a-z])(?=[A-Z])", "_", word).lower() for word in words}
    if not body:
        stems |= {Path(path).stem for path, text in files.items() if begin.search(text)}
    stems = "|".join(stems)
    return rf"src/loops/({stems})\.[ch]pp", {
        "word": "|".join(words), "include": rf"peer/loops/({stems})\.hpp", "literal": f"acts_{name}"}


def effect(files, name):
    home, text = next(item for item in files.items() if item[0].startswith("haptics/") and f"class {name} : public CountedEffect" in item[1])
    known = dict(re.findall(r'(kName|kKey) = "(\w+)"', text))
    literal = known["kName"] if "_" in known["kName"] else name
    return re.escape(home), {"word": name, "include": re.escape(home), "key": known["kKey"], "literal": literal}


def study(_, name):
    home = f"bench/studies/{name}/.*"
    return home, {"word": f"{name}_study|{camel(name)}Study", "include": home, "literal": rf"(.*\W)?bench {name}\b.*"}


MAKERS = {"driver": driver, "mechanism": mechanism, "effect": effect, "effect of a region": effect, "study": study}


def things(files):
    """Kind, name, pattern of the paths that may have its names, and patterns of these by kind of token."""
    for kind, (path, rows, row, _) in LISTS.items():
        listed = re.search(rows, files[path], re.S)
        for name in re.findall(row, listed[1]) if listed else []:
            yield kind, name, *MAKERS[kind](files, name)


def mentions(files, all_things):
    """Path -> of what its lines name and may not: kind, name, lines."""
    found, of_token = {}, {}
    for path, text in files.items():
        for _, rows, *_ in (row for row in LISTS.values() if row[0] == path):
            # A file of a list may name all of it, but literals are in the rows alone.
            text = re.sub(rows, lambda listed: "\n" * listed[0].count("\n"), text, flags=re.S)
        for token, lines in tokens(text).items():
            if token not in of_token:
                of_token[token] = [thing for thing in all_things if token[0] in thing[3] and re.fullmatch(thing[3][token[0]], token[1])]
            for kind, name, home, _ in of_token[token]:
                if not re.fullmatch(home, path) and (path != LISTS[kind][0] or token[0] == "literal"):
                    found.setdefault(path, []).append((kind, name, lines))
    return found


def faults(files, exceptions):
    all_things = list(things(files))
    for kind, (path, *_) in LISTS.items():
        if not any(thing[0] == kind for thing in all_things):
            yield f"{path}: has no row of a {kind} as LISTS of tests/names.py reads them: adapt it"
    found = mentions(files, all_things)
    for path in {*found, *exceptions}:
        count, most = sum(len(lines) for *_, lines in found.get(path, [])), exceptions.get(path, 0)
        if count < most:
            yield f"{path}: EXCEPTIONS of tests/names.py allows {most} mentions, it has {count}: lower it there"
        for kind, name, lines in found.get(path, []) if count > most else []:
            yield f"{path}:{', '.join(map(str, lines))}: names the {kind} {name}: {LISTS[kind][3]}"


# File, text that is planted at its end, and what the fault says; nothing: there is none.
PLANTED = [
    ("tools/verbs/devices.cpp", 'auto f = "falcon";', "the driver falcon"),
    ("src/scene/scene_file.cpp", 'const char* f = "try driver = \\"polhem\\" there";', "the driver polhem"),
    ("tools/verbs/doctor.cpp", 'const char* f = "reckon demo --device falcon";', "the driver falcon"),
    ("src/threads/servo_thread.cpp", "void f() { evdev_driver(); }", "the driver evdev"),
    ("haptics/servo/safety.cpp", '#include "reckon/haptics/polhem/polhem_arm.hpp"', "the driver polhem"),
    ("src/peer.cpp", '#include "reckon/haptics/hid/hid_events.hpp"', "the driver evdev"),
    ("tools/exercise/real_devices.cpp", '#include "reckon/peer/drivers/serial.hpp"', "the driver serial"),
    ("src/loops/model_loop.cpp", "LossWatch watch_;", "the mechanism losses"),
    ("src/peer.cpp", '#include "reckon/peer/loops/channel_keeper.hpp"', "the mechanism channels"),
    ("tools/exercise/run_summary.cpp", 'auto f = "acts_budget";', "the mechanism budget"),
    ("haptics/contact/felt_object.cpp", "Texture texture_;", "the effect Texture"),
    ("src/scene/scene_hash.cpp", 'const char* f = "tap_vibration";', "the effect TapVibration"),
    ("src/scene/region_section.cpp", 'bool f() { return table.has("magnet"); }', "the effect of a region Attraction"),
    ("src/peer.cpp", '#include "reckon/haptics/regions/viscosity.hpp"', "the effect of a region Viscosity"),
    ("bench/studies/tune/run.cpp", '#include "reckon/bench/studies/scale/run.hpp"', "the study scale"),
    ("bench/verbs/bench.cpp", 'const char* f = "name one: reckon bench accuracy";', "the study accuracy"),
    ("bench/program.cpp", "class StabilityStudy {};", "the study stability"),
    ("src/peer.cpp", "// As the Falcon's falcon_driver(), \"falcon\".\n/* LossWatch */", None),
    ("src/peer.cpp", 'auto f = "a serial line", g = "spring", h = "link"; int falcon = 1\'000, skin = 0;', None),
    ("src/loops/loss_watch.cpp", "LossWatch watch_;", None),
]


def missed_plants(files):
    for path, plant, wanted in PLANTED:
        new = [fault for fault in faults({**files, path: f"{files[path]}{plant}\n"}, EXCEPTIONS) if fault.startswith(path)]
        if any(f"names {wanted}:" in fault for fault in new) != bool(wanted) or not wanted and new:
            yield f"{path} with {plant!r}: wanted {wanted}, found {new or 'nothing'}"
    for kind, (path, *_) in LISTS.items():
        if not any(f"no row of a {kind} " in fault for fault in faults({**files, path: ""}, EXCEPTIONS)):
            yield f"not found: the list of each {kind} is gone"
    if not any("lower it" in fault for fault in faults(files, {**EXCEPTIONS, "src/peer.cpp": 1})):
        yield "not found: an exception that is not needed"


def main(arguments):
    root = Path(arguments[0])
    paths = [path for top in PRODUCT for path in sorted((root / top).rglob("*")) if path.suffix in (".cpp", ".hpp", ".h", ".js", ".py")]
    files = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    files = {path: text for path, text in files.items() if not path.startswith(FREE)}
    found = list(missed_plants(files) if "--planted" in arguments else faults(files, EXCEPTIONS))
    print("\n".join(found) or ", ".join(f"{kind}: {count}" for kind, count in Counter(thing[0] for thing in things(files)).items()))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
