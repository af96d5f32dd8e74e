import {
  Color, DoubleSide, EqualStencilFunc, GreaterDepth, Group, LessEqualDepth, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshStandardMaterial, NotEqualStencilFunc, ReplaceStencilOp, Vector3,
} from 'three';
import { ForceArrow, TorqueArrow } from './arrows.js';

const stillColour = 0xc9c3b6;
const ghostColour = 0xf59e0b;
// The order in which transparent things are drawn. The god object counts as one, to be drawn over the hidden ghost.
const order = { hiddenGhost: 1, cutFace: 1.5, godObject: 2, ghostDepth: 3, ghost: 4 };
const godObjectMark = 128; // in the stencil, where the god object is drawn

function solid(colour, renderOrder) {
  return { material: new MeshStandardMaterial({
    color: colour, roughness: 0.62, metalness: 0.02, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1,
    polygonOffsetUnits: 1, transparent: renderOrder > 0,
  }), renderOrder };
}

function meshOf(geometry, { material, renderOrder }) {
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = renderOrder;
  return mesh;
}

function lines(geometry, colour, opacity, renderOrder) {
  const material = new LineBasicMaterial({ color: colour, transparent: true, opacity });
  const made = new LineSegments(geometry, material);
  made.renderOrder = renderOrder;
  return made;
}

/** The body that stands still. Its frame is the world. */
export class StillBody extends Group {
  constructor(geometries, closed, cut, size) {
    super();
    this.surface = meshOf(geometries.surface, solid(stillColour, 0));
    this.edges = lines(geometries.edges, 0x4b463c, 0.35, 0.5);
    this.add(this.surface, this.edges);
    this.cut = cut;
    if (closed) {
      this.closing = cut.closing(geometries.surface, 0xd9a27c, size, 0.1);
      this.add(this.closing.counted, this.closing.cap);
    }
  }

  refresh() {
    const planes = this.cut.planesFor(false);
    for (const object of [this.surface, this.edges]) object.material.clippingPlanes = planes;
    if (this.closing) this.closing.counted.visible = this.closing.cap.visible = planes.length > 0;
  }
}

/** Sets an object to a pose: x, y, z [m], qw, qx, qy, qz. */
function setPose(object, [x, y, z, qw, qx, qy, qz]) {
  object.position.set(x, y, z);
  object.quaternion.set(qx, qy, qz, qw).normalize();
}

/** Tells if two objects are at one pose, so that one hides the other. `near`: as a length [m] */
function samePose(a, b, near) {
  return a.position.distanceTo(b.position) < near && a.quaternion.angleTo(b.quaternion) < 1e-4;
}

/** Makes a material clearer where it faces the eye, so that its outline stands out. */
function clearInside(material) {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>', `
      float facing = abs(dot(normalize(vViewPosition), normal));
      diffuseColor.a *= mix(1.0, 0.24, smoothstep(0.0, 0.75, facing));
      #include <opaque_fragment>`);
  };
  return material;
}

/** Returns a translucent body of which only the outermost layer shows, and faintly where the still body hides it. */
function ghostBody(geometries) {
  const group = new Group();
  const colour = new Color(ghostColour);
  const hidden = new MeshBasicMaterial({
    color: colour, transparent: true, opacity: 0.16, depthFunc: GreaterDepth, depthWrite: false, stencilWrite: true,
    stencilRef: 255, stencilFunc: NotEqualStencilFunc, stencilZPass: ReplaceStencilOp,
  });
  const hiddenMesh = meshOf(geometries.surface, { material: hidden, renderOrder: order.hiddenGhost });
  hiddenMesh.onAfterRender = (renderer) => renderer.clearStencil();
  const depth = new MeshBasicMaterial({ colorWrite: false, transparent: true });
  // Over the god object the ghost is fainter, because the two surfaces cross each other there.
  const shown = [[NotEqualStencilFunc, 0.85], [EqualStencilFunc, 0.4]].map(([stencilFunc, opacity]) =>
    clearInside(new MeshStandardMaterial({
      color: colour, transparent: true, opacity, roughness: 0.7, depthFunc: LessEqualDepth, depthWrite: false,
      stencilWrite: true, stencilRef: godObjectMark, stencilFunc,
    })));
  group.surface = meshOf(geometries.surface, { material: depth, renderOrder: order.ghostDepth });
  group.lit = shown;
  group.add(
    hiddenMesh,
    group.surface,
    ...shown.map((material) => meshOf(geometries.surface, { material, renderOrder: order.ghost })),
    lines(geometries.edges, 0xd97706, 0.9, order.ghost),
  );
  return group;
}

