// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads PDUs, one in hexadecimal a line, with the npm package open-dis (DIS 7). Prints "ok N", or a line
// for each PDU that it cannot read to its end. Exit status 77 where the package is not installed.
"use strict";
const fs = require("fs");

let dis;
try {
  dis = require("open-dis/dist/dis7.min.js");
} catch (error) {
  if (error.code !== "MODULE_NOT_FOUND") throw error;
  process.exit(77);
}

const classes = {1: "EntityStatePdu", 11: "CreateEntityPdu", 12: "RemoveEntityPdu",
                 13: "StartResumePdu", 14: "StopFreezePdu", 15: "AcknowledgePdu", 66: "CollisionElasticPdu"};
let good = 0;
let bad = 0;
fs.readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean).forEach((line, number) => {
  const octets = Uint8Array.from(Buffer.from(line, "hex"));
  const type = octets[2];
  try {
    const pdu = new dis[classes[type]]();
    const stream = new dis.InputStream(octets.buffer);
    pdu.initFromBinary(stream);
    if (stream.currentPosition !== octets.length || pdu.length !== octets.length) {
      throw new Error(`${stream.currentPosition} of ${octets.length} octets read`);
    }
    ++good;
  } catch (error) {
    console.log(`PDU ${number} of type ${type}: ${error.message}`);
    ++bad;
  }
});
if (bad === 0) console.log(`ok ${good}`);
