import { speeds } from './transport.js';

/** Applies `#t=1.9&cut=y&both&distance&speed=0.25&paused` of the address, of which each part may be missing. */
export function applyAddress(clock, options, picture) {
  const wanted = new URLSearchParams(location.hash.slice(1));
  if (wanted.has('t')) clock.seekTime(Number(wanted.get('t')) || 0);
  const axis = ['x', 'y', 'z'].indexOf(wanted.get('cut'));
  if (picture && axis >= 0) options.cutAcross(axis, wanted.has('both'));
  if (picture && wanted.has('distance')) options.showDistance(true);
  const speed = Number(wanted.get('speed'));
  if (speeds.includes(speed)) clock.setSpeed(speed);
  clock.playing = !wanted.has('paused');
}