/** One motion of the moving body in 3D: god object, device pose and arrows. */
export class MovingBodies extends Group {
  /** `scale`: lengths of the longest arrows [m] and their force [N] and torque [Nm]; `size`: of faces of a cut [m]. */
  constructor(body, geometries, colour, cut, scale, size) {
    super();
    this.centre = new Vector3(...body.centre);
    this.cut = cut;
    this.size = scale.length;
    this.godObject = new Group();
    this.surface = meshOf(geometries.surface, solid(colour, order.godObject));
    Object.assign(this.surface.material, {
      stencilWrite: true, stencilRef: godObjectMark, stencilZPass: ReplaceStencilOp,
    });
    this.surfaces = [this.surface];
    this.edges = lines(geometries.edges, new Color(colour).multiplyScalar(0.35), 0.6, order.godObject + 0.2);
    this.godObject.add(this.surface, this.edges);
    if (body.closed) {
      this.closing = cut.closing(geometries.surface, new Color(colour).multiplyScalar(0.6), size, order.cutFace);
      for (const object of [...this.closing.counted.children, this.closing.cap]) object.material.transparent = true;
      this.godObject.add(this.closing.counted);
      this.add(this.closing.cap);
    }
    this.ghost = ghostBody(geometries);
    this.force = new ForceArrow(0xe11d48, scale.length, scale.force);
    this.torque = new TorqueArrow(0x16a34a, scale.radius, scale.torque);
    this.add(this.godObject, this.ghost, this.force, this.torque);
  }

  /** Adds a surface of the god object with other colours, which `prepare(material)` gives it. */
  addColoured(geometry, prepare) {
    this.coloured = meshOf(geometry, { material: this.surface.material.clone(), renderOrder: order.godObject });
    prepare(this.coloured.material);
    this.surfaces.push(this.coloured);
    this.godObject.add(this.coloured);
    this.refresh();
  }

  /** Shows the coloured surface or the plain one. The ghost does not tint the coloured one. */
  showColoured(on) {
    this.surface.visible = !on;
    this.ghost.lit[1].visible = !on;
    if (this.coloured) this.coloured.visible = on;
  }

  /** Returns the centre of mass of the god object in W [m]. */
  place() {
    return this.centre.clone().applyQuaternion(this.godObject.quaternion).add(this.godObject.position);
  }

  /** Shows the poses `device` and `god` of the mesh in W, and the `force` [N] and `torque` [Nm] on the device. */
  show({ device, god, force, torque }) {
    setPose(this.godObject, god);
    setPose(this.ghost, device);
    this.ghost.visible = !samePose(this.ghost, this.godObject, 1e-4 * this.size);
    const at = this.centre.clone().applyQuaternion(this.ghost.quaternion).add(this.ghost.position);
    this.force.show(at, new Vector3(...force));
    this.torque.show(at, new Vector3(...torque));
  }

  /** Makes the bodies lighter, to show that the pointer can take them. */
  highlight(on) {
    for (const { emissive } of [...this.surfaces.map(({ material }) => material), ...this.ghost.lit]) emissive.setScalar(on ? 0.09 : 0);
  }

  refresh() {
    const planes = this.cut.planesFor(true);
    for (const object of [...this.surfaces, this.edges]) object.material.clippingPlanes = planes;
    for (const part of this.ghost.children) part.material.clippingPlanes = planes;
    this.ghost.children[0].visible = !this.cut.on; // the cut shows what the still body hides
    if (this.closing) this.closing.counted.visible = this.closing.cap.visible = planes.length > 0;
  }
}
