// SPDX-License-Identifier: Apache-2.0
// Draws a tileset with 3d-tiles-renderer in a real browser: node stream.mjs, with these variables in
// the environment; all paths are absolute:
//   TILESET   the folder of tileset.json
//   LEVELS    how many levels of abstraction it has
//   CHROMIUM
//   WEB       the folder whose node_modules hold esbuild
//   PACKAGES  the folder whose node_modules hold playwright-core, 3d-tiles-renderer and three.js
//   PICTURES  where far.png, middle.png and near.png go
// Exits with 77 if Chromium or packages are missing.
import assert from 'node:assert/strict';
import { mkdir, readFile } from 'node:fs/promises';
import { join } from 'node:path';
import test, { after, before } from 'node:test';

import { needChromium, needPackages } from '../needed.mjs';

const { CHROMIUM, LEVELS, PACKAGES, PICTURES, TILESET, WEB } = process.env;
needChromium(CHROMIUM);
needPackages(WEB, 'build with LEAFHULL_BUILD_VIEWER');
needPackages(PACKAGES, 'build the target test_packages');
const { launch } = await import('../page/browser.mjs');
const { serve } = await import('./server.mjs');

const STEPS = 16;
// The renderer prints this for every tileset of version 1.1.
const NOTICE = /^TilesRenderer: tiles versions at 1.1 or higher have limited support/;
const levels = Number(LEVELS);
const tileset = JSON.parse(await readFile(join(TILESET, 'tileset.json'), 'utf8'));

