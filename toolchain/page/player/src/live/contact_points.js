import { ConeGeometry, CylinderGeometry, Group, MeshBasicMaterial, Vector3 } from 'three';
import { Instances } from './instances.js';

const most = 64;

function flat(colour, opacity = 1) {
  return new MeshBasicMaterial({ color: colour, depthTest: false, depthWrite: false, transparent: true, opacity });
}

/** The contact points: a disc on the surface of each, and an arrow along its normal in proportion to its load. */
export class ContactPoints extends Group {
  /** `size`: of the moving body [m]; `longest`: length of the arrow of the force `largest` [N]. */
  constructor(size, longest, largest) {
    super();
    Object.assign(this, { size, longest, largest });
    const disc = new CylinderGeometry(1, 1, 1, 20);
    this.rims = new Instances(disc, flat(0x111827), most, 21);
    this.discs = new Instances(disc, flat(0xfde047), most, 22);
    this.shafts = new Instances(new CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0), flat(0x111827, 0.85), most, 22);
    this.heads = new Instances(new ConeGeometry(1, 1, 12).translate(0, 0.5, 0), flat(0x111827, 0.85), most, 22);
    this.add(this.rims, this.discs, this.shafts, this.heads);
  }

  setDark(dark) {
    for (const { material } of [this.shafts, this.heads]) material.color.set(dark ? 0xf8fafc : 0x111827);
  }

  /** Shows points: x, y, z [m], the normal out of the still body, the load [N]. */
  show(points) {
    const { rims, discs, shafts, heads, size } = this;
    for (const part of [rims, discs, shafts, heads]) part.clear();
    for (const [x, y, z, nx, ny, nz, load] of points) {
      const place = new Vector3(x, y, z);
      const normal = new Vector3(nx, ny, nz).normalize();
      rims.put(place, normal, 0.018 * size, 0.002 * size);
      discs.put(place, normal, 0.012 * size, 0.004 * size);
      const length = Math.min(load / this.largest, 1) * this.longest;
      if (length < 0.02 * size) continue;
      const head = Math.min(0.05 * size, 0.5 * length);
      shafts.put(place, normal, 0.004 * size, length - 0.9 * head);
      heads.put(place.clone().addScaledVector(normal, length - head), normal, 0.35 * head, head);
    }
  }
}
