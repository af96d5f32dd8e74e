import { BufferAttribute, BufferGeometry } from 'three';
import { positionsOf } from '../body_geometry.js';

const pieces = 48; // of a body's size: the longest edge
const most = 60_000; // triangles, unless the body has more

/**
 * Cuts triangles at the middles of their longest edges. Both triangles of an edge cut it at the same places, so that no
 * gaps open. A corner is a vertex with a normal.
 */
class Refinement {
  constructor(body, surface) {
    this.points = Array.from(positionsOf(body));
    this.vertices = Array.from(body.triangles);
    this.normals = Array.from(surface.getAttribute('normal').array);
    this.middles = new Map();
    this.index = [];
  }

  /** Returns the length of the edge between two corners. */
  length(i, j) {
    const { points } = this;
    const [a, b] = [3 * this.vertices[i], 3 * this.vertices[j]];
    const [x, y, z] = [points[a] - points[b], points[a + 1] - points[b + 1], points[a + 2] - points[b + 2]];
    return Math.sqrt(x * x + y * y + z * z);
  }

  /** Returns the vertex in the middle of two. */
  middleVertex(a, b) {
    const edge = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    const known = this.middles.get(edge);
    if (known !== undefined) return known;
    const made = this.points.length / 3;
    for (let k = 0; k < 3; ++k) this.points.push((this.points[3 * a + k] + this.points[3 * b + k]) / 2);
    this.middles.set(edge, made);
    return made;
  }

  /** Returns a new corner in the middle of two. */
  middleCorner(i, j) {
    const { normals, vertices } = this;
    const sum = [0, 1, 2].map((k) => normals[3 * i + k] + normals[3 * j + k]);
    const size = Math.hypot(...sum) || 1;
    normals.push(...sum.map((v) => v / size));
    return vertices.push(this.middleVertex(vertices[i], vertices[j])) - 1;
  }

  /** Adds a triangle in parts that have no edge above a length. */
  add(i, j, k, longest) {
    const sizes = [this.length(i, j), this.length(j, k), this.length(k, i)];
    const size = Math.max(...sizes);
    if (size <= longest) this.index.push(i, j, k);
    else if (size === sizes[0]) {
      const middle = this.middleCorner(i, j);
      this.add(i, middle, k, longest);
      this.add(middle, j, k, longest);
    } else this.add(j, k, i, longest);
  }

  /** Adds all triangles of the body. Returns false if their parts are more than `limit`. */
  addAll(longest, limit) {
    const count = this.vertices.length;
    for (let i = 0; i < count && this.index.length <= 3 * limit; i += 3) this.add(i, i + 1, i + 2, longest);
    return this.index.length <= 3 * limit;
  }

  /** Returns the geometry. Its attribute `vertex` is the number of the vertex of each corner. */
  geometry() {
    const { points, vertices } = this;
    const position = new Float32Array(3 * vertices.length);
    vertices.forEach((vertex, i) => {
      for (let k = 0; k < 3; ++k) position[3 * i + k] = points[3 * vertex + k];
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('normal', new BufferAttribute(Float32Array.from(this.normals), 3));
    geometry.setAttribute('vertex', new BufferAttribute(Float32Array.from(vertices), 1));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(this.index), 1));
    return geometry;
  }
}

/** Returns the `geometry` of a body with edges short enough for a colour at each vertex, and its vertices `points`. */
export function fineSurface(body, surface, size) {
  const limit = Math.max(most, body.triangles.length / 3);
  for (let longest = size / pieces; ; longest *= 1.5) {
    const refinement = new Refinement(body, surface);
    if (refinement.addAll(longest, limit)) {
      return { geometry: refinement.geometry(), points: Float32Array.from(refinement.points) };
    }
  }
}
