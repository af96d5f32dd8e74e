// Reads states of the moving body from the columns of a page of replays.

/** Returns the length of the longest vector in columns of all replays, 1 if all are zero. */
function largestLength(replays, key) {
  let largest = 0;
  for (const { [key]: [x, y, z] } of replays) {
    for (let i = 0; i < x.length; ++i) largest = Math.max(largest, Math.hypot(x[i], y[i], z[i]));
  }
  return largest || 1;
}

/** Returns the largest force [N] and torque [Nm] of all replays. */
export function largestLoads({ replays }) {
  return { force: largestLength(replays, 'force'), torque: largestLength(replays, 'torque') };
}

/** Returns the lowest place of all bodies in touch along an axis of W [m]. */
export function lowestPlace(data, up) {
  const { low, high, centre } = data.moving;
  const reach = Math.hypot(...low.map((_, k) => Math.max(high[k] - centre[k], centre[k] - low[k])));
  let place = data.still.low[up];
  for (const { pose, status } of data.replays) {
    for (let i = 0; i < data.t.length; ++i) {
      if (data.statuses[status[i]] !== 'free') place = Math.min(place, pose[up][i] + centre[up] - reach);
    }
  }
  return place;
}

/** Returns the state of each replay in a sample, as `MovingBodies` shows it. */
export function statesAt(data, sample) {
  const at = (columns) => columns.map((column) => column[sample]);
  const device = at(data.device);
  return data.replays.map(({ pose, force, torque }) =>
    ({ device, god: at(pose), force: at(force), torque: at(torque) }));
}
