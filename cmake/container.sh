#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
# container.sh BUILD FOLDER: makes FOLDER/reckon.tar, a container image of the programs of a build folder, their scenes and
# the Debian libraries that they need, without a shell. ./run container calls it. Rootless where mmdebstrap and buildah are.
set -euo pipefail

build=$(realpath -- "$1") folder=$(realpath -m -- "$2")
fail() { printf 'container.sh: %s\n' "$@" >&2; exit 1; }
stage=$folder/stage
rm -rf -- "$stage"
mkdir -p "$stage/tmp" "$folder/debian"
chmod 1777 "$stage/tmp"
DESTDIR=$stage cmake --install "$build" --prefix /usr --component program >"$folder/install.log" ||
  fail "CMake could not install; see $folder/install.log"

# The packages of the libraries, as dpkg-shlibdeps finds them for the Debian package. The programs load libarchive when they need
# it. The terminals are for the live tables.
printf 'Source: reckon\n\nPackage: reckon\nArchitecture: any\nDescription: reckon\n' >"$folder/debian/control"
programs=("$stage"/usr/bin/*)
needs=$(cd "$folder" && dpkg-shlibdeps -O --ignore-missing-info "${programs[@]/#/-e}" 2>"$folder/libraries.log" |
  sed -n 's/^shlibs:Depends=//p' | sed 's/ ([^)]*)//g; s/ //g') || true
[[ -n $needs ]] || fail "dpkg-shlibdeps names no package; see $folder/libraries.log"

suite=$(. /etc/os-release && printf %s "${VERSION_CODENAME-}")
[[ -n $suite ]] || fail "/etc/os-release names no Debian release (VERSION_CODENAME)"
rm -f -- "$folder/root.tar" "$folder/reckon.tar"
mmdebstrap --quiet --variant=extract --include="$needs,libarchive13,ncurses-base" "$suite" "$folder/root.tar" 2>"$folder/root.log" ||
  { tail -n 5 "$folder/root.log" >&2; fail "mmdebstrap could not make the root; see $folder/root.log"; }

printf 'FROM scratch\nADD root.tar /\nCOPY stage /\nENTRYPOINT ["/usr/bin/reckon"]\nCMD ["help"]\n' >"$folder/Containerfile"
# A store of its own: nothing outside the folder is written. vfs needs no overlay of the kernel.
store=(--root "$folder/store" --runroot "$folder/store/run" --storage-driver vfs)
version=$("$build/reckon" --version | awk '{ print $2 }')
{
  buildah "${store[@]}" build --isolation chroot -t "reckon:$version" -f "$folder/Containerfile" "$folder" &&
    buildah "${store[@]}" push "reckon:$version" "docker-archive:$folder/reckon.tar:reckon:$version"
} >"$folder/image.log" 2>&1 || { tail -n 5 "$folder/image.log" >&2; fail "buildah could not make the image; see $folder/image.log"; }
buildah "${store[@]}" rmi --all --force >>"$folder/image.log" 2>&1 || true
rm -rf -- "$stage" "$folder/root.tar"
printf '%s: podman load -i %s, then podman run --rm -it --network host reckon:%s demo\n' "$folder/reckon.tar" "$folder/reckon.tar" "$version"
