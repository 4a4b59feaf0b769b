// SPDX-License-Identifier: Apache-2.0
// Bundles viewer.js with what it uses into one script, the licences first: node build.mjs OUTPUT
import { build } from 'esbuild';
import { readFile, writeFile } from 'node:fs/promises';
import { argv } from 'node:process';

const [output] = argv.slice(2);
const three = await readFile('node_modules/three/LICENSE', 'utf8');
const decoder = await readFile(
  'node_modules/three/examples/jsm/libs/meshopt_decoder.module.js', 'utf8');
const decoderNotice = decoder.match(/^(\/\/.*\n)+/)[0].replaceAll(/^\/\/ ?/gm, '');

const result = await build({
  entryPoints: ['viewer.js'],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  legalComments: 'inline',
  banner: {
    js: `/*!
leafhull's viewer. Copyright the leafhull authors. Licensed under the Apache License, Version 2.0.

With three.js:

${three.trim()}

With the decoder of meshoptimizer, on the terms above:

${decoderNotice.trim()}
*/`,
  },
  outfile: output,
  write: false,
  logLevel: 'warning',
});

const [{ text }] = result.outputFiles;
// What would end a script element, or begin a comment in it.
if (/<\/script|<!--/i.test(text)) throw new Error('the bundle cannot stand in a page');
await writeFile(output, text);
