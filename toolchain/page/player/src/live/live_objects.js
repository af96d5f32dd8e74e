import { BufferGeometry, Line, LineBasicMaterial, Vector3 } from 'three';
import { Arm } from './arm.js';
import { ContactPoints } from './contact_points.js';

function bandLine() {
  const geometry = new BufferGeometry().setFromPoints([new Vector3(), new Vector3()]);
  const line = new Line(geometry, new LineBasicMaterial({ color: 0xb45309, depthTest: false, transparent: true }));
  line.renderOrder = 23;
  line.frustumCulled = false;
  line.visible = false;
  return line;
}

/** Adds to a picture the objects that only a live page shows: contact points, the arm, the pull of the hand. */
export class LiveObjects {
  constructor(picture, largestForce) {
    this.picture = picture;
    this.points = new ContactPoints(picture.size, 0.4 * picture.size, largestForce);
    this.arm = new Arm(picture.size);
    this.band = bandLine();
    picture.stage.scene.add(this.points, this.arm, this.band);
  }

  setDark(dark) {
    this.points.setDark(dark);
    this.band.material.color.set(dark ? 0xfbbf24 : 0xb45309);
  }

  showArm(on) {
    this.arm.visible = on;
    this.picture.invalidate();
  }

  /** Shows what does not move smoothly: the latest contact points and joints. */
  show({ points, arm }) {
    this.points.show(points);
    this.arm.show(arm);
    this.picture.invalidate();
  }

  /** Shows the line from the device to the target: two points of W [m], or none. */
  showBand(ends) {
    if (!ends && !this.band.visible) return;
    this.band.visible = Boolean(ends);
    if (ends) this.band.geometry.setFromPoints(ends);
    this.picture.invalidate();
  }
}
