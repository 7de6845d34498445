# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Boots a kernel of Debian in an emulated machine (no KVM, no network, no disk) in which Linux' own driver of force
feedback, hid-pidff, drives a wheel that is a program, and libusb a Falcon that is one; Reckon plays at both.
  devices_vm.py --kernel PACKAGE.deb --folder BUILD --reckon PROGRAM --tests PROGRAM.. [--filter PATTERN]"""
import argparse
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys

# In the order in which they are loaded.
MODULES = ["usb/common/usb-common", "usb/core/usbcore", "usb/usbip/usbip-core", "usb/usbip/vhci-hcd", "hid/hid",
           "hid/hid-generic", "hid/usbhid/usbhid", "input/evdev"]
MEMORY = "768M"
# The guest's time follows its executed instructions instead of this machine's clock: one nanosecond for each.
CLOCK = "shift=0,sleep=off"
LONGEST = 540  # [s] on this machine, for the complete run
CURSOR = re.compile(r"\x1b(\[[0-9;?]*[A-Za-z]|c)")  # of a terminal
TROUBLE = re.compile(r"(BUG:|WARNING:|Oops|Call Trace|general protection|Kernel panic|queue full|blocked for more than)")

WHEEL = """# A hand at a wheel
[scene]
name = "wheel"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[[device]]
event = "FFBoard"
event_axes = 1
travel = "0.25 m"
full_force = "15 N"
full_stiffness = "2 kN/m"
max_stiffness = "800 N/m"
max_speed = "0.5 m/s"

[[operator]]
passive = true
"""
WALL = """
[[object]]
name = "wall"
plane = [1.0, 0.0, 0.0]
position = "-5.13 0 0 mm"
surface = {stiffness = "700 N/m"}
"""
HAND = """
[[device]]
peer = {0}

[[operator]]
sweep = {{from = "{1} 0 0 mm", to = "{2} 0 0 mm", period = "0.7 s"}}
"""
CEILING = """
[[object]]
name = "ceiling"
plane = [0.0, -1.0, 0.0]
position = "0 7 0 mm"
surface = {stiffness = "700 N/m"}
"""
FLOOR = """# A hand at a Falcon
[scene]
name = "floor"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[[device]]
driver = "falcon"
firmware = "/tmp/firmware.bin"
damping = "2 N s/m"

[[operator]]
passive = true

[[object]]
name = "floor"
plane = [0.0, 0.0, 1.0]
surface = {stiffness = "400 N/m"}
"""
SCENES = {"wall": WHEEL + WALL, "corner": WHEEL.replace("event_axes = 1", "event_axes = 2") + WALL + CEILING,
          "hands": WHEEL + HAND.format(2, 45, 65) + HAND.format(3, -65, -45), "floor": FLOOR}

INIT = """#!/bin/busybox sh
/bin/busybox mount -t proc none /proc
/bin/busybox mount -t sysfs none /sys
/bin/busybox mount -t devtmpfs none /dev
for module in {modules}; do /bin/busybox insmod /modules/$module.ko || echo "no module $module"; done
/bin/busybox ifconfig lo 127.0.0.1 up
/bin/busybox ip link set lo multicast on
for tests in {tests}; do
  /bin/$tests --gtest_color=no --gtest_filter='{pattern}'
  echo "reckon-vm: status $?"
done
/bin/busybox dmesg | /bin/busybox sed 's/^/dmesg: /'
echo "reckon-vm: end"
/bin/busybox poweroff -f
"""


def unpacked(package, folder):
    """The kernel's image, and the folder of its modules."""
    kernel = folder / "kernel"
    done = folder / "unpacked"
    if not done.exists() or done.read_text() != package.name:
        shutil.rmtree(kernel, ignore_errors=True)
        subprocess.run(["dpkg-deb", "-x", package, kernel], check=True)
        done.write_text(package.name)
    return next(kernel.glob("boot/vmlinuz-*")), next(kernel.glob("lib/modules/*")) / "kernel/drivers"


