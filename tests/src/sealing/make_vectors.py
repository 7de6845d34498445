#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Prints the sealed datagrams of sealing_key_test.cpp, made without libsodium: BLAKE2b from Python's hashlib,
AES-256-GCM and ChaCha20-Poly1305 from OpenSSL (through the module `cryptography`), HChaCha20 below, according to
draft-irtf-cfrg-xchacha-03, 2.2.

    python3 tests/src/sealing/make_vectors.py
"""
import hashlib
import struct

from cryptography.hazmat.primitives.ciphers.aead import AESGCM, ChaCha20Poly1305

SECRET = bytes(range(32))
TO = struct.pack(">BBH16s", 4, 9, 3001, bytes((239, 192, 1, 7)))  # IPv4 group, exercise, port, address
PLAIN = bytes((7 * i + 3) % 256 for i in range(45))


def hchacha20(key, nonce16):
    def rotate(x, by):
        return (x << by | x >> (32 - by)) & 0xFFFFFFFF

    s = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574, *struct.unpack("<8I", key), *struct.unpack("<4I", nonce16)]

    def quarter(a, b, c, d):
        for x, y, z, by in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            s[x] = (s[x] + s[y]) & 0xFFFFFFFF
            s[z] = rotate(s[z] ^ s[x], by)

    for _ in range(10):
        for at in ((0, 4, 8, 12), (1, 5, 9, 13), (2, 6, 10, 14), (3, 7, 11, 15),
                   (0, 5, 10, 15), (1, 6, 11, 12), (2, 7, 8, 13), (3, 4, 9, 14)):
            quarter(*at)
    return struct.pack("<8I", *s[:4], *s[12:])


def sealed(suite, epoch, site, application, boot, stream, count, stamp, salt):
    header = struct.pack(">BBHHHQQLQ", 0xE7, suite, epoch, site, application, boot, stream << 48 | count, stamp, salt)
    sequence, stamped, salted = header[16:24], header[24:28], header[28:]
    named = header[1:16] + (salted if suite == 0x11 else b"")
    key = hashlib.blake2b(named, digest_size=32, key=SECRET).digest()
    if suite == 0x11:
        return header + AESGCM(key).encrypt(stamped + sequence, PLAIN, header[:16] + TO)
    nonce = salted + bytes(4) + stamped + sequence
    return header + ChaCha20Poly1305(hchacha20(key, nonce[:16])).encrypt(bytes(4) + nonce[16:], PLAIN, header[:16] + TO)


# draft-irtf-cfrg-xchacha-03, 2.2.1
assert hchacha20(bytes(range(32)), bytes.fromhex("000000090000004a0000000031415927")).hex() == \
    "82413b4227b27bfed30e42508a877d73a0f9e4d58a74a853c12ec41326d3ecdc"
for name, suite in ("aes", 0x11), ("xchacha", 0x12):
    for arguments in ((1, 1, 1, 0x0123456789ABCDEF, 0, 1, 0x01020304, 0x1122334455667788),
                      (0xFFFE, 700, 65535, 0xFEDCBA9876543210, 1, (1 << 40) - 1, 0xFFFFFFFF, 0x8877665544332211)):
        print(name, *arguments, sealed(suite, *arguments).hex())
