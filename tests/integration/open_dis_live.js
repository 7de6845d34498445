// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A DIS 7 program of the npm package open-dis: ADDRESS GROUP PORT SECONDS. Prints each marking that it
// receives, once. 0.5 m beside the first such entity it sends an Entity State of FOREIGN ten times a second, with length
// field 0, which the package writes unless it is set. Exit status 77 where the package is not installed.
"use strict";
const dgram = require("dgram");

let dis;
try {
  dis = require("open-dis/dist/dis7.min.js");
} catch (error) {
  if (error.code !== "MODULE_NOT_FOUND") throw error;
  process.exit(77);
}

const [address, group, port, seconds] = process.argv.slice(2);
const pdu = new dis.EntityStatePdu();
pdu.exerciseID = 1;
Object.assign(pdu.entityID, {siteID: 77, applicationID: 7, entityID: 3});
Object.assign(pdu.entityType, {entityKind: 1, domain: 1, country: 225, category: 1});
pdu.deadReckoningParameters.deadReckoningAlgorithm = 1;
pdu.marking.setMarking("FOREIGN");
if (pdu.length !== 0) throw new Error("this release of open-dis sets the length");

const heard = new Set();
const socket = dgram.createSocket({type: "udp4", reuseAddr: true});
socket.on("message", (octets) => {
  if (octets[2] !== 1 || octets.readUInt16BE(12) === 77) return; // no Entity State, or its own
  const state = new dis.EntityStatePdu();
  state.initFromBinary(new dis.InputStream(Uint8Array.from(octets).buffer));
  const marking = state.marking.getMarking().replace(/\0.*$/s, "");
  if (heard.size === 0) Object.assign(pdu.entityLocation, state.entityLocation, {x: state.entityLocation.x + 0.5});
  if (!heard.has(marking)) console.log(`hears ${marking}`);
  heard.add(marking);
});
socket.bind(Number(port), () => {
  socket.addMembership(group, address);
  socket.setMulticastInterface(address);
  const timer = setInterval(() => {
    if (heard.size === 0) return;
    const octets = new ArrayBuffer(144);
    pdu.encodeToBinary(new dis.OutputStream(octets));
    socket.send(new Uint8Array(octets), Number(port), group);
  }, 100);
  setTimeout(() => {
    clearInterval(timer);
    socket.close();
  }, 1000 * Number(seconds));
});
