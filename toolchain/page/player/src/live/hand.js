import { Quaternion, Vector3 } from 'three';

const rate = 60; // most messages a second
const repeat = 250; // a held target that rests is sent again after this time [ms]
const lead = 1.5; // most distance from the device to the target, by the size of the body
const leadAngle = 1.2; // [rad]
const speed = 6; // most speed of the target, sizes of the body a second
const turnSpeed = 10; // [rad/s]

/** The target of the hand, which the viewer moves. Poses are those of the moving mesh in W. */
export class Hand {
  /** `centre`: centre of mass in the mesh; `size`: of the body [m]; `send(message)` sends to the server. */
  constructor(centre, size, send) {
    this.centre = centre;
    this.size = size;
    this.send = send;
    this.wanted = { place: new Vector3(), turn: new Quaternion() }; // of the centre of mass
    this.target = { place: new Vector3(), turn: new Quaternion() }; // sent: limited in speed and lead
    this.device = { place: new Vector3(), turn: new Quaternion() };
    this.onGrab = () => {};
  }

  /** Takes the pose of the device from a state. */
  follow([x, y, z, qw, qx, qy, qz]) {
    this.device.turn.set(qx, qy, qz, qw).normalize();
    this.device.place.copy(this.centre).applyQuaternion(this.device.turn).add(new Vector3(x, y, z));
  }

  /** Takes hold of the device where it is. `holder` names the instrument that does it. */
  grab(holder) {
    this.holder = holder;
    for (const pose of [this.wanted, this.target]) {
      pose.place.copy(this.device.place);
      pose.turn.copy(this.device.turn);
    }
    this.sentAt = 0;
    this.steppedAt = performance.now();
    clearInterval(this.timer);
    this.timer = setInterval(() => this.step(), 1000 / rate);
    this.onGrab();
  }

  move(by) {
    this.wanted.place.add(by);
  }

  /** Turns about the centre of mass: about a unit axis of W by an angle [rad]. */
  rotate(axis, angle) {
    this.wanted.turn.premultiply(new Quaternion().setFromAxisAngle(axis, angle)).normalize();
    const ahead = this.wanted.turn.angleTo(this.device.turn);
    if (ahead > leadAngle) this.wanted.turn.copy(this.device.turn.clone().slerp(this.wanted.turn, leadAngle / ahead));
  }

  /** Moves the target towards the wanted pose and sends it. */
  step() {
    const now = performance.now();
    const seconds = Math.min((now - this.steppedAt) / 1000, 0.1);
    this.steppedAt = now;
    const { target, wanted, device, size } = this;
    const before = this.pose();
    const ahead = wanted.place.clone().sub(device.place).clampLength(0, lead * size).add(device.place);
    target.place.add(ahead.sub(target.place).clampLength(0, speed * size * seconds));
    target.turn.rotateTowards(wanted.turn, turnSpeed * seconds);
    const pose = this.pose();
    if (now - this.sentAt < repeat && pose.every((v, i) => Math.abs(v - before[i]) < 1e-7)) return;
    this.sentAt = now;
    this.send({ type: 'hand', pose });
  }

  /** Returns the pose of the target: x, y, z [m], qw, qx, qy, qz. */
  pose() {
    const { place, turn } = this.target;
    const { x, y, z } = this.centre.clone().applyQuaternion(turn).negate().add(place);
    return [x, y, z, turn.w, turn.x, turn.y, turn.z];
  }

  /** Ends the hold: the hand stays where it is. */
  release() {
    if (!this.holder) return;
    this.drop();
    this.send({ type: 'release' });
  }

  /** Ends the hold without a message, because the server has ended it. */
  drop() {
    clearInterval(this.timer);
    this.holder = undefined;
  }
}
