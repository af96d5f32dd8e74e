import { PerspectiveCamera, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { MovingBodies, StillBody } from './bodies.js';
import { bodyGeometries } from './body_geometry.js';
import { Cut } from './cut.js';
import { DistanceColours } from './distance/distance_colours.js';
import { Stage } from './stage.js';
import { motionColours } from './theme.js';

function diagonal(body) {
  return new Vector3(...body.high).distanceTo(new Vector3(...body.low));
}

/** The 3D picture: one view for each motion of the moving body, all with one camera. */
export class Picture {
  /**
   * `count`: of motions; `largest`: the force [N] and the torque [Nm] of the longest arrows; `lowest(up)`: the lowest
   * place along an axis of W that is worth showing [m]; `smoothEdges`: draws edges without steps. Throws an error
   * without WebGL.
   */
  constructor(data, canvas, { count, largest, lowest, smoothEdges }) {
    this.data = data;
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: smoothEdges, alpha: true, stencil: true });
    this.renderer.localClippingEnabled = true;
    this.setSharpness(1);
    this.renderer.setScissorTest(true);
    this.renderer.autoClear = false;
    this.up = data.up;
    this.target = new Vector3(...data.camera.target);
    this.eye = new Vector3(...data.camera.eye);
    this.distance = this.eye.distanceTo(this.target);
    const shownSize = 2 * this.distance * Math.sin(data.camera.half_view);
    this.cut = new Cut();
    this.stage = new Stage(data, shownSize, lowest);
    this.size = Math.min(diagonal(data.moving), shownSize);
    this.makeBodies(count, largest, 4 * (diagonal(data.still) + shownSize));
    this.colours = new DistanceColours(this);
    this.camera = new PerspectiveCamera(35, 1, 0.01 * this.distance, 50 * this.distance + 4 * diagonal(data.still));
    this.columns = 1;
    this.resetView();
  }

  makeBodies(count, largest, capSize) {
    const { data, cut, stage, size } = this;
    const scale = { length: 0.55 * size, radius: 0.25 * size, ...largest };
    this.still = new StillBody(bodyGeometries(data.still), data.still.closed, cut, capSize);
    const moving = bodyGeometries(data.moving);
    this.motions = Array.from({ length: count }, (_, i) =>
      new MovingBodies(data.moving, moving, motionColours[i], cut, scale, capSize));
    stage.scene.add(this.still, ...this.motions);
  }

  setUp(axis) {
    this.up = axis;
    const toEye = this.eye.clone().sub(this.target);
    if (axis !== this.data.up) { // the direction of the file's camera fits another axis
      toEye.setScalar(0.35 * this.distance).setComponent((axis + 1) % 3, 0.8 * this.distance);
      toEye.setLength(this.distance);
    }
    this.place(toEye);
  }

  resetView() {
    this.setUp(this.up);
  }

  place(toEye) {
    this.controls?.dispose();
    this.camera.up.set(0, 0, 0).setComponent(this.up, 1);
    const room = this.motions.length > 1 ? 1.02 : 0.9; // small views have more beside their labels
    const widening = room * Math.max(1, 1 / Math.max(this.camera.aspect, 0.3)) ** 0.85;
    this.camera.position.copy(this.target).addScaledVector(toEye, widening);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.copy(this.target);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.02 * this.distance;
    this.controls.maxDistance = 12 * this.distance;
    this.controls.addEventListener('change', () => this.invalidate());
    this.controls.update();
    this.stage.setGround(this.up, this.target, this.dark);
    this.invalidate();
  }

  setDark(dark) {
    this.dark = dark;
    this.stage.setGround(this.up, this.target, dark);
    this.invalidate();
  }

  setCut({ on, both, axis, position }) {
    Object.assign(this.cut, { on, both });
    this.cutAxis = axis;
    this.cutPosition = position;
    this.still.refresh();
    for (const motion of this.motions) motion.refresh();
    this.invalidate();
  }

  setFollow(on) {
    this.follows = on;
  }

  /** Returns the extent of everything along an axis of W [m]. */
  extent(axis) {
    return [this.data.still.low[axis], this.data.still.high[axis]];
  }

  invalidate() {
    this.stale = true;
  }

  /** Shows one state of each motion, see `MovingBodies`. */
  show(states) {
    this.motions.forEach((motion, i) => motion.show(states[i]));
    const place = this.motions[0].place();
    if (this.follows) {
      const moved = place.clone().sub(this.shownPlace);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
      this.controls.update();
    }
    this.shownPlace = place;
    this.invalidate();
  }

  /** Fits the picture to its element: views side by side in a wide one, else one above the other. */
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    const count = this.motions.length;
    const before = this.camera.aspect;
    this.columns = width > height * 0.9 ? count : 1;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / this.columns / (height / (count / this.columns));
    const half = Math.tan(this.data.camera.half_view);
    this.camera.fov = (360 / Math.PI) * Math.atan(half);
    this.camera.updateProjectionMatrix();
    if (!this.sized || Math.abs(before - this.camera.aspect) > 0.3) this.resetView();
    this.sized = true;
    this.invalidate();
  }

  /** Returns the rectangles of the views in the element, from the top left [px]. */
  views() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const rows = this.motions.length / this.columns;
    return this.motions.map((_, i) => ({
      left: ((i % this.columns) * width) / this.columns,
      top: (Math.floor(i / this.columns) * height) / rows,
      width: width / this.columns,
      height: height / rows,
    }));
  }

  /** Sets the pixels of a length of the picture by those of the screen, of which at most 2 by CSS pixel count. */
  setSharpness(share) {
    const ratio = share * Math.min(devicePixelRatio, 2);
    if (ratio === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(ratio);
    this.invalidate();
  }

  /** Draws if anything changed. */
  draw() {
    if (!this.colours.advance() && !this.stale) return;
    this.stale = false;
    const { camera, renderer, stage } = this;
    if (this.cut.on) {
      this.cut.place(this.cutAxis, this.cutPosition, camera.position.clone().sub(this.controls.target));
    }
    stage.light(camera, this.controls.target, this.up);
    const height = this.canvas.parentElement.clientHeight;
    this.views().forEach((view, i) => {
      this.motions.forEach((motion, k) => (motion.visible = i === k));
      const bottom = height - view.top - view.height;
      renderer.setViewport(view.left, bottom, view.width, view.height);
      renderer.setScissor(view.left, bottom, view.width, view.height);
      renderer.clear();
      renderer.render(stage.scene, camera);
    });
  }
}
