// SPDX-License-Identifier: Apache-2.0
// Serves a page that draws a tileset. esbuild bundles its script; the tileset is under /forest/.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const PAGE = `<!doctype html>
<html lang="en"><meta charset="utf-8"><title>forest</title><link rel="icon" href="data:,">
<style>body { margin: 0; overflow: hidden } canvas { display: block }</style>
<body><script src="/viewer.js"></script></body></html>`;
const TYPES = { '.json': 'application/json', '.glb': 'model/gltf-binary' };

async function bundle(web, packages) {
  const { build } = createRequire(`${web}/`)('esbuild');
  const { outputFiles: [script] } = await build({
    entryPoints: [fileURLToPath(new URL('viewer.js', import.meta.url))],
    nodePaths: [join(packages, 'node_modules')],
    bundle: true,
    format: 'iife',
    target: 'es2022',
    write: false,
    logLevel: 'warning',
  });
  return script.text;
}

/** The node_modules of `web` hold esbuild, those of `packages` the renderer and three.js. */
export async function serve({ folder, web, packages }) {
  const own = {
    '/': [PAGE, 'text/html'],
    '/viewer.js': [await bundle(web, packages), 'text/javascript'],
  };
  const server = createServer(async (request, response) => {
    const path = normalize(decodeURI(new URL(request.url, 'http://localhost').pathname));
    try {
      const [body, type] = own[path] ??
        [await readFile(join(folder, path.replace(/^\/forest\//, ''))), TYPES[path.match(/\.\w+$/)[0]]];
      response.writeHead(200, { 'content-type': type }).end(body);
    } catch (error) {
      response.writeHead(404).end(error.code);
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}
