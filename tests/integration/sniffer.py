# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Observers that see each frame at an interface: what they missed, and one that keeps all. Standard library."""
import socket
import struct
import threading
import time

import dis_wire as dis

SOL_PACKET, PACKET_STATISTICS, SO_RCVBUFFORCE = 263, 6, 33


class Drops:
    """Frames that the kernel had no room for in a socket of AF_PACKET."""

    def __init__(self, sock):
        self._socket, self._count = sock, 0

    def count(self):
        """Since the start. One thread."""
        octets = self._socket.getsockopt(SOL_PACKET, PACKET_STATISTICS, 8)
        self._count += struct.unpack("II", octets)[1]  # asking sets the kernel's count to zero
        return self._count


class Sniffer:
    """Records every UDP datagram to a multicast group that enters a port of the switch."""

    def __init__(self, sock):
        self._socket = sock
        self._socket.settimeout(0.1)
        self._running = True
        self._drops = Drops(sock)
        self.datagrams = []  # (monotonic time, sender, group, payload)
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        while self._running:
            try:
                frame, address = self._socket.recvfrom(65536)
            except socket.timeout:
                continue
            if address[2] == socket.PACKET_OUTGOING or not address[0].startswith("p"):
                continue
            datagram = dis.udp_of_frame(frame)
            if datagram and 224 <= int(datagram[1].split(".")[0]) < 240:
                self.datagrams.append((time.monotonic(), *datagram))

    def dropped(self):
        """Frames that it missed since the start. One thread."""
        return self._drops.count()

    def stop(self):
        self._running = False
        self._thread.join()
        self._socket.close()

    def pdus(self, sender=None, since=0.0, until=float("inf")):
        """(time, sender, group, type, octets) of every PDU seen."""
        for when, source, group, payload in list(self.datagrams):
            if since <= when < until and sender in (None, source):
                for kind, octets in dis.pdus(payload):
                    yield when, source, group, kind, octets
