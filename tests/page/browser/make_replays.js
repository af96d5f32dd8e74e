// usage: node make_replays.js FOLDER
// Writes replays of a peg that is pressed onto a block: contact.csv, paper.csv (goes in) and long.csv (50000 cycles).
const fs = require('node:fs');
const path = require('node:path');

const header =
  't,dpx,dpy,dpz,dqw,dqx,dqy,dqz,gpx,gpy,gpz,gqw,gqx,gqy,gqz,fx,fy,fz,tx,ty,tz,point_depth,contacts,substeps,' +
  'step1_ns,solve_ns,status';
const surface = 0; // [m]: height of the block's upper face, and of the peg's frame when it stands on it

/** Returns a row of a motion of `count` cycles. `stiff`: the share of the way in that the god object stays back. */
function row(i, count, stiff) {
  const share = i / (count - 1);
  const device = [0.06 * share - 0.03, 0, surface + 0.03 - 0.06 * share];
  const inside = Math.max(surface - device[2], 0);
  const god = [device[0], 0, device[2] + stiff * inside];
  const depth = inside > 0 ? (1 - stiff) * inside - 1e-5 : -1e-3;
  const spike = count > 20000 && i === 30001 ? 50 : 0; // between two samples
  const force = [0, 0, 1000 * stiff * inside + spike];
  const numbers = [
    i * 1e-3, ...device, 1, 0, 0, 0, ...god, 1, 0, 0, 0, ...force, 0.5 * force[2] * 0.1, 0, 0, depth,
    inside > 0 ? 3 : 0, 1, 4000, 2500,
  ];
  return `${numbers.join(',')},${inside > 0 ? 'contact' : 'free'}`;
}

function write(name, count, stiff) {
  const rows = Array.from({ length: count }, (_, i) => row(i, count, stiff));
  fs.writeFileSync(path.join(process.argv[2], name), [header, ...rows, ''].join('\n'));
}

write('contact.csv', 1001, 1);
write('paper.csv', 1001, 0.5);
write('long.csv', 50000, 1);
