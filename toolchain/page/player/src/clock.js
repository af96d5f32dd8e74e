/** The position in the replay, in samples. Listeners get the sample that is shown. */
export class Clock {
  constructor(times) {
    this.times = times;
    this.sample = 0;
    this.time = times[0];
    this.playing = false;
    this.loops = false;
    this.speed = 1;
    this.listeners = [];
  }

  get last() {
    return this.times.length - 1;
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  changed() {
    for (const listener of this.listeners) listener(this.sample);
  }

  seekSample(sample) {
    this.sample = Math.min(Math.max(Math.round(sample), 0), this.last);
    this.time = this.times[this.sample];
    this.changed();
  }

  seekTime(time) {
    this.seekSample(this.sampleAt(time));
  }

  /** Returns the last sample at or before a time. */
  sampleAt(time) {
    let low = 0;
    let high = this.last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  step(samples) {
    this.playing = false;
    this.seekSample(this.sample + samples);
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.sample === this.last) this.seekSample(0);
    else this.changed();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.changed();
  }

  /** Moves on by a time of the wall clock [s]. */
  advance(seconds) {
    if (!this.playing) return;
    this.time += seconds * this.speed;
    const end = this.times[this.last];
    if (this.time >= end) {
      if (this.loops) this.time = this.times[0];
      else {
        this.time = end;
        this.playing = false;
      }
    }
    this.sample = this.sampleAt(this.time);
    this.changed();
  }
}
