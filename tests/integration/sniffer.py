# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Observers that receive each frame at an interface, and one that records all datagrams. Standard library."""
import socket
import struct
import threading
import time

import dis_wire as dis

SOL_PACKET, PACKET_STATISTICS, SO_RCVBUFFORCE = 263, 6, 33


class Observer:
    """Receives each frame of an AF_PACKET socket, in a separate thread. A subclass has _receive(), which reads one."""

    def __init__(self, sock):
        self._socket = sock
        self._socket.settimeout(0.1)
        self._running = True
        self._dropped = 0
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        while self._running:
            try:
                self._receive()
            except socket.timeout:
                continue

    def dropped(self):
        """Frames since the start for which the kernel had no room: the observer missed them. One thread."""
        octets = self._socket.getsockopt(SOL_PACKET, PACKET_STATISTICS, 8)
        self._dropped += struct.unpack("II", octets)[1]  # reading resets the kernel's count
        return self._dropped

    def stop(self):
        self._running = False
        self._thread.join()
        self._socket.close()


class Sniffer(Observer):
    """Records every UDP datagram to a multicast group that enters a port of the switch."""

    def __init__(self, sock):
        self.datagrams = []  # (monotonic time, sender, group, payload)
        super().__init__(sock)

    def _receive(self):
        frame, address = self._socket.recvfrom(65536)
        if address[2] == socket.PACKET_OUTGOING or not address[0].startswith("p"):
            return
        datagram = dis.udp_of_frame(frame)
        if datagram and 224 <= int(datagram[1].split(".")[0]) < 240:
            self.datagrams.append((time.monotonic(), *datagram))

    def pdus(self, sender=None, since=0.0, until=float("inf")):
        """(time, sender, group, type, octets) of every PDU received."""
        for when, source, group, payload in list(self.datagrams):
            if since <= when < until and sender in (None, source):
                for kind, octets in dis.pdus(payload):
                    yield when, source, group, kind, octets
