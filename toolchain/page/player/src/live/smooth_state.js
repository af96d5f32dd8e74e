import { Quaternion } from 'three';

const longestDelay = 60; // of the picture behind the latest state [ms]

function mix(a, b, share) {
  return a.map((v, i) => v + share * (b[i] - v));
}

/** Returns a pose between two: x, y, z [m], qw, qx, qy, qz. */
function mixPoses(a, b, share) {
  const [from, to] = [a, b].map(([, , , w, x, y, z]) => new Quaternion(x, y, z, w));
  const { w, x, y, z } = from.slerp(to, share);
  return [...mix(a.slice(0, 3), b.slice(0, 3), share), w, x, y, z];
}

/** The latest state, towards which the picture moves evenly until the next one is due. */
export class SmoothState {
  /** Takes a state at a time [ms]. Poses that are not known (null) leave the picture as it is. */
  take(state, now) {
    if (![...state.device, ...state.god].every(Number.isFinite)) return;
    this.from = this.latest ? this.at(now) : state;
    this.span = this.latest ? Math.min(now - this.arrived, longestDelay) : 0;
    this.latest = state;
    this.arrived = now;
    this.settled = false;
  }

  /** Returns the state to show at a time [ms]. */
  at(now) {
    const share = this.span > 0 ? Math.min((now - this.arrived) / this.span, 1) : 1;
    this.settled = share === 1;
    if (this.settled) return this.latest;
    const { from, latest } = this;
    return {
      device: mixPoses(from.device, latest.device, share), god: mixPoses(from.god, latest.god, share),
      force: mix(from.force, latest.force, share), torque: mix(from.torque, latest.torque, share),
    };
  }
}
