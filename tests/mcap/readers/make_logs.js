// usage: node make_logs.js FOLDER
// Writes replay.csv and telemetry.csv: 3000 cycles of a body that turns above another one and touches it now and then.
const fs = require('node:fs');
const path = require('node:path');

const replayColumns =
  't,dpx,dpy,dpz,dqw,dqx,dqy,dqz,gpx,gpy,gpz,gqw,gqx,gqy,gqz,fx,fy,fz,tx,ty,tz,point_depth,contacts,substeps,' +
  'step1_ns,solve_ns,status';
const telemetryColumns =
  't_s,late_us,compute_us,mode,fault,share,outcome,contacts,lost,q1_rad,q2_rad,qd1_rad_s,qd2_rad_s,torque1_Nm,' +
  'torque2_Nm,dpx_m,dpy_m,dpz_m,dqw,dqx,dqy,dqz,gpx_m,gpy_m,gpz_m,gqw,gqx,gqy,gqz,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,' +
  'depth_m,absorbed_J,injected_Ns_per_m';

/** The numbers of a cycle. */
function cycle(i) {
  const t = i * 1e-3;
  const turn = [Math.cos(t / 2), 0, 0, Math.sin(t / 2)];
  const touches = i % 100 < 40;
  return {
    t, touches,
    device: [0.01 * t, 0, touches ? 0.099 : 0.11, ...turn],
    god: [0.01 * t, 0, touches ? 0.1 : 0.11, ...turn],
    wrench: [0, 0, touches ? 2.5 : 0, 0, touches ? 0.125 : 0, 0],
    depth: touches ? -2e-5 : -0.01,
    outcome: touches ? 'contact' : 'free',
  };
}

function replayRow(i) {
  const c = cycle(i);
  return [c.t, ...c.device, ...c.god, ...c.wrench, c.depth, c.touches ? 3 : 0, 1, 4000, 2500, c.outcome];
}

function telemetryRow(i) {
  const c = cycle(i);
  const joints = [0.5, -0.25, c.t, 1, 5, -6];
  return [c.t, 2, 40, 'running', 0, 1, c.outcome, c.touches ? 3 : 0, 0, ...joints, ...c.device, ...c.god, ...c.wrench,
    c.depth, 0.125, 0];
}

function write(name, columns, row) {
  const rows = Array.from({ length: 3000 }, (_, i) => row(i).join(','));
  fs.writeFileSync(path.join(process.argv[2], name), [columns, ...rows, ''].join('\n'));
}

write('replay.csv', replayColumns, replayRow);
write('telemetry.csv', telemetryColumns, telemetryRow);
