// Checks the colours of distances on a page of the player. Needs a tab of tabs.js.
const assert = require('node:assert/strict');

/** Measures until all distances of a paused page are those of its pose. */
function finishDistances(tab) {
  return tab.evaluate(() => {
    const { colours } = window.godobjectPage.picture;
    do colours.advance(); // also at first, because the pose may be new
    while (colours.motions.some((motion) => !motion.settled));
  });
}

/**
 * Returns for some vertices of each god object, far and near ones, the distance that the page knows and the one to all
 * triangles of the still body, below zero inside a closed one by its winding number: [known, exact], [m].
 */
function someDistances(tab, count) {
  return tab.evaluate((wanted) => {
    const { picture } = window.godobjectPage;
    const corners = picture.still.surface.geometry.getAttribute('position').array;
    const { closed } = picture.data.still;
    const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const cross = (a, b) =>
      [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const toEdge = (p, a, b) => {
      const along = minus(b, a);
      const share = Math.min(Math.max(dot(minus(p, a), along) / (dot(along, along) || 1), 0), 1);
      return Math.hypot(...minus(p, a.map((v, k) => v + share * along[k])));
    };
    const toTriangle = (p, triangle) => {
      const [a, b, c] = triangle;
      const normal = cross(minus(b, a), minus(c, a));
      const over = [[a, b], [b, c], [c, a]].every(([from, to]) =>
        dot(cross(minus(to, from), minus(p, from)), normal) >= 0);
      const edges = Math.min(toEdge(p, a, b), toEdge(p, b, c), toEdge(p, c, a));
      return over && dot(normal, normal) > 0 ? Math.min(Math.abs(dot(minus(p, a), normal)) / Math.hypot(...normal), edges) :
        edges;
    };
    const solidAngle = (p, triangle) => {
      const [a, b, c] = triangle.map((corner) => minus(corner, p));
      const [la, lb, lc] = [a, b, c].map((v) => Math.hypot(...v));
      return 2 * Math.atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    };
    const exact = (p) => {
      let [nearest, angle] = [Infinity, 0];
      for (let f = 0; f < corners.length; f += 9) {
        const triangle = [0, 3, 6].map((k) => Array.from(corners.subarray(f + k, f + k + 3)));
        nearest = Math.min(nearest, toTriangle(p, triangle));
        angle += solidAngle(p, triangle);
      }
      return closed && angle > 2 * Math.PI ? -nearest : nearest;
    };
    const some = (all) => Array.from({ length: wanted }, (_, i) => all[Math.floor(((i + 0.5) * all.length) / wanted)]);
    return picture.colours.motions.flatMap(({ count: all, points, pose, known, scale }) => {
      const vertices = Array.from({ length: all }, (_, i) => i);
      const near = vertices.filter((i) => Math.abs(known[i]) < scale.far);
      return [...some(vertices), ...(near.length ? some(near) : [])].map((vertex) => {
        const place = picture.target.clone().fromArray(points, 3 * vertex).applyMatrix4(pose);
        return [known[vertex], exact(place.toArray())];
      });
    });
  }, count);
}

/** Fails if distances differ from exact ones by more than a share; those beyond the scale only need to be there, too. */
async function assertDistances(tab, count, tolerance) {
  const { near, far } = await tab.evaluate(() => window.godobjectPage.picture.colours.scale);
  for (const [known, exact] of await someDistances(tab, count)) {
    const isBeyond = Math.min(Math.abs(known), Math.abs(exact)) > 0.97 * far && known > 0 === exact > 0;
    const allowed = tolerance * (Math.abs(exact) + near) + 1e-7; // of single-precision numbers
    assert.ok(isBeyond || Math.abs(known - exact) <= allowed, `${known} ${exact}`);
  }
}

/**
 * Returns the colours about the outermost one of the nearest vertices, each once, seen from beside the body: red, green,
 * blue, in steps of 8. After the measurement the body may still move by some pixels: each is thousandths of a millimetre.
 */
function coloursOfNearest(tab) {
  return tab.evaluate(() => {
    const { picture, objects } = window.godobjectPage;
    if (objects) objects.points.visible = false; // discs of contact points are yellow, too
    const { camera, canvas, colours: { motions: [{ count, points, pose, known }] } } = picture;
    const least = known.subarray(0, count).reduce((a, b) => Math.min(a, b));
    const outwards = (place) => place.clone().sub(picture.motions[0].place()).projectOnPlane(camera.up);
    const [place] = Array.from({ length: count }, (_, i) => i).filter((i) => known[i] < least + 1e-6)
      .map((i) => picture.target.clone().fromArray(points, 3 * i).applyMatrix4(pose))
      .sort((a, b) => outwards(b).length() - outwards(a).length());
    const { position, quaternion } = camera.clone();
    const out = outwards(place).normalize();
    camera.position.copy(place).addScaledVector(out, 0.1 * picture.size).addScaledVector(camera.up, 0.02 * picture.size);
    camera.lookAt(place);
    camera.updateMatrixWorld();
    picture.setSharpness(1);
    picture.invalidate();
    picture.draw();
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    copy.drawImage(canvas, 0, 0);
    camera.position.copy(position);
    camera.quaternion.copy(quaternion);
    if (objects) objects.points.visible = true;
    picture.invalidate();
    const around = 24; // px
    const { data } = copy.getImageData(canvas.width / 2 - around, canvas.height / 2 - around, 2 * around, 2 * around);
    const colours = new Map();
    for (let at = 0; at < data.length; at += 4) {
      const colour = [...data.subarray(at, at + 3)].map((value) => value & ~7);
      colours.set(colour.join(), colour);
    }
    return [...colours.values()];
  });
}

/** Returns where picture and legend are: [top, bottom] [px]. The legend has no height while it is hidden. */
function placesOf(tab) {
  return tab.evaluate(() => Object.fromEntries(['picture', 'legend'].map((name) => {
    const { top, bottom } = document.querySelector(`.${name}`).getBoundingClientRect();
    return [name, [top, bottom]];
  })));
}

/** Fails if the legend is hidden or over the picture. */
async function assertLegend(tab) {
  const { picture, legend } = await placesOf(tab);
  assert.ok(legend[1] > legend[0] + 10 && legend[0] >= picture[1], JSON.stringify({ picture, legend }));
}

module.exports = { assertDistances, assertLegend, coloursOfNearest, finishDistances, placesOf };
