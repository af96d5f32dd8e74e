import { element } from '../elements.js';

const view = [
  ['Drag', 'turn the camera; right button: pan; wheel: zoom'],
  ['c  m', 'cut, colour by distance'],
  ['r  f  d', 'reset the view, full screen, dark or light'],
  ['a  h', 'arm, this help'],
];
const hand = [
  ['Drag the body', 'move it in the plane of the screen'],
  ['Wheel while dragging', 'push it away or pull it nearer'],
  ['Shift + drag', 'turn it about the axes of the screen'],
  ['Alt or Ctrl + drag', 'twist it about the line of sight'],
  ['Arrow keys', 'move it; with shift turn it'],
  ['Page up, page down', 'away and nearer; with shift twist'],
  ['Two fingers on the body', 'pinch: away and nearer; twist'],
  ['Gamepad', 'left stick and triggers move, right stick and shoulder buttons turn'],
];

/** A panel over the picture that explains mouse and keys. */
export class Help {
  constructor(steers) {
    const rows = [...(steers ? hand : []), ...view].flatMap(([what, does]) =>
      [element('dt', {}, what), element('dd', {}, does)]);
    this.root = element('div', { className: 'help', hidden: true }, element('dl', {}, ...rows));
  }

  toggle() {
    this.root.hidden = !this.root.hidden;
  }
}
