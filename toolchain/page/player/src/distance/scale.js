import { Color } from 'three';

// Viridis without its dark end, from touching to far: the lightness falls evenly, also for the colour-blind.
const stops = ['#fde725', '#addc30', '#5ec962', '#28ae80', '#21918c', '#2c728e', '#3b528b'];
export const insideColour = '#e5173f';
const decades = 2; // of distances that the scale tells apart

/** Colours for distances from zero to `far` [m]. Up to `near` they change evenly, above it for each power of ten. */
export class DistanceScale {
  constructor(far) {
    this.far = far;
    this.near = far / 10 ** decades;
    this.colours = stops.map((stop) => new Color(stop));
  }

  /** Returns the place of a distance in the scale: 0 to 1. */
  share(distance) {
    return Math.min(Math.log1p(distance / this.near) / Math.log1p(this.far / this.near), 1);
  }

  /** Returns distances that divide the scale [m]. */
  ticks() {
    return [0, ...Array.from({ length: decades + 1 }, (_, i) => this.near * 10 ** i)];
  }

  /** Returns the scale as a CSS image, near on the left. */
  gradient() {
    return `linear-gradient(to right, ${stops.join(', ')})`;
  }
}
