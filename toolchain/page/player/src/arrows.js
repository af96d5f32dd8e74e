import {
  ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, TorusGeometry, Vector3,
} from 'three';

const axis = new Vector3(0, 1, 0);
const most = 1.2; // a live force may exceed the largest one that was expected

function onTop(colour, opacity) {
  return new MeshBasicMaterial({ color: colour, depthTest: false, depthWrite: false, transparent: true, opacity });
}

function part(geometry, material) {
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = 20;
  mesh.frustumCulled = false;
  return mesh;
}

/** Points an object's y axis along a vector and hides it if the vector is zero. */
function align(object, vector, length) {
  object.visible = length > 0;
  if (object.visible) object.quaternion.copy(new Quaternion().setFromUnitVectors(axis, vector.clone().normalize()));
}

/** A straight arrow from a point along a force. Drawn above all bodies. */
export class ForceArrow extends Group {
  /** `longest`: length of the largest force [m]; `largest`: that force [N]. */
  constructor(colour, longest, largest) {
    super();
    this.longest = longest;
    this.largest = largest;
    const material = onTop(colour, 1);
    this.shaft = part(new CylinderGeometry(1, 1, 1, 16).translate(0, 0.5, 0), material);
    this.head = part(new ConeGeometry(1, 1, 24).translate(0, 0.5, 0), material);
    this.add(this.shaft, this.head);
  }

  show(point, force) {
    const size = force.length();
    const length = size > 1e-3 * this.largest ? Math.min(Math.max(size / this.largest, 0.12), most) * this.longest : 0;
    align(this, force, length);
    this.position.copy(point);
    const head = Math.min(0.2 * this.longest, 0.6 * length);
    this.shaft.scale.set(0.02 * this.longest, length - 0.9 * head, 0.02 * this.longest);
    this.head.scale.set(0.36 * head, head, 0.36 * head);
    this.head.position.y = length - head;
  }
}

/** An arc with a head that turns about a torque by the right-hand rule. Drawn above all bodies. */
export class TorqueArrow extends Group {
  constructor(colour, radius, largest) {
    super();
    this.radius = radius;
    this.largest = largest;
    const material = onTop(colour, 1);
    const turn = 1.5 * Math.PI;
    const arc = part(new TorusGeometry(1, 0.055, 10, 64, turn).rotateX(-Math.PI / 2), material);
    const head = part(new ConeGeometry(0.17, 0.46, 20).translate(0, 0.1, 0), material);
    head.position.set(Math.cos(turn), 0, -Math.sin(turn));
    head.quaternion.setFromUnitVectors(axis, new Vector3(-Math.sin(turn), 0, -Math.cos(turn)));
    this.add(arc, head);
  }

  show(point, torque) {
    const size = torque.length();
    const radius = size > 1e-3 * this.largest ? Math.min(Math.max(size / this.largest, 0.25), most) * this.radius : 0;
    align(this, torque, radius);
    this.position.copy(point);
    this.scale.setScalar(Math.max(radius, 1e-9));
  }
}
