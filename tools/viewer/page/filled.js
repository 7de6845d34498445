// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// In a recording nobody may be sending at an instant, as at its end. The page then holds the last
// picture with somebody in it.
export class Filled {
  constructor() { this.clear(); }

  clear() {
    this.last = null;
    this.holds = false;
  }

  // The picture to draw for `picture`. `whole`: of a capture or a saved file.
  take(picture, whole) {
    const someone = picture.entities > 0 || picture.hands.length > 0;
    if (someone) this.last = picture;
    this.holds = whole && !someone && this.last !== null;
    return this.holds ? this.last : picture;
  }
}
