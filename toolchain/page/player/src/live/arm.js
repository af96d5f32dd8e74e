import { CylinderGeometry, Group, MeshBasicMaterial, MeshStandardMaterial, SphereGeometry, Vector3 } from 'three';
import { Instances } from './instances.js';

const most = 16;

/** The arm: a ball in each joint, and a tube from each to the next one or the tool. Translucent. */
export class Arm extends Group {
  /** `size`: of the moving body [m]. */
  constructor(size) {
    super();
    this.size = size;
    const hidden = new MeshBasicMaterial({ colorWrite: false, transparent: true });
    const shown = (colour) => new MeshStandardMaterial({
      color: colour, roughness: 0.5, metalness: 0.1, transparent: true, opacity: 0.4,
    });
    const tube = new CylinderGeometry(0.8, 1, 1, 24).translate(0, 0.5, 0);
    const ball = new SphereGeometry(1, 18, 10);
    // The first two hide the back of the arm, so that the others show its outermost layer only.
    this.tubes = [hidden, shown(0x94a3b8)].map((material, i) => new Instances(tube, material, most, 6 + i));
    this.balls = [hidden, shown(0x475569)].map((material, i) => new Instances(ball, material, most, 6 + i));
    this.add(...this.tubes, ...this.balls);
  }

  /** Shows the origins of the joints in W [m], from the base to the tool. */
  show(origins) {
    const places = origins.map((origin) => new Vector3(...origin));
    const total = places.slice(1).reduce((sum, place, i) => sum + place.distanceTo(places[i]), 0);
    const radius = Math.min(0.03 * total, 0.1 * this.size);
    for (const part of [...this.tubes, ...this.balls]) part.clear();
    places.forEach((place, i) => {
      const thin = radius * (1 - (0.45 * i) / places.length);
      const link = places[i + 1]?.clone().sub(place);
      if (!link || link.length() < 1e-6) return;
      for (const balls of this.balls) balls.put(place, new Vector3(0, 1, 0), 1.25 * thin, 1.25 * thin);
      for (const tubes of this.tubes) tubes.put(place, link.clone().normalize(), thin, link.length());
    });
  }
}
