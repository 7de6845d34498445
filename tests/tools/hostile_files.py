# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Hostile files, each read by the program in a separate process: hostile_files.py RECKON [NAME..]. Each file is
refused (exit 1 or 2) with a sentence that names the file, or loaded if it is within the bounds of docs/robustness.md,
in at most 1 s of CPU time and 200 MB, a large mesh in LARGE_MESH. Exit 0: all pass; 1: a case fails; a table shows which.
"""
import dataclasses
import os
import pathlib
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import zlib

LARGE_MESH = (5.0, 700)  # of 5 million triangles: CPU time [s], memory [MB]
MOST_WALL_S = 120  # on a busy machine; a blocked file uses no CPU time


@dataclasses.dataclass
class Hostile:
    """A file in the folder of a case, and the command line that reads it."""
    make: object  # folder -> name of the file that the sentence must contain
    verb: tuple = ("scene", "check")
    loads: bool = False  # whether it is within the bounds, although expensive
    most: tuple = (1.0, 200)  # CPU time [s], memory [MB]


def write(folder, name, data):
    (folder / name).write_bytes(data.encode() if isinstance(data, str) else data)
    return name


def scene(text):
    return Hostile(lambda folder: write(folder, "scene.toml", text() if callable(text) else text))


def with_file(name, data, table, count=1, loads=False, blamed=0):
    """A scene that names `count` files, in the table with {file}; the sentence must name number `blamed`."""
    def make(folder):
        named = name.format(blamed)
        for i in range(count):
            written = data(folder / name.format(i))
            if written is not None:
                write(folder, name.format(i), written)
        write(folder, "scene.toml", "".join(table.format(file=name.format(i), i=i) for i in range(count)))
        return named
    return Hostile(make, loads=loads)


MESH = '[[object]]\nname = "o{i}"\nmesh = "{file}"\n'
HEIGHTS = '[[object]]\nname = "o{i}"\nheights = {{ file = "{file}", width = "1 m" }}\n'
RELIEF = '[[object]]\nname = "o{i}"\nsphere = "5 cm"\nrelief = {{ file = "{file}" }}\n'
TRACK = '[[entity]]\ntrack = "{file}"\n'
DENSITY = '[aoim]\nscheme = "quadtree"\n[aoim.quadtree]\nside = "4 km"\nreach = "200 m"\ndensity = "{file}"\n'


def mesh(name, data):
    return with_file(name, lambda _: data() if callable(data) else data, MESH)


def png(width, height, packed=None):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = packed if packed is not None else zlib.compress(bytes((width + 1) * height), 9)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", rows) + chunk(b"IEND", b""))


def packed_zeros(octets):
    packer, out = zlib.compressobj(9), b""
    for _ in range(octets >> 20):
        out += packer.compress(bytes(1 << 20))
    return out + packer.flush()


def polygon(corners):
    """One face that crosses itself everywhere."""
    vertices = "".join(f"v {(i * 7919) % 10007} {(i * i) % 10009} 0\n" for i in range(corners))
    return vertices + "f " + " ".join(str(i + 1) for i in range(corners)) + "\n"


def comb(corners, faces=1):
    """Faces whose ears are hard to find: teeth of a comb, whose points occlude each other."""
    vertices = "".join(f"v {i} {i % 2 * 1000 + i * i % 7} 0\n" for i in range(corners - 2))
    vertices += f"v {corners} -10 0\nv 0 -10 0\n"
    face = "f " + " ".join(str(i) for i in range(corners, 0, -1)) + "\n"
    return vertices + face * faces


def track(rows):
    return "t_s,px_m,py_m,pz_m\n" + "".join(f"{i},{i % 977},{i % 983},0\n" for i in range(rows))


def chain(nodes):
    return '[[node]]\nname = "n0"\n' + "".join(
        f'[[node]]\nname = "n{i}"\nuse = "n{i - 1}"\n' for i in range(1, nodes))


def cycle(nodes):
    return "".join(f'[[node]]\nname = "n{i}"\nuse = "n{(i + 1) % nodes}"\n' for i in range(nodes))


def link(target):
    return lambda path: os.symlink(target, path)


def deep_tables():
    part = ".".join("a" * 30)
    return "x = " + f"{{ {part} = " * 200 + "1" + " }" * 200 + "\n"


HOSTILE = {
    "dotted_key_62_kB": scene(lambda: ".".join(["a"] * 30927) + " = 1\n"),
    "dotted_key_1_MB": scene(lambda: ".".join(["a"] * 500_000) + " = 1\n"),
    "dotted_header": scene(lambda: "[" + ".".join(["a"] * 30927) + "]\nb = 1\n"),
    "dotted_header_of_array": scene(lambda: "[[" + ".".join(["'a'"] * 20000) + "]]\nb = 1\n"),
    "dotted_keys_in_inline_tables": scene(deep_tables),
    "nested_arrays": scene("x = " + "[" * 100_000 + "]" * 100_000 + "\n"),
    "nested_inline_tables": scene("x = " + "{a=" * 100_000 + "1" + "}" * 100_000 + "\n"),
    "unknown_keys_100_000": scene(lambda: "".join(f"radios{i} = 1\n" for i in range(100_000))),
    "unknown_parents_50_000": scene(lambda: "".join(
        f'[[node]]\nname = "n{i}"\nparent = "m{i}"\n' for i in range(50_000))),
    "scene_of_30_MB": scene(lambda: "# " + "a" * 30_000_000 + "\n"),
    "scene_of_4_million_values": scene(lambda: "x = [" + "1," * 4_000_000 + "]\n"),
    "use_chain_100_000": scene(lambda: chain(100_000)),
    "use_chain_1_000": scene(lambda: chain(1000)),
    "use_cycle": scene(lambda: cycle(50_000)),
    "copies_2_to_the_30": scene(lambda: '[[node]]\nname = "n0"\n' + "".join(
        f'[[node]]\nname = "n{i}"\n[[node]]\nname = "a{i}"\nparent = "n{i}"\nuse = "n{i - 1}"\n'
        f'[[node]]\nname = "b{i}"\nparent = "n{i}"\nuse = "n{i - 1}"\n' for i in range(1, 31))),
    "objects_at_one_place_20_000": Hostile(lambda folder: write(folder, "scene.toml", "".join(
        f'[[object]]\nname = "o{i}"\nsphere = 1\n' for i in range(20_000))), loads=True),
    "nodes_without_name_250_000": scene(lambda: "[[node]]\n" * 250_000),
    "scene_is_zero": Hostile(lambda folder: os.symlink("/dev/zero", folder / "scene.toml") or "scene.toml"),
    "scene_is_fifo": Hostile(lambda folder: os.mkfifo(folder / "scene.toml") or "scene.toml"),
    "face_of_5_000_crossing": with_file("face.obj", lambda _: polygon(5000), MESH, loads=True),
    "face_of_300_000_crossing": mesh("face.obj", lambda: polygon(300_000)),
    "face_of_9_900_crossing": with_file("face.obj", lambda _: polygon(9900), MESH, loads=True),
    "comb_of_9_900": with_file("comb.obj", lambda _: comb(9900), MESH, loads=True),
    "combs_of_9_000_x_300": mesh("comb.obj", lambda: comb(9000, 300)),
    "off_of_1e9_vertices": mesh("a.off", "OFF\n1000000000 1000000000 0\n0 0 0\n"),
    "off_face_of_1e9_corners": mesh("a.off", "OFF\n1 1 0\n0 0 0\n1000000000 0 0 0\n"),
    "ply_of_1e9_vertices": mesh("a.ply", "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\n"
                                "property float y\nproperty float z\nend_header\n0 0 0\n"),
    "ply_of_1e18_empty_elements": mesh("a.ply", "ply\nformat ascii 1.0\nelement e 1000000000000000000\n"
                                       "property list uchar int l\nend_header\n0\n"),
    "stl_of_4e9_facets": mesh("a.stl", bytes(80) + struct.pack("<I", 4_000_000_000) + bytes(500)),
    "obj_of_11_million_triangles": dataclasses.replace(mesh("a.obj", lambda: "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 11_000_000), most=LARGE_MESH),
    "mesh_is_zero": with_file("a.obj", link("/dev/zero"), MESH),
    "mesh_is_fifo": with_file("a.obj", os.mkfifo, MESH),
    "mesh_is_kernel_log": with_file("a.obj", link("/proc/kmsg"), MESH),
    "mesh_is_folder": with_file("a.obj", os.mkdir, MESH),
    "mesh_of_4_GB_hole": with_file("a.stl", lambda path: path.touch() or os.truncate(path, 4 << 30), MESH),
    "png_1_Mpixel_x_8": with_file("p{}.png", lambda _: png(1024, 1024), HEIGHTS, 8, blamed=5),
    "png_16_Mpixel_x_8": with_file("p{}.png", lambda _: png(4096, 4096), RELIEF, 8, blamed=1),
    "png_of_1_GB_rows": with_file("p.png", lambda _: png(64, 64, packed_zeros(1 << 30)), HEIGHTS),
    "png_of_2e9_pixels": with_file("p.png", lambda _: png(2**31 - 1, 1, b""), HEIGHTS),
    "track_of_2e6_rows": with_file("t.csv", lambda _: track(2_000_000), TRACK),
    "tracks_of_20_000_rows_x_100": with_file("t{}.csv", lambda _: track(20_000), TRACK, 100, blamed=50),
    "track_of_one_endless_line": with_file("t.csv", lambda _: "t_s," + "a" * 50_000_000, TRACK),
    "track_is_zero": with_file("t.csv", link("/dev/zero"), TRACK),
    "density_of_1e6_places": with_file("d.csv", lambda _: "x_m,y_m\n" + "1,1\n" * 1_000_000, DENSITY),
    "density_is_random": with_file("d.csv", link("/dev/random"), DENSITY),
    "key_is_zero": Hostile(lambda folder: write(folder, "scene.toml", "") and
                           os.symlink("/dev/zero", folder / "k.key") or "k.key",
                           ("peer", "--key", "k.key", "--for", "1s")),
    "descriptor_of_deep_keys": Hostile(lambda folder: write(folder, "d.toml", ".".join(["a"] * 30927) + " = 1\n"),
                                       ("devices", "describe")),
    "descriptor_is_fifo": Hostile(lambda folder: os.mkfifo(folder / "d.toml") or "d.toml", ("devices", "describe")),
}


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (20, 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(reckon, folder, case):
    """Exit status, text, CPU seconds and peak memory of one call [MB]."""
    named = case.make(folder)
    given = named if case.verb[0] == "devices" else "scene.toml"
    log = folder / "log"
    with log.open("wb") as out:
        process = subprocess.Popen([reckon, *case.verb, given], cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=out, preexec_fn=limit)
        watch = threading.Timer(MOST_WALL_S, process.kill)
        watch.start()
        _, status, used = os.wait4(process.pid, 0)
        watch.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return named, process.returncode, log.read_text(errors="replace"), used.ru_utime + used.ru_stime, used.ru_maxrss / 1e3


def faults_of(named, status, text, cpu, memory, case):
    faults = []
    if case.loads and status != 0:
        faults.append(f"exit {status} of a file within the bounds")
    if not case.loads and status not in (1, 2):
        faults.append(f"exit {status}: it is not refused")
    if not case.loads and named not in text:
        faults.append("the sentence does not name the file")
    if cpu > case.most[0]:
        faults.append(f"{cpu:.1f} s of CPU time")
    if memory > case.most[1]:
        faults.append(f"{memory:.0f} MB")
    return faults


def main():
    reckon, names, bad = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] or list(HOSTILE), 0
    for name in names:
        with tempfile.TemporaryDirectory(prefix="hostile_") as folder:
            result = run(reckon, pathlib.Path(folder), HOSTILE[name])
        faults = faults_of(*result, HOSTILE[name])
        bad += bool(faults)
        sentence = result[2].strip().splitlines()[0] if result[2].strip() else ""
        print(f"{name:32} exit {result[1]:3} {result[3]:6.2f} s {result[4]:7.1f} MB  "
              f"{'; '.join(faults) or 'good'}  | {sentence[:150]}", flush=True)
    print(f"{len(names)} files, {bad} at fault")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
