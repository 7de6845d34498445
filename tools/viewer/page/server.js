// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The world as streamed by a server. After a lost connection it connects again by itself, at most
// every 4 s, and not while the tab is hidden. A hidden tab draws nothing, and a server disconnects
// such tabs.
import { COMMANDS } from './commands.js';
import { PictureStream } from './picture_stream.js';

const LONGEST_WAIT = 4000;

export class Server {
  // `hear` has functions text(object), picture(picture), state(word, sentence) and bad(sentence).
  constructor(word, hear) {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    this.url = `${scheme}://${location.host}/stream${word ? `?word=${encodeURIComponent(word)}` : ''}`;
    this.hear = hear;
    this.octets = 0;
    this.bad = 0;
    this.wait = 500;
    this.bye = ''; // the reason for which the server ended the connection
    this.open();
  }

  open() {
    const socket = new WebSocket(this.url);
    this.socket = socket;
    this.pictures = new PictureStream();
    socket.binaryType = 'arraybuffer';
    socket.onclose = () => {
      this.hear.state('lost', this.bye || `No server at ${location.host}.`);
      setTimeout(() => this.openWhenSeen(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
    };
    socket.onmessage = ({ data }) => {
      this.octets += data.byteLength ?? data.length;
      try {
        if (typeof data === 'string') this.text(JSON.parse(data));
        else this.picture(data);
      } catch (error) {
        ++this.bad;
        this.hear.bad(error.message);
        if (typeof data === 'string') return;
        this.tell('drawn', numberOf(data));
        this.tell('whole');
      }
    };
  }

  picture(data) {
    const picture = this.pictures.take(data);
    if (picture) this.hear.picture(picture); else this.tell('drawn', numberOf(data));
  }

  openWhenSeen() {
    if (document.hidden) document.addEventListener('visibilitychange', () => this.openWhenSeen(), { once: true });
    else this.open();
  }

  text(message) {
    if (message.type === 'hello') {
      this.wait = 500;
      this.hear.state('live', '');
    }
    if (message.type === 'hello' || message.type === 'bye') this.bye = message.type === 'bye' ? message.text : '';
    this.hear.text(message);
  }

  tell(name, ...values) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(COMMANDS[name](...values));
  }

  advance() {}
}

// A refused picture is acknowledged too, because otherwise the server would send no more.
function numberOf(buffer) { return buffer.byteLength < 8 ? 0 : new DataView(buffer).getUint32(4, true); }
