import { BufferAttribute, BufferGeometry } from 'three';

const crease = Math.cos(0.6); // of the angle between triangles: below it a surface is drawn round

/** Returns the vertices of a body as x, y, z, x, ... in its own frame [m]. */
export function positionsOf(body) {
  const count = body.vertices[0].length;
  const positions = new Float32Array(3 * count);
  for (let axis = 0; axis < 3; ++axis) {
    for (let i = 0; i < count; ++i) positions[3 * i + axis] = body.low[axis] + body.vertices[axis][i];
  }
  return positions;
}

/** Returns the normals of the triangles, times twice their area. */
export function faceVectors(positions, corners) {
  const vectors = new Float64Array(corners.length);
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = [3 * corners[f], 3 * corners[f + 1], 3 * corners[f + 2]];
    const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]);
    const v = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    vectors[f] = u[1] * v[2] - u[2] * v[1];
    vectors[f + 1] = u[2] * v[0] - u[0] * v[2];
    vectors[f + 2] = u[0] * v[1] - u[1] * v[0];
  }
  return vectors;
}

/** Tells if two triangles (their first index in `vectors`) meet at an angle that is drawn round. */
function isRound(vectors, f, g) {
  const dot = vectors[f] * vectors[g] + vectors[f + 1] * vectors[g + 1] + vectors[f + 2] * vectors[g + 2];
  const sizes =
    Math.hypot(vectors[f], vectors[f + 1], vectors[f + 2]) * Math.hypot(vectors[g], vectors[g + 1], vectors[g + 2]);
  return dot >= crease * sizes;
}

/** Returns, for each vertex, the first index of each of its triangles. */
export function trianglesOfVertices(count, corners) {
  const triangles = Array.from({ length: count }, () => []);
  corners.forEach((vertex, i) => triangles[vertex].push(i - (i % 3)));
  return triangles;
}

/** Returns the triangles of a body with three vertices each, with normals that keep sharp edges sharp. */
function surface(positions, corners, vectors) {
  const triangles = trianglesOfVertices(positions.length / 3, corners);
  const points = new Float32Array(3 * corners.length);
  const normals = new Float32Array(3 * corners.length);
  corners.forEach((vertex, i) => {
    const own = i - (i % 3);
    const sum = [0, 0, 0];
    for (const f of triangles[vertex]) {
      if (f === own || isRound(vectors, own, f)) for (let k = 0; k < 3; ++k) sum[k] += vectors[f + k];
    }
    const size = Math.hypot(...sum) || 1;
    for (let k = 0; k < 3; ++k) {
      points[3 * i + k] = positions[3 * vertex + k];
      normals[3 * i + k] = sum[k] / size;
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  return geometry;
}

/** Tells which triangles are so thin that rounded vertices leave their normals open. By the first index. */
function thinTriangles(positions, corners, vectors, step) {
  const length = (a, b) => Math.hypot(...[0, 1, 2].map((k) => positions[3 * a + k] - positions[3 * b + k]));
  const thin = new Set();
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = corners.subarray(f, f + 3);
    const longest = Math.max(length(a, b), length(b, c), length(c, a));
    if (Math.hypot(vectors[f], vectors[f + 1], vectors[f + 2]) < 4 * step * longest) thin.add(f);
  }
  return thin;
}

/** Returns the sharp edges and the borders of a body as lines. `step`: to which vertices are rounded [m] */
function sharpEdges(positions, corners, vectors, step) {
  const count = positions.length / 3;
  const thin = thinTriangles(positions, corners, vectors, step);
  const first = new Map(); // of each edge: its first triangle, until the second one is found round
  for (let i = 0; i < corners.length; ++i) {
    const own = i - (i % 3);
    const a = corners[i];
    const b = corners[i % 3 === 2 ? i - 2 : i + 1];
    const edge = a < b ? a * count + b : b * count + a;
    const other = first.get(edge);
    const round = other !== undefined && (thin.has(own) || thin.has(other) || isRound(vectors, other, own));
    if (round) first.delete(edge);
    else first.set(edge, own);
  }
  const points = [];
  for (const edge of first.keys()) {
    for (const vertex of [Math.floor(edge / count), edge % count]) {
      points.push(positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  return geometry;
}

/** Returns the geometries of a body of the page in its own frame [m]. */
export function bodyGeometries(body) {
  const positions = positionsOf(body);
  const vectors = faceVectors(positions, body.triangles);
  const step = Math.max(...body.high.map((high, axis) => high - body.low[axis])) / 65535;
  return {
    surface: surface(positions, body.triangles, vectors),
    edges: sharpEdges(positions, body.triangles, vectors, step),
  };
}
