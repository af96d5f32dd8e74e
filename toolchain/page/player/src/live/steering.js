// Instruments that tell a velocity of the hand: keys, a gamepad, a SpaceMouse.
import { isTaken } from '../keyboard.js';
import { cameraAxes } from './grab.js';

const speed = 1 / 3; // shown sizes of the scene a second: 0.1 m/s in a picture of 0.3 m
const turnSpeed = 1; // [rad/s]
const rest = 0.25; // without a wish: the hand is released [s]
const deadZone = 0.15; // of a stick

// Each key's share of the velocity: right, up, away from the eye; with shift it turns about these axes.
const keys = {
  ArrowRight: [1, 0, 0], ArrowLeft: [-1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0],
  PageUp: [0, 0, 1], PageDown: [0, 0, -1],
};
const turns = {
  ArrowRight: [0, 1, 0], ArrowLeft: [0, -1, 0], ArrowUp: [-1, 0, 0], ArrowDown: [1, 0, 0],
  PageUp: [0, 0, 1], PageDown: [0, 0, -1],
};

/** Reads the keys that are held down. */
export class KeyRates {
  constructor() {
    this.held = new Set();
    addEventListener('keydown', (event) => {
      this.shift = event.shiftKey;
      if (!(event.key in keys) || isTaken(event)) return;
      event.preventDefault();
      this.held.add(event.key);
    });
    addEventListener('keyup', (event) => {
      this.shift = event.shiftKey;
      this.held.delete(event.key);
    });
    addEventListener('blur', () => this.held.clear());
  }

  rates() {
    const sum = [0, 0, 0, 0, 0, 0];
    const [shares, first] = this.shift ? [turns, 3] : [keys, 0];
    for (const key of this.held) shares[key].forEach((v, i) => (sum[first + i] += v));
    return sum;
  }
}

function outsideDeadZone(value = 0) {
  return Math.abs(value) < deadZone ? 0 : (value - Math.sign(value) * deadZone) / (1 - deadZone);
}

/** Reads the first gamepad: left stick and triggers move, right stick and shoulder buttons turn. */
export class GamepadRates {
  rates() {
    const pad = navigator.getGamepads?.().find((one) => one);
    if (!pad) return [0, 0, 0, 0, 0, 0];
    const [x, y, turnX, turnY] = [0, 1, 2, 3].map((i) => outsideDeadZone(pad.axes[i]));
    const button = (i) => outsideDeadZone(pad.buttons[i]?.value);
    return [x, -y, button(7) - button(6), turnY, turnX, button(5) - button(4)];
  }
}

/** Moves the hand at the velocities of the instruments. Each gives `rates()`: six numbers from -1 to 1. */
export class Steering {
  constructor(picture, hand, instruments, mayGrab) {
    Object.assign(this, { picture, hand, instruments, mayGrab });
    this.idle = 0;
  }

  /** Moves on by a time [s]. */
  advance(seconds) {
    const { hand } = this;
    const sum = [0, 0, 0, 0, 0, 0];
    for (const instrument of this.instruments) instrument.rates().forEach((v, i) => (sum[i] += v));
    this.idle = sum.some((v) => v !== 0) ? 0 : this.idle + seconds;
    if (this.idle === 0 && !hand.holder && this.mayGrab()) hand.grab('steering');
    if (hand.holder !== 'steering') return;
    if (this.idle > rest) hand.release();
    else this.moveBy(sum.map((v) => Math.min(Math.max(v, -1), 1) * seconds));
  }

  moveBy(shares) {
    const shown = 2 * this.picture.distance * Math.sin(this.picture.data.camera.half_view);
    cameraAxes(this.picture.camera).forEach((axis, i) => {
      this.hand.rotate(axis, turnSpeed * shares[3 + i]);
      this.hand.move(axis.multiplyScalar(speed * shown * shares[i]));
    });
  }
}
