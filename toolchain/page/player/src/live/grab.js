import { Raycaster, Vector2, Vector3 } from 'three';

const turnOfDrag = Math.PI; // of a drag across the height of the picture [rad]
const wheelStep = 4e-4; // change of the distance to the eye for a unit of the wheel, by that distance
const fingerReach = 14; // a finger takes the body from as far [px]

/** Returns the axes of the camera in W: to the right, upwards, away from the eye. */
export function cameraAxes(camera) {
  return [[1, 0, 0], [0, 1, 0], [0, 0, -1]].map((axis) => new Vector3(...axis).applyQuaternion(camera.quaternion));
}

/** Moves the hand by pointers that take the moving body in the picture. Other drags turn the camera. */
export class Grab {
  /** `mayGrab()` tells if the hand may be taken now. */
  constructor(picture, hand, view, mayGrab) {
    this.picture = picture;
    this.hand = hand;
    this.mayGrab = mayGrab;
    this.pointers = new Map(); // that hold the body, with their places [px]
    this.others = new Set(); // that move the camera
    this.raycaster = new Raycaster();
    const events = {
      pointerdown: (event) => this.down(event), pointermove: (event) => this.moved(event),
      pointerup: (event) => this.up(event), pointercancel: (event) => this.up(event),
    };
    for (const [name, act] of Object.entries(events)) view.addEventListener(name, act, { capture: true });
    // Anywhere, because a pointer that holds the body may leave the picture.
    addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
    picture.canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  /** Returns the point of the moving body under a place of the window, or undefined: [m] in W. */
  pointAt(x, y, reach) {
    const { canvas, camera, motions: [motion], still } = this.picture;
    const box = canvas.getBoundingClientRect();
    const bodies = [motion.surface, ...(motion.ghost.visible ? [motion.ghost.surface] : [])];
    for (const [right, down] of [[0, 0], ...(reach ? [[1, 0], [-1, 0], [0, 1], [0, -1]] : [])]) {
      const place = new Vector2(
        (2 * (x + reach * right - box.left)) / box.width - 1, 1 - (2 * (y + reach * down - box.top)) / box.height);
      this.raycaster.setFromCamera(place, camera);
      const [hit] = this.raycaster.intersectObjects(bodies, false);
      if (!hit) continue;
      const [before] = this.picture.cut.on ? [] : this.raycaster.intersectObject(still.surface, false);
      if (!before || before.distance > hit.distance) return hit.point;
    }
    return undefined;
  }

  down(event) {
    const taken = event.target !== this.picture.canvas; // a button above the picture
    if (taken || (event.pointerType === 'mouse' && event.button !== 0)) return;
    if (this.pointers.size === 0) {
      const reach = event.pointerType === 'touch' ? fingerReach : 0;
      const point = this.others.size || !this.mayGrab() ? undefined : this.pointAt(event.clientX, event.clientY, reach);
      if (!point) {
        this.others.add(event.pointerId);
        return;
      }
      this.hand.grab('pointer');
      this.point = this.onDevice(point);
    }
    event.stopImmediatePropagation();
    event.preventDefault();
    this.picture.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, new Vector2(event.clientX, event.clientY));
  }

  /** Returns a point of W in the frame of the mesh, from its centre of mass [m]. */
  onDevice(point) {
    const { place, turn } = this.hand.device;
    return point.clone().sub(place).applyQuaternion(turn.clone().invert());
  }

  /** Returns the ends of the line from the device to the target at the point that was taken, or undefined. */
  band() {
    if (!this.pointers.size || this.hand.holder !== 'pointer') return undefined;
    return [this.hand.device, this.hand.target].map(({ place, turn }) =>
      this.point.clone().applyQuaternion(turn).add(place));
  }

