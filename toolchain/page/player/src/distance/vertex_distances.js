import { DataTexture, FloatType, Matrix4, RedFormat, Vector3 } from 'three';

export const texels = 1024; // in a row of the texture
// In each pass a vertex is measured again after it has moved by more than this share of its distance. The last pass is for
// bodies that rest.
const tolerances = [0.25, 0.02, 0];
const atOnce = 16; // vertices between two looks at the clock
const distant = 1e9; // the vertices that were not measured yet are thought to come from as far [m]

/** The distances of the vertices of a moving body, as a texture. Few are measured at a time, the most wrong ones first. */
export class VertexDistances {
  /** `points`: the vertices [m]; `measure(point, bound)`: see `SignedDistance`. */
  constructor(points, scale, measure) {
    Object.assign(this, { points, scale, measure });
    this.count = points.length / 3;
    this.known = new Float32Array(texels * Math.ceil(this.count / texels)).fill(scale.far);
    this.texture = new DataTexture(this.known, texels, this.known.length / texels, RedFormat, FloatType);
    this.texture.needsUpdate = true;
    this.places = new Float64Array(points.length).fill(distant); // where each was measured, in W [m]
    this.pose = new Matrix4();
    this.now = new Vector3();
    this.latest = { place: new Vector3(distant, distant, distant), distance: scale.far };
    this.next = 0;
    this.begin();
  }

  begin() {
    this.pass = 0;
    this.left = this.count;
  }

  /** Tells if all distances up to `far` are those of the latest pose. */
  get settled() {
    return this.pass === tolerances.length;
  }

  /** Measures at a pose of the body, for about a time [ms]. Returns true if anything changed. */
  advance(pose, budget) {
    const end = performance.now() + budget;
    const rests = pose.equals(this.pose);
    if (!rests) {
      this.pose.copy(pose);
      this.begin();
    }
    const passes = tolerances.length - (rests ? 0 : 1);
    let changed = false;
    while (this.pass < passes && performance.now() < end) changed = this.renewSome() || changed;
    if (changed) this.texture.needsUpdate = true;
    return changed;
  }

  renewSome() {
    let changed = false;
    for (let i = 0; i < atOnce && !this.settled; ++i) {
      changed = this.renew(this.next) || changed;
      this.next = (this.next + 1) % this.count;
      if (--this.left > 0) continue;
      this.pass += 1;
      this.left = this.count;
    }
    return changed;
  }

  /** Measures a vertex if its colour may be wrong. Returns true if it did. */
  renew(i) {
    const { now, known, scale: { far, near }, latest } = this;
    now.fromArray(this.points, 3 * i).applyMatrix4(this.pose);
    const moved = this.distanceTo(this.places, 3 * i);
    const size = Math.abs(known[i]);
    // A distance changes at most by the distance travelled. This bounds the search, and spares vertices far away.
    if (moved <= tolerances[this.pass] * (size + near) || size - moved > far) return false;
    const apart = now.distanceTo(latest.place);
    if (Math.abs(latest.distance) - apart <= far) {
      latest.distance = this.measure(now, Math.min(size + moved, Math.abs(latest.distance) + apart));
      latest.place.copy(now);
    }
    known[i] = latest.distance;
    latest.place.toArray(this.places, 3 * i);
    return true;
  }

  /** Returns the distance of the vertex from a place in a list [m]. */
  distanceTo(places, at) {
    const { x, y, z } = this.now;
    const [dx, dy, dz] = [x - places[at], y - places[at + 1], z - places[at + 2]];
    return Math.sqrt(dx * dx + dy * dy + dz * dz);
  }
}
