// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A copy of the page, whose folder is the first argument, that Node takes modules from.
import { copyFileSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';
import { pathToFileURL } from 'node:url';

// Node takes a .js file as a module where a package says so; the page needs none.
const page = process.argv[2];
const copy = mkdtempSync(join(tmpdir(), 'reckon-page-'));
after(() => rmSync(copy, { recursive: true }));
for (const name of readdirSync(page)) if (name.endsWith('.js')) copyFileSync(join(page, name), join(copy, name));
copyFileSync(join(page, 'third_party', 'libraries.js'), join(copy, 'libraries.js'));
writeFileSync(join(copy, 'package.json'), '{"type": "module"}');

// The module of this name.
export function take(name) { return import(pathToFileURL(join(copy, name))); }
