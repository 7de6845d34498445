// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes libraries.js, SOURCES and the licence texts from the versions that package-lock.json names:
//   npm ci --ignore-scripts && node make.mjs
// The same versions give the same octets, so CI makes them anew and wants no difference.
import { createHash } from 'node:crypto';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { basename } from 'node:path';
import { build } from 'esbuild';

const three = 'node_modules/three/src';
const chunks = `${three}/renderers/shaders/ShaderChunk`;
const shaders = `${three}/renderers/shaders/ShaderLib`;

// Of three, what the page never uses is left out: half of it would else be shaders of other materials.
const DRAWN = ['meshbasic', 'meshlambert']; // materials
const ALONE = ['colorspace_fragment', 'colorspace_pars_fragment']; // asked for by name
const FEATURES = new RegExp(`^(${[
  'alphahash', 'alphamap', 'alphatest', 'aomap', 'batching', 'bumpmap', 'clearcoat', 'clipping_planes', 'cube_uv', 'displacementmap',
  'dithering', 'emissivemap', 'envmap', 'fog', 'iridescence', 'lightmap', 'lightprobes', 'logdepthbuf', 'map_', 'morph', 'normalmap',
  'shadow', 'skin', 'tonemapping', 'transmission', 'uv_',
].join('|')})`);
const LEFT_OUT = {
  'WebGLEnvironments.js': 'export function WebGLEnvironments() { return { get: (texture) => texture, dispose() {} }; }',
  'WebGLMorphtargets.js': 'export function WebGLMorphtargets() { return { update() {} }; }',
  'PMREMGenerator.js': 'export class PMREMGenerator {}',
  'DFGLUTData.js': 'export function getDFGLUT() { return null; }',
  'WebGLShadowMap.js': 'export class WebGLShadowMap { render() {} }',
  'WebXRManager.js': `import { EventDispatcher } from '../../core/EventDispatcher.js';
    export class WebXRManager extends EventDispatcher {
      enabled = false; isPresenting = false; setAnimationLoop() {} dispose() {}
      getEnvironmentBlendMode() { return 'opaque'; } }`,
};

// Methods that the page never calls: to and from JSON, picking by rays, reading back what was drawn.
const CALLED_BY_NOBODY = ['toJSON', 'fromJSON', 'raycast'];
const RENDERER = [
  'compile', 'compileAsync', 'copyFramebufferToTexture', 'copyTextureToTexture', 'initRenderTarget', 'initTexture', 'readRenderTargetPixels',
  'readRenderTargetPixelsAsync',
];
const METHODS = new RegExp(`\\n\\t(?:${CALLED_BY_NOBODY.join('|')})\\([^)]*\\) \\{\\n[\\s\\S]*?\\n\\t\\}\\n`, 'g');
const OF_RENDERER = new RegExp(`\\n\\t\\tthis\\.(?:${RENDERER.join('|')}) = (?:async )?function \\([^)]*\\) \\{\\n[\\s\\S]*?\\n\\t\\t\\};\\n`, 'g');

const text = (path) => readFileSync(path, 'utf8');
const used = new Set();
function use(path) {
  for (const [, name] of text(path).matchAll(/#include <(\w+)>/g)) {
    if (used.has(name) || FEATURES.test(name)) continue;
    used.add(name);
    use(`${chunks}/${name}.glsl.js`);
  }
}
for (const name of DRAWN) use(`${shaders}/${name}.glsl.js`);
for (const name of ALONE) used.add(name);

const leaveOut = {
  name: 'leave out',
  setup(made) {
    made.onResolve({ filter: /^three$/ }, () => ({ path: new URL(`${three}/Three.js`, import.meta.url).pathname, sideEffects: false }));
    made.onLoad({ filter: /\/three\/src\/.*\.js$/ }, ({ path }) => {
      const name = basename(path);
      if (LEFT_OUT[name]) return { contents: LEFT_OUT[name], resolveDir: path.slice(0, path.lastIndexOf('/')) };
      if (path.includes('/ShaderChunk/') && !used.has(name.replace('.glsl.js', ''))) return { contents: "export default '';" };
      if (path.includes('/ShaderLib/') && !DRAWN.includes(name.replace('.glsl.js', ''))) {
        return { contents: "export const vertex = ''; export const fragment = '';" };
      }
      if (name.endsWith('.glsl.js')) return { contents: text(path).replace(/\/\/[^\n]*/g, '').replace(/\n\s+/g, '\n').replace(/\n\n+/g, '\n') };
      return { contents: text(path).replace(METHODS, '\n').replace(OF_RENDERER, '\n') };
    });
  },
};

const lock = JSON.parse(text('package-lock.json')).packages;
const version = (name) => lock[`node_modules/${name}`].version;
const banner = `/*! three ${version('three')} (c) 2010-2026 three.js authors, parts left out: see make.mjs; uPlot ${version('uplot')} (c) Leon Sorokin; both: SPDX-License-Identifier: MIT */`;
const names = Object.keys(await import('./exports.mjs')).sort();
// A closed function and one line of exports: a saved page, which joins all modules into one script, keeps its names apart.
const made = await build({
  entryPoints: ['exports.mjs'], bundle: true, minify: true, format: 'iife', globalName: 'reckonLibraries', plugins: [leaveOut],
  target: 'es2022', legalComments: 'inline', write: false, banner: { js: banner },
  footer: { js: `export const { ${names.join(', ')} } = reckonLibraries;` },
});
const script = made.outputFiles[0].contents;
writeFileSync('libraries.js', script);

const rows = ['three', 'uplot', 'esbuild'].map((name) => {
  return `${name} ${version(name)} ${lock[`node_modules/${name}`].integrity}`;
});
const digest = createHash('sha256').update(script).digest('hex');
writeFileSync('SOURCES', `${rows.join('\n')}\nlibraries.js sha256 ${digest}\n`);
copyFileSync('node_modules/three/LICENSE', 'LICENSE-three');
copyFileSync('node_modules/uplot/LICENSE', 'LICENSE-uplot');
console.log(`libraries.js: ${script.length} octets, SHA-256 ${digest}`);
