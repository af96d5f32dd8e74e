import { Triangle, Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { faceVectors, positionsOf, trianglesOfVertices } from '../body_geometry.js';

const onBorder = 1e-6; // a share of a corner below it: the point lies on the opposite edge

/** Distances of points to the surface of a body, below zero inside a closed one. */
export class SignedDistance {
  /** `surface`: the geometry of the body, with its triangles in order. */
  constructor(body, surface) {
    this.body = body;
    this.tree = new MeshBVH(surface, { indirect: true });
    this.found = {};
    if (!body.closed) return;
    this.positions = positionsOf(body);
    this.vectors = faceVectors(this.positions, body.triangles);
    this.triangles = trianglesOfVertices(this.positions.length / 3, body.triangles);
  }

  /** Returns the distance of a point in the body's frame that is at most `bound` away [m]. */
  measure(point, bound) {
    const { tree, found, body } = this;
    tree.closestPointToPoint(point, found, 0, bound * (1 + 1e-5) + 1e-9);
    return body.closed && this.isBehind(point) ? -found.distance : found.distance;
  }

  corner(vertex, to) {
    return to.fromArray(this.positions, 3 * vertex);
  }

  /** Tells if a point lies behind the surface at the nearest place `found`. */
  isBehind(point) {
    const part = this.partOf(this.found);
    const normal = new Vector3();
    for (const face of this.facesOf(part)) {
      const weight = part.length === 1 ? this.angleAt(part[0], face) : 1; // by which the sum tells the sides apart
      normal.addScaledVector(new Vector3().fromArray(this.vectors, face).normalize(), weight);
    }
    return point.clone().sub(this.found.point).dot(normal) < 0;
  }

  /** Returns the triangles that have a part of the nearest one, by the first index. */
  facesOf(part) {
    if (part.length === 3) return [3 * this.found.faceIndex];
    return this.triangles[part[0]].filter((face) => part.every((vertex) => this.cornersOf(face).includes(vertex)));
  }

  cornersOf(face) {
    return this.body.triangles.subarray(face, face + 3);
  }

  /** Returns the vertices of the part of a triangle that has a point: a vertex, an edge (two) or the inside (three). */
  partOf({ point, faceIndex }) {
    const corners = this.cornersOf(3 * faceIndex);
    const [a, b, c] = Array.from(corners, (vertex) => this.corner(vertex, new Vector3()));
    const shares = Triangle.getBarycoord(point, a, b, c, new Vector3());
    return shares ? corners.filter((_, i) => shares.getComponent(i) > onBorder) : corners;
  }

  /** Returns the angle of a triangle at a vertex. */
  angleAt(vertex, face) {
    const [a, b] = Array.from(this.cornersOf(face)).filter((other) => other !== vertex).map((other) =>
      this.corner(other, new Vector3()).sub(this.corner(vertex, new Vector3())));
    return a.angleTo(b);
  }
}
