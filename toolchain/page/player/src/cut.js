import {
  AlwaysStencilFunc, BackSide, DecrementWrapStencilOp, DoubleSide, FrontSide, Group, IncrementWrapStencilOp, Mesh,
  MeshBasicMaterial, MeshStandardMaterial, NotEqualStencilFunc, Plane, PlaneGeometry, ReplaceStencilOp, Vector3,
} from 'three';

/** A plane that cuts away the part of a body between it and the eye. */
export class Cut {
  constructor() {
    this.plane = new Plane(new Vector3(0, 0, -1), 0);
    this.caps = [];
    this.on = false;
    this.both = false;
  }

  /** Sets the plane: across an axis of W (0 .. 2) at a place [m], open towards the eye. */
  place(axis, position, towardsEye) {
    const normal = new Vector3().setComponent(axis, towardsEye.getComponent(axis) > 0 ? -1 : 1);
    this.plane.setFromNormalAndCoplanarPoint(normal, new Vector3().setComponent(axis, position));
    for (const cap of this.caps) {
      cap.position.copy(this.plane.normal).multiplyScalar(-this.plane.constant);
      cap.lookAt(cap.position.clone().sub(this.plane.normal));
    }
  }

  /** Returns the planes for a body: those of the still one, or of a moving one. */
  planesFor(moving) {
    return this.on && (this.both || !moving) ? [this.plane] : [];
  }

  /** Returns objects that close the cut of a closed body. `counted` moves with the body, `cap` lies in the plane. */
  closing(geometry, colour, size, order) {
    const counted = new Group();
    for (const [side, operation] of [[BackSide, IncrementWrapStencilOp], [FrontSide, DecrementWrapStencilOp]]) {
      const material = new MeshBasicMaterial({
        side, depthWrite: false, depthTest: false, colorWrite: false, stencilWrite: true,
        stencilFunc: AlwaysStencilFunc, clippingPlanes: [this.plane],
        stencilFail: operation, stencilZFail: operation, stencilZPass: operation,
      });
      const mesh = new Mesh(geometry, material);
      mesh.renderOrder = order;
      counted.add(mesh);
    }
    const cap = new Mesh(new PlaneGeometry(size, size), new MeshStandardMaterial({
      color: colour, roughness: 1, side: DoubleSide, stencilWrite: true, stencilRef: 0,
      stencilFunc: NotEqualStencilFunc, stencilFail: ReplaceStencilOp, stencilZFail: ReplaceStencilOp,
      stencilZPass: ReplaceStencilOp,
    }));
    cap.renderOrder = order + 0.1;
    cap.onAfterRender = (renderer) => renderer.clearStencil();
    this.caps.push(cap);
    return { counted, cap };
  }
}
