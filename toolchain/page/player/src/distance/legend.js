import { element } from '../elements.js';
import { insideColour } from './scale.js';

function millimetres(distance) {
  return `${+(1e3 * distance).toPrecision(3)}`;
}

/** Returns the legend to the colours of distances. `isSigned`: places inside the still body have their own colour. */
export function distanceLegend({ scale, isSigned }, name) {
  const ticks = scale.ticks();
  const bar = element('div', { className: 'scale' }, ...ticks.map((tick, i) => {
    const last = i === ticks.length - 1;
    const mark = element('span', {}, `${last ? '≥ ' : ''}${millimetres(tick)}${last ? ' mm' : ''}`);
    mark.style.left = `${100 * scale.share(tick)}%`;
    return mark;
  }));
  const inside = element('span', { className: 'inside-mark' }, 'inside');
  inside.style.setProperty('--inside', insideColour);
  return element('div', { className: 'legend', title: `Distance of the god object to the surface of ${name}` },
    isSigned ? inside : element('span', { className: 'sides' }, 'either side'), bar);
}
