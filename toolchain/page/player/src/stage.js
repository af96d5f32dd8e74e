import {
  Box3, Box3Helper, Color, DirectionalLight, GridHelper, HemisphereLight, Scene, Vector3,
} from 'three';

const steps = [1, 2, 5];

/** Returns 1, 2 or 5 times a power of ten, near to and not above a length. */
export function roundLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * steps.filter((step) => step * power <= length * 1.0001).at(-1);
}

/** The surroundings of the bodies: lights, a grid below the still body and the box of the workspace. */
export class Stage {
  /** `size`: of the shown part of the scene [m]; `lowest(up)`: lowest place worth showing along an axis of W [m]. */
  constructor(data, size, lowest) {
    this.scene = new Scene();
    this.sky = new HemisphereLight(0xffffff, 0x8a8578, 1.25);
    this.key = new DirectionalLight(0xffffff, 2.0);
    this.fill = new DirectionalLight(0xdfe8ff, 0.6);
    this.scene.add(this.sky, this.key, this.key.target, this.fill, this.fill.target);
    this.gridStep = roundLength(0.2 * size);
    this.size = size;
    this.floor = (up) => Math.max(lowest(up), data.still.low[up] - size);
    if (data.workspace) {
      const box = new Box3(new Vector3(...data.workspace.low), new Vector3(...data.workspace.high));
      this.workspace = new Box3Helper(box, 0xf59e0b);
      this.scene.add(this.workspace);
    }
  }

  /** Draws the grid across an axis of W, in a colour that suits the ground. */
  setGround(up, target, dark) {
    if (this.grid) {
      this.scene.remove(this.grid);
      this.grid.dispose();
    }
    const divisions = 24;
    this.grid = new GridHelper(divisions * this.gridStep, divisions);
    const colour = new Color(dark ? 0x3a4150 : 0xc3c8d0);
    this.grid.material.vertexColors = false;
    this.grid.material.color = colour;
    this.grid.material.transparent = true;
    this.grid.material.opacity = dark ? 0.7 : 0.8;
    const normal = new Vector3().setComponent(up, 1);
    this.grid.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), normal);
    const centre = target.clone();
    for (let axis = 0; axis < 3; ++axis) {
      centre.setComponent(axis, Math.round(centre.getComponent(axis) / this.gridStep) * this.gridStep);
    }
    this.grid.position.copy(centre.setComponent(up, this.floor(up) - 0.002 * this.size));
    this.scene.add(this.grid);
  }

  /** Puts the main light beside and above the eye, so that edges are readable from everywhere. */
  light(camera, target, up) {
    const right = new Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
    const above = new Vector3().setComponent(up, 1);
    const toEye = camera.position.clone().sub(target);
    const distance = toEye.length();
    this.key.position.copy(camera.position).addScaledVector(right, -0.5 * distance);
    this.key.position.addScaledVector(above, 0.9 * distance);
    this.key.target.position.copy(target);
    this.fill.position.copy(target).addScaledVector(right, distance).addScaledVector(toEye, 0.2);
    this.fill.target.position.copy(target);
  }
}
