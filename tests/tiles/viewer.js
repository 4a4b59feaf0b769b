// SPDX-License-Identifier: Apache-2.0
// Draws /forest/tileset.json, each level in its own colour; tests call `viewer`.
import {
  Box3, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer,
} from 'three';
import { TilesRenderer } from '3d-tiles-renderer/three';
import { TilesetValidationPlugin } from '3d-tiles-renderer/src/three/plugins/TilesetValidationPlugin.js';

const COLORS = ['#4f7a38', '#c9a227', '#b4513a', '#6b4fa0', '#3a78b4', '#888888'];
const IDLE_FRAMES = 10;
const FROM = new Vector3(0.45, 0.5, 1).normalize();  // the direction from the aim to the camera

const renderer = new WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const scene = new Scene();
scene.background = new Color('#dfe7ec');
const sun = new DirectionalLight('#ffffff', 2);
sun.position.set(1, 2, 1.5);
scene.add(sun, new HemisphereLight('#ffffff', '#777766', 1.5));
const camera = new PerspectiveCamera(60, innerWidth / innerHeight);

const tiles = new TilesRenderer('/forest/tileset.json');
tiles.registerPlugin(new TilesetValidationPlugin());  // warns if vertices lie outside their tile's box
tiles.setCamera(camera);
tiles.setResolutionFromRenderer(camera, renderer);
tiles.group.rotation.x = -Math.PI / 2;  // z is up in 3D Tiles, y in three.js
scene.add(tiles.group);

const levelOf = (tile) => Number(tile.content.uri.match(/tiles\/(\d+)\//)[1]);
tiles.addEventListener('load-model', ({ scene: model, tile }) => model.traverse((object) => {
  if (object.isMesh) object.material.color.set(COLORS[Math.min(levelOf(tile), COLORS.length - 1)]);
}));
tiles.addEventListener('load-error', ({ url, error }) => console.error(`${url}: ${error.message}`));

function draw() {
  scene.updateMatrixWorld();
  camera.updateMatrixWorld();
  tiles.update();
  renderer.render(scene, camera);
}

const frame = () => new Promise(requestAnimationFrame);
const shown = () => [...tiles.visibleTiles].filter((tile) => tile.content)
  .map((tile) => tile.content.uri).sort();

/** Draws until nothing more is loaded and the tiles no longer change. */
async function settle() {
  let before = '';
  for (let idle = 0; idle < IDLE_FRAMES;) {
    await frame();
    draw();
    const { queued, downloading, parsing } = tiles.stats;
    const now = shown().join();
    idle = tiles.root && queued + downloading + parsing === 0 && now === before ? idle + 1 : 0;
    before = now;
  }
}

function isFiniteMesh({ geometry }) {
  return ['position', 'normal'].every((name) => geometry.attributes[name].array.every(Number.isFinite));
}

function describe(tile) {
  const { scene: model } = tile.engineData;
  const meshes = [];
  model.traverse((object) => object.isMesh && meshes.push(object));
  const box = new Box3().setFromObject(model, true);
  return {
    uri: tile.content.uri,
    level: levelOf(tile),
    low: box.min.toArray(),
    high: box.max.toArray(),
    finite: meshes.length > 0 && meshes.every(isFiniteMesh),
  };
}

function isBelowVisible(tile) {
  for (let above = tile.parent; above; above = above.parent) {
    if (above.content && tiles.visibleTiles.has(above)) return true;
  }
  return false;
}

window.viewer = {
  /** The sphere around everything. */
  async bounds() {
    await settle();
    const sphere = new Sphere();
    tiles.getBoundingSphere(sphere);
    sphere.applyMatrix4(tiles.group.matrixWorld);
    return { centre: sphere.center.toArray(), radius: sphere.radius };
  },

  /** How near a tile must be to be refined. */
  reach: (geometricError) => geometricError * renderer.domElement.height /
    (2 * Math.tan(camera.fov / 360 * Math.PI) * tiles.errorTarget),

  /** What is drawn of the tileset when the camera looks at `aim` from this distance. */
  async look(aim, distance) {
    const target = new Vector3(...aim);
    camera.position.copy(target).addScaledVector(FROM, distance);
    camera.near = distance / 1000;
    camera.far = distance * 1000;
    camera.updateProjectionMatrix();
    camera.lookAt(target);
    await settle();
    const visible = [...tiles.visibleTiles].filter((tile) => tile.content);
    return {
      tiles: visible.map(describe),
      twice: visible.filter(isBelowVisible).map((tile) => tile.content.uri),
      triangles: renderer.info.render.triangles,
      failed: tiles.stats.failed,
    };
  },
};
