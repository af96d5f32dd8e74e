import { InstancedMesh, Matrix4, Quaternion, Vector3 } from 'three';

const axis = new Vector3(0, 1, 0);

/** Copies of one shape along the y axis, of which each can be placed anywhere. */
export class Instances extends InstancedMesh {
  constructor(geometry, material, most, renderOrder) {
    super(geometry, material, most);
    this.count = 0;
    this.most = most;
    this.frustumCulled = false;
    this.renderOrder = renderOrder;
  }

  clear() {
    this.count = 0;
  }

  /** Adds a copy whose y axis has a direction (of unit length), with a width across it and a length along it [m]. */
  put(place, direction, width, length) {
    if (this.count === this.most) return;
    const turn = new Quaternion().setFromUnitVectors(axis, direction);
    this.setMatrixAt(this.count++, new Matrix4().compose(place, turn, new Vector3(width, length, width)));
    this.instanceMatrix.needsUpdate = true;
  }
}
