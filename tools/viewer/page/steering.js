// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mouse and fingers on the large picture: turn, move, zoom, follow; or move the user's hand.

const CLICK = 5; // [pixels]

export class Steering {
  // `page` has stage, hand, moment and follow(slot).
  constructor(page) {
    this.page = page;
    this.fingers = new Map();
    this.holder = null; // the finger that moves the hand in its plane
    this.mouse = null;
    const { canvas } = page.stage;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event));
    canvas.addEventListener('pointerleave', (event) => {
      this.mouse = null;
      page.stage.pointed(null);
      if (this.handed && event.pointerType !== 'touch') page.hand.release(); // this includes a lifted finger
    });
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('dblclick', () => page.fit());
  }

  get orbit() { return this.page.stage.view(this.page.stage.large).orbit; }
  // Whether the mouse or a finger moves the hand: not while a gamepad does.
  get handed() { return this.page.hand.index !== null && this.page.stage.large === 'touch' && this.page.hand.by !== 'pad'; }

  down(event) {
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    this.start = [event.clientX, event.clientY];
    this.page.stage.canvas.setPointerCapture(event.pointerId);
    if (!this.handed || event.button !== 0 || this.fingers.size !== 1) return;
    this.holder = event.pointerId;
    this.page.hand.grabs = event.pointerType !== 'touch';
    this.page.hand.by = event.pointerType;
    this.page.hand.move(this.page.moment, event.offsetX, event.offsetY);
  }

  move(event) {
    this.mouse = [event.offsetX, event.offsetY];
    this.page.stage.pointed(this.mouse);
    const old = this.fingers.get(event.pointerId);
    const dx = event.movementX;
    const dy = event.movementY;
    if (old) this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    if (old && this.handed && event.pointerType === 'touch') return this.lead(event, old);
    if (old && this.fingers.size === 2) return this.pinch(event, old);
    const second = event.buttons & 6; // right or middle
    if (this.handed && !second) {
      if (event.shiftKey) this.page.hand.deepen(this.page.moment, dy);
      else this.page.hand.move(this.page.moment, event.offsetX, event.offsetY);
      return undefined;
    }
    if (!old) return undefined;
    if ((second && !this.handed) || event.shiftKey) this.orbit.pan(dx, dy); else this.orbit.turn(dx, dy);
    return undefined;
  }

  // Fingers on a hand: the first moves it in the plane; the next moves it away or nearer, by moving
  // up or down. Meanwhile the camera does not move.
  lead(event, old) {
    if (event.pointerId === this.holder) this.page.hand.move(this.page.moment, event.offsetX, event.offsetY);
    else if (this.holder !== null) this.page.hand.deepen(this.page.moment, event.clientY - old[1]);
  }

  // Two fingers on the picture: spreading them zooms in.
  pinch(event, old) {
    const other = [...this.fingers].find(([id]) => id !== event.pointerId)[1];
    const before = Math.hypot(old[0] - other[0], old[1] - other[1]);
    const after = Math.hypot(event.clientX - other[0], event.clientY - other[1]);
    this.orbit.zoom(before / Math.max(1, after));
    return this.orbit.pan((event.clientX - old[0]) / 2, (event.clientY - old[1]) / 2);
  }

  up(event) {
    const held = this.fingers.delete(event.pointerId);
    if (event.pointerId === this.holder) {
      this.holder = null;
      this.page.hand.grabs = false;
      if (this.handed && event.pointerType === 'touch') this.page.hand.release();
    }
    const still = this.start && Math.hypot(event.clientX - this.start[0], event.clientY - this.start[1]) < CLICK;
    if (!held || !still || event.button !== 0 || this.page.stage.large !== 'world' || !this.page.moment.picture) return;
    const slot = this.page.stage.pick(this.page.moment, event.offsetX, event.offsetY);
    if (slot >= 0) this.page.follow(slot);
  }

  wheel(event) {
    event.preventDefault();
    if (this.handed) this.page.hand.deepen(this.page.moment, event.deltaY * 0.2);
    else this.orbit.zoom(Math.exp(event.deltaY * 0.001));
  }
}
