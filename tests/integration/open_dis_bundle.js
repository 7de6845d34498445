// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counts the PDUs that the factory of the npm package open-dis (DIS 7) makes of datagrams, one in hexadecimal a line on stdin:
// docs/comparison.md. It sees the first PDU of each datagram.
const dis = require("open-dis/dist/dis7.min.js");

const factory = new dis.PduFactory();
const lines = require("fs").readFileSync(0, "utf8").split("\n").filter(Boolean);
let made = 0;
for (const line of lines) {
  try {
    factory.createPdu(Uint8Array.from(Buffer.from(line, "hex")).buffer);
    ++made;
  } catch (error) {
    if (!String(error).includes("Unrecognized PDUType")) throw error;
  }
}
console.log(`${made} PDUs of ${lines.length} datagrams`);