/** All tiles, with their parents. */
function* tilesOf(object, parent) {
  const tile = { ...object, parent };
  yield tile;
  for (const child of object.children ?? []) yield* tilesOf(child, tile);
}
const tiles = [...tilesOf(tileset.root)];
const byUri = new Map(tiles.filter(({ content }) => content).map((tile) => [tile.content.uri, tile]));
const levelOf = (uri) => Number(uri.match(/^tiles\/(\d+)\//)[1]);
const errors = new Map([...byUri].map(([uri, { geometricError }]) => [levelOf(uri), geometricError]));

/** A tile's box in the viewer's axes: 3D Tiles' (x, y, z) is (x, z, -y) with y up. */
function turnedBox({ boundingVolume: { box: [x, y, z, ...axes] } }) {
  const half = [0, 1, 2].map((i) => Math.abs(axes[i]) + Math.abs(axes[3 + i]) + Math.abs(axes[6 + i]));
  return {
    low: [x - half[0], z - half[2], -y - half[1]],
    high: [x + half[0], z + half[2], -y + half[1]],
  };
}

/** The bounds that are stated in a GLB with one node. */
async function statedBox(uri) {
  const bytes = await readFile(join(TILESET, uri));
  const gltf = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
  const [{ translation = [0, 0, 0] }] = gltf.nodes;
  const { min, max } = gltf.accessors[gltf.meshes[0].primitives[0].attributes.POSITION];
  return { low: min.map((v, i) => v + translation[i]), high: max.map((v, i) => v + translation[i]) };
}

let browser, page, server, bounds;
const views = [];  // from far to near
before(async () => {
  await mkdir(PICTURES, { recursive: true });
  server = await serve({ folder: TILESET, web: WEB, packages: PACKAGES });
  browser = await launch();
  page = await browser.newPage({ viewport: { width: 960, height: 640 } });
  page.faults = [];
  page.on('console', (message) =>
    NOTICE.test(message.text()) || page.faults.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => page.faults.push(`error: ${error.message}`));
  page.on('requestfailed', (request) => page.faults.push(`failed: ${request.url()}`));
  page.on('response', (response) =>
    response.ok() || page.faults.push(`${response.status()}: ${response.url()}`));
  await page.goto(server.url);
  bounds = await page.evaluate(() => viewer.bounds());
  await walk();
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** Moves the camera towards the tile of level 0 that is nearest to the middle. */
async function walk() {
  const distanceToCentre = (tile) => {
    const { low, high } = turnedBox(tile);
    return Math.hypot(...low.map((v, i) => (v + high[i]) / 2 - bounds.centre[i]));
  };
  const finest = [...byUri.entries()].filter(([uri]) => levelOf(uri) === 0).map(([, tile]) => tile);
  const { low, high } = turnedBox(finest.sort((a, b) => distanceToCentre(a) - distanceToCentre(b))[0]);
  const aim = low.map((v, i) => (v + high[i]) / 2);
  const radius = Math.hypot(...high.map((v, i) => v - aim[i]));
  const reach = (level) => page.evaluate((error) => viewer.reach(error), errors.get(level) ?? 0);
  const far = bounds.radius * 2 + 1.1 * await reach(levels - 1);
  const near = radius + 0.5 * await reach(Math.min(1, levels - 1));
  for (let step = 0; step < STEPS; ++step) {
    const distance = far * (near / far) ** (step / (STEPS - 1));
    views.push(await page.evaluate(([aim, distance]) => viewer.look(aim, distance), [aim, distance]));
    const name = { 0: 'far', [STEPS / 2]: 'middle', [STEPS - 1]: 'near' }[step];
    if (name) await page.screenshot({ path: join(PICTURES, `${name}.png`) });
    const shown = levelsIn(views.at(-1)).map((level) => `${level}`).join(' ');
    console.log(`${distance.toFixed(1)} away: levels ${shown}, ${views.at(-1).tiles.length} tiles, ` +
      `${views.at(-1).triangles} triangles`);
  }
}

const levelsIn = ({ tiles }) => [...new Set(tiles.map(({ level }) => level))].sort((a, b) => a - b);

test('nothing is complained of, and nothing fails to load', () => {
  assert.deepEqual(page.faults, []);
  for (const { failed } of views) assert.equal(failed, 0);
});

test(`there are ${levels} levels, and errors grow from each to the next`, () => {
  assert.deepEqual([...errors.keys()].sort((a, b) => a - b), [...Array(levels).keys()]);
  for (let level = 1; level < levels; ++level) assert.ok(errors.get(level) > errors.get(level - 1));
});

test('from afar the coarsest level is seen', () => {
  assert.deepEqual(levelsIn(views[0]), [levels - 1]);
});

test('tiles refine as the camera nears, down to level 0', () => {
  const finest = views.map((view) => levelsIn(view)[0]);
  assert.equal(finest.at(-1), 0, `levels by step: ${finest}`);
  assert.ok(finest.every((level, i) => i === 0 || level <= finest[i - 1]), `levels by step: ${finest}`);
  assert.deepEqual([...new Set(views.flatMap(levelsIn))].sort(), [...Array(levels).keys()]);
});

test('every view shows triangles, and no tile together with one that it replaces', () => {
  for (const { tiles, triangles, twice } of views) {
    assert.ok(tiles.length > 0 && triangles > 0, `${tiles.length} tiles, ${triangles} triangles`);
    assert.deepEqual(twice, []);
  }
});

test('every number drawn is finite', () => {
  for (const { uri, finite, low, high } of views.flatMap(({ tiles }) => tiles)) {
    assert.ok(finite && [...low, ...high].every(Number.isFinite), uri);
  }
});

test('what is drawn lies upright, where the file says and within its bounding volume', async () => {
  const drawn = new Map(views.flatMap(({ tiles }) => tiles).map((tile) => [tile.uri, tile]));
  assert.ok(drawn.size >= levels);
  for (const { uri, low, high } of drawn.values()) {
    const stated = await statedBox(uri);
    const slack = 1e-6 * Math.max(...[...low, ...high].map(Math.abs));
    for (let i = 0; i < 3; ++i) {
      assert.ok(Math.abs(low[i] - stated.low[i]) <= slack && Math.abs(high[i] - stated.high[i]) <= slack,
        `${uri} from ${low} to ${high}, its file says from ${stated.low} to ${stated.high}`);
    }
    for (let tile = byUri.get(uri); tile; tile = tile.parent) {
      const box = turnedBox(tile);
      assert.ok(box.low.every((v, i) => v <= low[i] + slack) && box.high.every((v, i) => v >= high[i] - slack),
        `${uri} from ${low} to ${high} is not within the box from ${box.low} to ${box.high}`);
    }
  }
});
