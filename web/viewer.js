// SPDX-License-Identifier: Apache-2.0
// Turns the shapes of a report: each .view shows one tree by several methods, through one camera.
// A single WebGL context draws them all and copies each picture into the 2D canvas of its frame, as
// browsers grant few contexts. Nothing is drawn unless something changed.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  HemisphereLight,
  MathUtils,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const MOST_PIXEL_RATIO = 2;
const NEAR = '400px'; // how close to the window a view is loaded

// As the still pictures are seen.
const AZIMUTH = 32, ELEVATION = 9; // degrees
const TAN_HALF_VIEW = 0.11; // of the picture's longer side
const MARGIN = 1.06;

const TURN = MathUtils.degToRad(7.5), ZOOM = 0.85; // for each press of a key or a button

const HINT = window.matchMedia('(pointer: coarse)').matches ?
  'Drag sideways to turn, pinch to zoom, move with two fingers. All turn together.' :
  'Drag to turn, drag with the right button to move, click and use the wheel to zoom. All turn ' +
    'together.';

/** src/page/packed_mesh.h tells the format. */
function unpack(text) {
  const packed = JSON.parse(text);
  const bytes = (base64) => Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const steps = new Uint16Array(4 * packed.vertices);
  MeshoptDecoder.decodeVertexBuffer(
    new Uint8Array(steps.buffer), packed.vertices, 8, bytes(packed.vertexBuffer));
  const indices = new Uint32Array(3 * packed.triangles);
  MeshoptDecoder.decodeIndexBuffer(
    new Uint8Array(indices.buffer), indices.length, 4, bytes(packed.indexBuffer));

  const positions = new Float32Array(3 * packed.vertices);
  for (let vertex = 0; vertex < packed.vertices; ++vertex) {
    for (let axis = 0; axis < 3; ++axis) {
      positions[3 * vertex + axis] = packed.low[axis] + packed.step * steps[4 * vertex + axis];
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingBox();
  return geometry;
}

/** How far a shape reaches from the vertical through `centre`. */
function reach(geometry, centre) {
  const { array } = geometry.getAttribute('position');
  let most = 0;
  for (let i = 0; i < array.length; i += 3) {
    most = Math.max(most, Math.hypot(array[i] - centre.x, array[i + 2] - centre.z));
  }
  return most;
}

/** The one WebGL context, with the lights and the matter of every shape. */
class Painter {
  constructor() {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.scene = new Scene();
    this.scene.add(new HemisphereLight(0xf6faff, 0x6b7160, 1.9));
    this.key = new DirectionalLight(0xfff3df, 2.1);
    this.scene.add(this.key, this.key.target);
    this.mesh = new Mesh(undefined, new MeshStandardMaterial({ color: 0x7f9f63, roughness: 1 }));
    this.scene.add(this.mesh);
  }

  paint(geometry, camera, canvas) {
    this.renderer.setSize(canvas.width, canvas.height, false);
    this.mesh.geometry = geometry;
    camera.updateMatrixWorld();
    this.key.position.set(-0.55, 0.75, 0.6).transformDirection(camera.matrixWorld);
    this.renderer.render(this.scene, camera);
    const context = canvas.getContext('2d');
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.drawImage(this.renderer.domElement, 0, 0);
  }
}

/** One method's frame: the canvas that stands where the still picture was. */
class Pane {
  constructor(frame, label) {
    this.script = frame.querySelector('script');
    this.canvas = document.createElement('canvas');
    const picture = frame.querySelector('img');
    if (picture) this.canvas.style.aspectRatio = `${picture.width} / ${picture.height}`;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label',
      `${label}; arrow keys turn it, plus and minus zoom, Home resets`);
    frame.append(this.canvas);
    frame.classList.add('live');
  }

  load() {
    this.geometry = unpack(this.script.textContent);
  }

  unload() {
    this.geometry.dispose();
    this.geometry = null;
  }

  /** Gives the canvas as many pixels as it covers. */
  fit() {
    const ratio = Math.min(window.devicePixelRatio, MOST_PIXEL_RATIO);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (width === this.canvas.width && height === this.canvas.height) return;
    this.canvas.width = width;
    this.canvas.height = height;
  }
}

class View {
  constructor(element, painter) {
    this.painter = painter;
    this.camera = new PerspectiveCamera();
    this.target = new Vector3();
    this.loaded = this.waiting = false;
    this.panes = [...element.querySelectorAll('figure')]
      .filter((figure) => figure.querySelector('.frame script'))
      .map((figure) => new Pane(figure.querySelector('.frame'), figure.innerText.split('\n')[0]));
    this.controls = this.panes.map((pane) => this.listen(pane.canvas));
    this.addButtons(element.querySelector('.still'));

    const resized = new ResizeObserver(() => this.draw());
    for (const pane of this.panes) resized.observe(pane.canvas);
    new IntersectionObserver(([entry]) => this.show(entry.isIntersecting), { rootMargin: NEAR })
      .observe(element);
  }

  /** Controls of one canvas; camera and target are those of all. */
  listen(canvas) {
    // A wheel that only passes by scrolls the page.
    canvas.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && document.activeElement !== canvas) event.stopImmediatePropagation();
    }, { capture: true });
    const controls = new OrbitControls(this.camera, canvas);
    controls.target = this.target;
    controls.enableDamping = false;
    canvas.style.touchAction = 'pan-y'; // one finger up or down scrolls the page
    controls.addEventListener('change', () => this.draw());

    const keys = {
      ArrowLeft: () => controls.rotateLeft(TURN),
      ArrowRight: () => controls.rotateLeft(-TURN),
      ArrowUp: () => controls.rotateUp(TURN),
      ArrowDown: () => controls.rotateUp(-TURN),
      '+': () => controls.dollyIn(ZOOM),
      '=': () => controls.dollyIn(ZOOM),
      '-': () => controls.dollyOut(ZOOM),
      Home: () => controls.reset(),
    };
    canvas.addEventListener('keydown', (event) => {
      if (!(event.key in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      keys[event.key]();
    });
    return controls;
  }

  addButtons(note) {
    const [controls] = this.controls;
    const button = (text, label, action) => {
      const element = document.createElement('button');
      element.type = 'button';
      element.textContent = text;
      if (label) element.setAttribute('aria-label', label);
      element.addEventListener('click', action);
      return element;
    };
    const buttons = document.createElement('p');
    buttons.className = 'buttons';
    buttons.append(
      button('−', 'Zoom out', () => controls.dollyOut(ZOOM)),
      button('+', 'Zoom in', () => controls.dollyIn(ZOOM)),
      button('Reset', '', () => controls.reset()));
    note.classList.add('hint');
    note.textContent = HINT;
    note.before(buttons);
  }

  show(visible) {
    if (visible === this.loaded) return;
    this.loaded = visible;
    for (const pane of this.panes) visible ? pane.load() : pane.unload();
    if (!visible) return;
    if (!this.framed) this.frame();
    this.draw();
  }

  /** Puts the camera where every shape fits, however it is turned about its vertical. */
  frame() {
    const box = new Box3();
    for (const pane of this.panes) box.union(pane.geometry.boundingBox);
    box.getCenter(this.target);
    const radius = Math.max(...this.panes.map((pane) => reach(pane.geometry, this.target)));
    const [{ canvas }] = this.panes;
    const aspect = canvas.clientWidth / canvas.clientHeight;
    const tanY = TAN_HALF_VIEW / Math.max(aspect, 1), tanX = tanY * aspect;
    const elevation = MathUtils.degToRad(ELEVATION);
    const height = (box.max.y - box.min.y) / 2 * Math.cos(elevation) + radius * Math.sin(elevation);
    const distance = MARGIN * Math.max(height / tanY, radius / tanX) + radius;

    this.camera.fov = 2 * MathUtils.radToDeg(Math.atan(tanY));
    this.camera.aspect = aspect;
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.camera.updateProjectionMatrix();
    this.camera.position
      .setFromSphericalCoords(distance, Math.PI / 2 - elevation, MathUtils.degToRad(AZIMUTH))
      .add(this.target);
    for (const controls of this.controls) {
      controls.minDistance = distance / 8;
      controls.maxDistance = distance * 3;
      controls.update();
      controls.saveState();
    }
    this.framed = true;
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.loaded) return;
      for (const pane of this.panes) {
        pane.fit();
        this.painter.paint(pane.geometry, this.camera, pane.canvas);
      }
    });
  }
}

async function start() {
  const elements = [...document.querySelectorAll('.view')]
    .filter((element) => element.querySelector('.frame script'));
  let painter;
  try {
    painter = new Painter();
    await MeshoptDecoder.ready;
  } catch {
    for (const note of document.querySelectorAll('.still')) {
      note.textContent = 'Still pictures: turning the shapes needs WebGL, which this browser ' +
        'does not offer.';
    }
    return;
  }
  const views = elements.map((element) => new View(element, painter));
  painter.renderer.domElement.addEventListener('webglcontextrestored', () => {
    for (const view of views) view.draw();
  });
}

start();