def copy_program(program, target, root):
    """Copies the program with its shared libraries."""
    shutil.copy(program, target)
    listed = subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout
    for library in re.findall(r"(/[^ ]+)", listed):
        place = root / library[1:]
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(library, place)


def make_root(arguments, drivers, folder):
    """The archive of files that the machine boots from."""
    root = folder / "root"
    shutil.rmtree(root, ignore_errors=True)
    for name in ("bin", "modules", "proc", "sys", "dev", "tmp"):
        (root / name).mkdir(parents=True)
    shutil.copy("/bin/busybox", root / "bin")
    for program in ("reckon", "reckon-peer"):
        copy_program(pathlib.Path(arguments.reckon).with_name(program), root / "bin" / program, root)
    for tests in arguments.tests:
        copy_program(tests, root / "bin" / tests.name, root)
    for module in MODULES:
        shutil.copy(drivers / f"{module}.ko", root / "modules")
    for name, scene in SCENES.items():
        (root / f"{name}.toml").write_text(scene)
    names = " ".join(pathlib.PurePath(module).name for module in MODULES)
    init = root / "init"
    init.write_text(INIT.format(modules=names, tests=" ".join(tests.name for tests in arguments.tests), pattern=arguments.filter))
    init.chmod(init.stat().st_mode | stat.S_IXUSR)
    archive = folder / "root.cpio.gz"
    files = subprocess.run(["find", "."], cwd=root, check=True, capture_output=True).stdout
    packed = subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], cwd=root, input=files, check=True, stdout=subprocess.PIPE).stdout
    archive.write_bytes(subprocess.run(["gzip", "-1"], input=packed, check=True, stdout=subprocess.PIPE).stdout)
    return archive


def boot(image, archive, log):
    """Boots the machine and returns its console output, line by line; the machine ends by itself."""
    command = ["timeout", str(LONGEST), "qemu-system-x86_64", "-accel", "tcg", "-icount", CLOCK, "-cpu", "max", "-smp", "1", "-m", MEMORY,
               "-nographic", "-no-reboot", "-nic", "none", "-kernel", str(image), "-initrd", str(archive),
               "-append", "console=ttyS0 quiet panic=1"]
    lines = []
    with open(log, "w", encoding="utf-8") as file, subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, errors="replace") as machine:
        for line in machine.stdout:
            line = CURSOR.sub("", line.rstrip("\r\n"))
            file.write(line + "\n")
            file.flush()
            lines.append(line)
            if not line.startswith("dmesg: "):
                print(line, flush=True)
    return lines, machine.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("kernel", "folder", "reckon"):
        parser.add_argument(f"--{name}", required=True, type=pathlib.Path)
    parser.add_argument("--tests", required=True, nargs="+", type=pathlib.Path)
    parser.add_argument("--filter", default="*")
    arguments = parser.parse_args()
    image, drivers = unpacked(arguments.kernel, arguments.folder)
    log = arguments.folder / "machine.log"
    lines, status = boot(image, make_root(arguments, drivers, arguments.folder), log)
    faults = [line for line in lines if TROUBLE.search(line)]
    for line in faults:
        print(line)
    is_whole = "reckon-vm: end" in lines
    counted = any(re.match(r"\[  PASSED  \] [1-9]", line) for line in lines)  # a pattern may match no test
    good = lines.count("reckon-vm: status 0") == len(arguments.tests)
    passed = counted and good and not any("[  SKIPPED ]" in line for line in lines)
    if not is_whole:
        print(f"the machine did not come to its end within {LONGEST} s" if status == 124 else f"the machine ended early, status {status}")
    print(f"{image.name}: {'passed' if passed and is_whole and not faults else 'FAILED'}; all that it said is in {log}")
    return 0 if passed and is_whole and not faults else 1


if __name__ == "__main__":
    sys.exit(main())
