// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Controls for delay, jitter, loss and an outage of the demo's own impairment.

const FIELDS = { delay: 'ms', jitter: 'ms', loss: '%' };
const SETTLED = 1000; // [ms] after which the program has what this tab has sent

export class NetworkPanel {
  constructor(tell, say) {
    Object.assign(this, { tell, say });
    this.inputs = Object.fromEntries(Object.keys(FIELDS).map((name) => [name, document.getElementById(name)]));
    this.outage = document.getElementById('outage');
    for (const [name, input] of Object.entries(this.inputs)) {
      input.addEventListener('input', () => this.send());
      input.addEventListener('change', () => this.say(`The demo's network: ${name} ${input.value} ${FIELDS[name]}.`));
    }
    this.twins = document.getElementById('twins');
    this.outage.addEventListener('click', () => this.toggleOutage());
  }

  // Shows the impairment that the program reports.
  show({ delay_ms: delay = 0, jitter_ms: jitter = 0, loss = 0, outage = false } = {}) {
    for (const [name, value] of Object.entries({ delay, jitter, loss: 100 * loss })) this.inputs[name].value = Number(value);
    this.out = outage === true;
    this.write();
  }

  // Shows what another tab has set.
  follow(network) {
    if (network && performance.now() - (this.sent ?? -Infinity) > SETTLED) this.show(network);
  }

  toggleOutage() {
    this.out = !this.out;
    this.send();
    this.say(this.out ? 'Outage: no datagram arrives.' : 'The outage is over.');
  }

  write() {
    this.outage.setAttribute('aria-pressed', String(!!this.out));
    for (const [name, input] of Object.entries(this.inputs)) {
      input.parentElement.querySelector('output').textContent = `${input.value} ${FIELDS[name]}`;
    }
  }

  send() {
    this.sent = performance.now();
    this.write();
    const { delay, jitter, loss } = this.inputs;
    this.tell('network', {
      delay: Number(delay.value), jitter: Number(jitter.value), loss: Number(loss.value) / 100, outage: !!this.out,
    });
  }
}
