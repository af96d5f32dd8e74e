const vendors = [{ vendorId: 0x256f }, { vendorId: 0x046d, usagePage: 1, usage: 8 }]; // 3Dconnexion, and its older ones
const full = 350; // largest number of an axis
const deadZone = 0.05;
const stale = 200; // without a report the cap is taken for released [ms]

/** Reads a SpaceMouse by WebHID. Its cap moves and turns the hand in the axes of the picture. */
export class SpaceMouse {
  static isPossible() {
    return Boolean(navigator.hid);
  }

  constructor() {
    this.axes = [0, 0, 0, 0, 0, 0]; // right, towards the user, down; turns about them
  }

  /** Lets the user choose a device. Returns its name, or undefined. */
  async connect() {
    const [device] = await navigator.hid.requestDevice({ filters: vendors });
    if (!device) return undefined;
    if (!device.opened) await device.open();
    device.addEventListener('inputreport', ({ reportId, data }) => this.read(reportId, data));
    return device.productName;
  }

  /** Reads a report: 1 has the translation and, of newer devices, the rotation; 2 the rotation. */
  read(id, data) {
    if (id !== 1 && id !== 2) return;
    const first = id === 1 ? 0 : 3;
    for (let i = 0; i < Math.min(data.byteLength >> 1, 6 - first); ++i) {
      this.axes[first + i] = data.getInt16(2 * i, true) / full;
    }
    this.heard = performance.now();
  }

  rates() {
    if (performance.now() - (this.heard ?? -stale) >= stale) return [0, 0, 0, 0, 0, 0];
    const [x, y, z, rx, ry, rz] = this.axes.map((v) => (Math.abs(v) < deadZone ? 0 : v));
    return [x, -z, -y, rx, -rz, -ry];
  }
}
