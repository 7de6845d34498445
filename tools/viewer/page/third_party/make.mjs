// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes libraries.js, SOURCES and the licence texts from the versions that package-lock.json names:
//   npm ci --ignore-scripts && node make.mjs
// The same versions give the same octets, so CI makes them anew and wants no difference.
import { createHash } from 'node:crypto';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const names = Object.keys(await import('./exports.mjs')).sort();
// A closed function and one line of exports: a saved page, which joins all modules into one script, keeps its names apart.
const made = await build({
  entryPoints: ['exports.mjs'], bundle: true, minify: true, format: 'iife', globalName: 'reckonLibraries',
  target: 'es2022', legalComments: 'inline', write: false, footer: { js: `export const { ${names.join(', ')} } = reckonLibraries;` },
});
const script = made.outputFiles[0].contents;
writeFileSync('libraries.js', script);

const lock = JSON.parse(readFileSync('package-lock.json', 'utf8')).packages;
const rows = ['three', 'uplot', 'esbuild'].map((name) => {
  const { version, integrity } = lock[`node_modules/${name}`];
  return `${name} ${version} ${integrity}`;
});
const digest = createHash('sha256').update(script).digest('hex');
writeFileSync('SOURCES', `${rows.join('\n')}\nlibraries.js sha256 ${digest}\n`);
copyFileSync('node_modules/three/LICENSE', 'LICENSE-three');
copyFileSync('node_modules/uplot/LICENSE', 'LICENSE-uplot');
console.log(`libraries.js: ${script.length} octets, SHA-256 ${digest}`);
