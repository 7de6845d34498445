// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What each term of the page means, in a sentence or two. An element with data-term shows it under
// the pointer and at the focus of the keyboard.
import { byId } from './words.js';

export const TERMS = {
  // Numbers at the top.
  'number of entities': 'Everything that sends its state: hands, vehicles, people, objects.',
  PDU: 'Protocol data units: the messages of DIS (IEEE 1278.1). This many arrive in a second.',
  sent: 'What all programs together send in a second.',
  ratio: 'How much less is sent than if each sample of each hand were sent.',
  age: 'How long ago the newest received state was sent here. Above 1 s the dot is amber.',
  // The network.
  delay: 'Each message between the two programs arrives this much later.',
  jitter: 'The delay of each message varies by as much as this.',
  loss: 'This share of the messages never arrives.',
  outage: 'No message arrives while it is on.',
  gate: 'The energy gate limits a force so that a contact never gives out more energy than was put in. A hidden twin of each hand feels the same contact without it.',
  // A hand that people hold and feel.
  gamepad: 'The left stick moves your hand in the plane of the picture, the right stick or the triggers in depth. Rumble: a short pulse when a contact begins, the weak motor with the speed of slipping, the strong one with the force, full at 5 N.',
  vibrate: 'A pulse when a contact begins, then pulses that get longer with the force, up to 5 N.',
  // Plots.
  force: 'The force that a hand feels. Felt: what its device shows. True: what it would be without any network, known in a demo. Without the gate: what its hidden twin feels.',
  energy: 'Energy that a hand has put into its contacts, less what it got back. Below zero a contact has made energy, and shakes. The loan says how far below it may go for a moment. With twins, sums over all hands and all twins are shown side by side.',
  error: 'How far the shown places are from the true ones. The threshold is the error at which a sender sends its next update.',
  packets: 'What is sent now, and what a stream of every sample would take. The scale is logarithmic.',
  'delay and loss': 'How long messages take from sender to receiver, and how many of them never arrive.',
  // Columns of the table.
  entity: 'The name that an entity sends. A click follows it.',
  Hz: 'Updates a second.',
  cause: 'Why the last update was sent: the first one, the error reached its threshold, a heartbeat after some seconds of rest, or an event.',
  jump: 'How far the last update moved the entity from where it was predicted, in millimetres.',
  cell: 'The cell of the world in which the entity is. A receiver subscribes to cells near its own entities.',
  group: 'The multicast group of the last update: the last two numbers of its address.',
  // The card of an entity, and the picture of an exercise.
  type: 'Kind, domain, country and category of the entity by the names of SISO-REF-010, and its seven numbers.',
  side: 'The force ID that the entity sends.',
  place: 'Latitude, longitude and height above the WGS84 ellipsoid, where the entity is shown.',
  speed: 'Over the ground and in height, as its last update predicts.',
  heading: 'Where the nose points: degrees from north, by east.',
  'last update': 'Time since the last state of this entity came, and why it was sent.',
  owner: 'The program that sends this entity, and the address that its messages come from.',
  version: 'Counts the owners of this body: how often the peers have given bodies of failed owners away, and the hand-overs since.',
  'hand-overs': 'How often this body has changed its owner since the program joined, and why it last did. Granted: by its former owner. Adopted: its former owner failed or left. Founded: it is the first owner.',
  'go on alone': 'This program takes all bodies and moves them. When the other peers are received again, the older group keeps its bodies.',
  camera: 'On: the camera keeps everything in the picture, or the entity that you follow. Moving the picture switches it off, and so does zooming among several entities.',
  scale: 'This length in the middle of the picture. The arrow points north.',
  // Marks of the pictures, by their names in the list of drawn things.
  cells: 'The world is divided into cells. A lit one is received by the entity that you follow.',
  ground: 'Lines of latitude and longitude (WGS84), at the height of the lowest entities.',
  beacons: 'A leader announces its cell from here; the ring runs out at each announcement.',
  trails: 'Where the entity was in the last 10 s.',
  predicted: 'Where the last update predicts the entity. The shown one approaches it smoothly; the line is four times the difference.',
  entities: 'An entity where a receiver shows it, nose ahead. Blue: friendly, orange: opposing, green: neutral, grey: other.',
  contacts: 'A force between two entities, computed from what they sent.',
  'near groups': 'Entities that share a multicast group because they are near each other.',
  'contact groups': 'Entities that share a multicast group because they touch, or soon will.',
  followed: 'The entity that you follow. In an exercise its card has its state. Esc ends it.',
  floor: 'A grid; the label is the side of a square. A drop line shows above which place a hand is.',
  'drop lines': 'A line down to the grid and a shadow there: how near a hand is. The thin line of your own hand ends at the nearest surface.',
  solids: 'An object of the scene that hands feel.',
  owners: 'The program that simulates this body, by the colour of its hand; grey if it has no hand here. The program whose hand approaches a body gets it; a ring shows the change.',
  regions: 'Space with an effect on a hand inside it, such as honey or wind.',
  patches: 'A part of a surface with a feel of its own. The touched one has the colour of the hand.',
  'predicted hand': 'Where the other programs predict this hand.',
  hands: 'The ball is the hand. The dot is where it would be if the surface were perfectly hard.',
  tools: 'A tool that turns with its device, and the points with which it feels.',
  'felt entities': 'A hand or an object of another program, which can be felt.',
  forces: 'The force that a hand feels, in newtons.',
  'friction cones': 'Inside the cone friction holds the hand; outside it the hand slides.',
};

function termOf(target) { return target instanceof Element ? target.closest('[data-term]') : null; }

export class Terms {
  constructor() {
    this.box = byId('term');
    this.at = null;
    for (const type of ['pointerover', 'focusin']) addEventListener(type, (event) => this.show(termOf(event.target)));
    addEventListener('focusout', () => this.show(null));
    addEventListener('keydown', (event) => { if (event.key === 'Escape') this.show(null); });
  }

  show(at) {
    if (at === this.at) return;
    this.at?.removeAttribute('aria-describedby');
    this.at = at;
    const text = at && TERMS[at.dataset.term];
    this.box.hidden = !text;
    if (!text) return;
    this.box.textContent = text;
    at.setAttribute('aria-describedby', 'term');
    (document.querySelector('dialog[open]') ?? document.body).append(this.box); // a dialog is above all else
    const { left, bottom, top } = at.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = this.box;
    const x = Math.max(8, Math.min(left, innerWidth - width - 8));
    const y = bottom + height + 12 < innerHeight ? bottom + 6 : Math.max(8, top - height - 6);
    this.box.style.transform = `translate(${x}px, ${y}px)`;
  }
}
