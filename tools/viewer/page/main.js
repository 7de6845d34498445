// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Says in one line what arrives.
const line = document.getElementById("line");
const word = new URLSearchParams(location.hash.slice(1)).get("word") ?? "";
const socket = new WebSocket(`ws://${location.host}/stream?word=${encodeURIComponent(word)}`);
socket.binaryType = "arraybuffer";
socket.onclose = () => { line.textContent = "no server"; };
socket.onmessage = (event) => {
  if (typeof event.data === "string") return;
  const view = new DataView(event.data);
  line.textContent = `${view.getFloat64(8, true).toFixed(1)} s, ${view.getUint16(16, true)} entities`;
  const drawn = new DataView(new ArrayBuffer(5));
  drawn.setUint8(0, 1);
  drawn.setUint32(1, view.getUint32(4, true), true);
  socket.send(drawn);
};
