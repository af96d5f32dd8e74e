const fewest = 0.01; // time of a bucket [s]

/** Returns the lowest or the highest of two numbers, of which each may be null: not known. */
function extreme(choose, a, b) {
  const known = [a, b].filter((v) => v !== null);
  return known.length > 0 ? choose(...known) : null;
}

/** The last seconds of several quantities in buckets of time, each with the smallest and the largest number. */
export class History {
  constructor(keys, seconds) {
    this.keys = keys;
    this.seconds = seconds;
    this.clear();
  }

  clear() {
    this.t = [];
    this.low = Object.fromEntries(this.keys.map((key) => [key, []]));
    this.high = Object.fromEntries(this.keys.map((key) => [key, []]));
  }

  /** Takes [last, lowest, highest] of each quantity until a time [s]. */
  take(time, plots) {
    if (time < this.t.at(-1)) this.clear(); // the controller or the record began again
    const { t } = this;
    if (t.length > 1 && time - t.at(-2) < fewest) {
      t[t.length - 1] = time;
      for (const key of this.keys) {
        this.low[key].push(extreme(Math.min, this.low[key].pop(), plots[key][1]));
        this.high[key].push(extreme(Math.max, this.high[key].pop(), plots[key][2]));
      }
      return;
    }
    this.t.push(time);
    for (const key of this.keys) {
      this.low[key].push(plots[key][1]);
      this.high[key].push(plots[key][2]);
    }
    this.forget(time - this.seconds);
  }

  forget(before) {
    const old = this.t.findIndex((t) => t >= before);
    if (old < 60) return; // seldom, because it moves all that remains
    const columns = this.keys.flatMap((key) => [this.low[key], this.high[key]]);
    for (const column of [this.t, ...columns]) column.splice(0, old);
  }
}
