// SPDX-License-Identifier: Apache-2.0
// Reads a tileset with Cesium's 3d-tiles-tools and the Khronos glTF validator: node
// check_tileset.mjs, with these variables in the environment:
//   TILESET    the folder of tileset.json
//   PACKAGES   the folder whose node_modules hold both
// Exits with 77 if they are missing.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, readdir, rm } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { execPath } from 'node:process';
import test from 'node:test';
import { promisify } from 'node:util';

import { needPackages } from '../needed.mjs';

const { PACKAGES, TILESET } = process.env;
needPackages(PACKAGES, 'build the target test_packages');
const requirePackage = createRequire(`${resolve(PACKAGES)}/`);
const { BoundingVolumesContainment, TilesetSourceResourceResolver, TilesetSources, TilesetTraverser,
  VertexProcessing } = requirePackage('3d-tiles-tools');
const validator = requirePackage('gltf-validator');

const EPSILON = 1e-9;  // in half axes; the tools invert the box

const folder = resolve(TILESET);
const tileset = JSON.parse(await readFile(join(folder, 'tileset.json'), 'utf8'));
const files = (await readdir(join(folder, 'tiles'), { recursive: true }))
  .filter((name) => name.endsWith('.glb')).map((name) => `tiles/${name}`).sort();

/** Calls visit(tile, ancestors, uris, source) for every tile, as 3d-tiles-tools traverses them. */
async function traverse(visit, input = folder) {
  const source = await TilesetSources.createAndOpen(input);
  const resolver = new TilesetSourceResourceResolver('.', source);
  const traverser = new TilesetTraverser('.', resolver, { depthFirst: true });
  await traverser.traverse(tileset, async (traversed) => {
    const ancestors = [];
    for (let at = traversed.getParent(); at; at = at.getParent()) ancestors.push(at.asRawTile());
    await visit(traversed.asRawTile(), ancestors, traversed.getRawContents().map(({ uri }) => uri), source);
    return true;
  });
  await source.close();
}

function assertKeys(object, required, optional, where) {
  for (const key of required) assert.ok(key in object, `${where} has no ${key}`);
  for (const key of Object.keys(object)) {
    assert.ok(required.includes(key) || optional.includes(key), `${where} has a foreign ${key}`);
  }
}

const isError = (value) => Number.isFinite(value) && value >= 0;

function assertTile(tile, where) {
  assertKeys(tile, ['boundingVolume', 'geometricError'], ['content', 'children', 'refine'], where);
  assertKeys(tile.boundingVolume, ['box'], [], where);
  const { box } = tile.boundingVolume;
  assert.ok(box.length === 12 && box.every(Number.isFinite), `${where} has a bad box`);
  assert.ok(isError(tile.geometricError), `${where} has a bad error`);
  if (tile.content) assertKeys(tile.content, ['uri'], [], where);
  if (tile.children) assert.ok(Array.isArray(tile.children) && tile.children.length > 0, where);
}

test('tileset.json is as OGC 3D Tiles 1.1 has it', async () => {
  assertKeys(tileset, ['asset', 'geometricError', 'root'], [], 'the tileset');
  assertKeys(tileset.asset, ['version'], ['extras'], 'the asset');
  assert.equal(tileset.asset.version, '1.1');
  assert.ok(isError(tileset.geometricError) && tileset.geometricError >= tileset.root.geometricError);
  assert.equal(tileset.root.refine, 'REPLACE');
  await traverse((tile, [parent], uris) => {
    const where = uris[0] ?? 'a tile without content';
    assertTile(tile, where);
    assert.ok(tile.content || tile.children, `${where} leads nowhere`);
    if (parent) assert.ok(tile.geometricError <= parent.geometricError, `${where} has a larger error than its parent`);
  });
});

test('3d-tiles-tools find every file once, and all vertices within the boxes above them', async () => {
  const found = [];
  let vertices = 0;
  await traverse(async (tile, ancestors, uris, source) => {
    for (const uri of uris) {
      found.push(uri);
      const data = await source.getValue(uri);
      assert.ok(data, `${uri} is missing`);
      const boxes = [tile, ...ancestors].map(({ boundingVolume }) => boundingVolume);
      await VertexProcessing.fromContent(uri, data, async () => undefined, true, (vertex) => {
        ++vertices;
        assert.ok(boxes.every((box) => BoundingVolumesContainment.contains(box, vertex, EPSILON)),
          `${uri} has a vertex at ${vertex}, outside of a box above it`);
      });
    }
  });
  assert.deepEqual(found.sort(), files);
  assert.ok(vertices > 0);
  console.log(`${found.length} files, ${vertices} vertices`);
});

test('3d-tiles-tools pack it without a complaint, and the package holds the same', async () => {
  const temporary = await mkdtemp(join(tmpdir(), 'tileset-'));
  try {
    const packed = join(temporary, 'forest.3tz');
    const tool = join(PACKAGES, 'node_modules/3d-tiles-tools/build/src/cli.mjs');
    const { stdout, stderr } = await promisify(execFile)(
      execPath, [tool, 'convert', '-i', join(folder, 'tileset.json'), '-o', packed, '--logLevel', 'warn']);
    assert.equal(stdout + stderr, '');
    await traverse(async (tile, ancestors, uris, source) => {
      for (const uri of uris) {
        assert.ok((await readFile(join(folder, uri))).equals(await source.getValue(uri)), uri);
      }
    }, packed);
  } finally {
    await rm(temporary, { recursive: true });
  }
});

test('the glTF validator finds no error in the contents, and nothing to warn of', async () => {
  const remarks = {};
  for (const file of files) {
    const { issues } = await validator.validateBytes(new Uint8Array(await readFile(join(folder, file))));
    assert.deepEqual(issues.messages.filter(({ severity }) => severity < 2), [], file);
    for (const { code } of issues.messages) remarks[code] = (remarks[code] ?? 0) + 1;
  }
  console.log('remarks:', remarks);
});