  moved(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.hover(event);
      return;
    }
    event.stopImmediatePropagation();
    const now = new Vector2(event.clientX, event.clientY);
    if (this.hand.holder === 'pointer') {
      if (this.pointers.size > 1) this.pinch(event.pointerId, before, now);
      else if (event.shiftKey) this.turn(now.clone().sub(before));
      else if (event.altKey || event.ctrlKey || event.metaKey) this.twist(this.centreInWindow(), before, now);
      else this.shift(now.clone().sub(before));
    }
    this.pointers.set(event.pointerId, now);
  }

  up(event) {
    this.others.delete(event.pointerId);
    if (!this.pointers.delete(event.pointerId)) return;
    event.stopImmediatePropagation();
    if (!this.pointers.size) this.hand.release();
  }

  wheel(event) {
    if (!this.pointers.size) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 30 : 1;
    this.nearer(Math.min(Math.max(event.deltaY * lines * wheelStep, -0.1), 0.1));
  }

  /** Shows by the pointer and a lighter colour that the body can be taken. */
  hover(event) {
    if (event.pointerType !== 'mouse' || event.buttons || performance.now() - (this.lookedAt ?? 0) < 50) return;
    this.lookedAt = performance.now();
    const over = event.target === this.picture.canvas && this.mayGrab() &&
      Boolean(this.pointAt(event.clientX, event.clientY, 0));
    if (over === this.over) return;
    this.over = over;
    this.picture.canvas.classList.toggle('over-body', over);
    this.picture.motions[0].highlight(over);
    this.picture.invalidate();
  }

  /** Returns the distance of the wanted centre of mass from the eye along the line of sight [m]. */
  depth() {
    const away = cameraAxes(this.picture.camera)[2];
    const { near } = this.picture.camera;
    return Math.max(this.hand.wanted.place.clone().sub(this.picture.camera.position).dot(away), near);
  }

  /** Moves the target with the pointer in the plane of the screen, by pixels. */
  shift({ x, y }) {
    const { camera, canvas } = this.picture;
    const [right, up] = cameraAxes(camera);
    const metres = (2 * this.depth() * Math.tan((camera.fov * Math.PI) / 360)) / canvas.clientHeight;
    this.hand.move(right.multiplyScalar(x * metres).addScaledVector(up, -y * metres));
  }

  /** Turns the target as a drag turns a ball, by pixels. */
  turn({ x, y }) {
    const [right, up] = cameraAxes(this.picture.camera);
    const angle = turnOfDrag / this.picture.canvas.clientHeight;
    this.hand.rotate(up, x * angle);
    this.hand.rotate(right, y * angle);
  }

  /** Twists the target about the line of sight as a pointer goes round a centre in the window [px]. */
  twist(centre, before, now) {
    const [a, b] = [before, now].map((place) => place.clone().sub(centre));
    const size = Math.max(a.length() * b.length(), 900); // near the centre the direction is uncertain
    this.hand.rotate(cameraAxes(this.picture.camera)[2], a.cross(b) / size);
  }

  /** Moves the target towards the eye by a share of its distance. */
  nearer(share) {
    const toEye = cameraAxes(this.picture.camera)[2].negate();
    this.hand.move(toEye.multiplyScalar(share * this.depth()));
  }

  /** Two fingers move, twist and pull: one of them goes from a place to another [px]. */
  pinch(id, before, now) {
    const [other] = [...this.pointers].filter(([key]) => key !== id).map(([, place]) => place);
    this.shift(now.clone().sub(before).multiplyScalar(0.5));
    this.twist(other, before, now);
    const stretched = now.distanceTo(other) / Math.max(before.distanceTo(other), 20);
    this.nearer(Math.min(Math.max(1 - 1 / stretched, -0.1), 0.1));
  }

  centreInWindow() {
    const { camera, canvas } = this.picture;
    const { x, y } = this.hand.target.place.clone().project(camera);
    const box = canvas.getBoundingClientRect();
    return new Vector2(box.left + ((x + 1) / 2) * box.width, box.top + ((1 - y) / 2) * box.height);
  }
}
