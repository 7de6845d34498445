// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One file that holds the page and what it plays: no request leaves it, its content policy allows this script alone.
import { base64 } from './recorder.js';
import { sha256 } from './sha256.js';

const IMPORT = /^import .* from '\.\/([a-z0-9_]+\.js)';$/;

// All modules that one imports, each once and before who imports it, as one script. `read(name)` gives a promise of text.
export async function bundle(name, read) {
  const done = new Set();
  const texts = [];
  async function add(module) {
    if (done.has(module)) return;
    done.add(module);
    const lines = (await read(module)).split('\n');
    for (const line of lines) {
      const found = IMPORT.exec(line);
      if (found) await add(found[1]);
    }
    texts.push(lines.filter((line) => !line.startsWith('import ')).map((line) => line.replace(/^export /, '')).join('\n'));
  }
  await add(name);
  return texts.join('\n');
}

export function savedFile({ html, css, script, items }) {
  const digest = (text) => base64(sha256(new TextEncoder().encode(text)));
  const policy = `default-src 'none'; script-src 'sha256-${digest(script)}'; style-src 'sha256-${digest(css)}'; `
    + "img-src data:; base-uri 'none'; form-action 'none'";
  const data = JSON.stringify(items).replaceAll('<', '\\u003c');
  const close = '\u003c/script>'; // spelt so that it does not end the script it stands in
  return html
    .replace('<link rel="stylesheet" href="page.css">',
      () => `<meta http-equiv="Content-Security-Policy" content="${policy}"><style>${css}</style>`)
    .replace(`<script type="module" src="main.js">${close}`,
      () => `<script type="application/json" id="saved">${data}${close}<script type="module">${script}${close}`);
}

export async function savePage(items) {
  const read = async (name) => {
    const answer = await fetch(name);
    if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
    return answer.text();
  };
  const [html, css, script] = [await read('./'), await read('page.css'), await bundle('main.js', read)];
  return savedFile({ html, css, script, items });
}

export function download(name, blob) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
