// usage: node foxglove_test.js GODOBJECT_LIVE
// Starts GODOBJECT_LIVE on the scene of two cubes in the present folder, watches it with the client of
// @foxglove/ws-protocol, and decodes all messages with @foxglove/rosmsg2-serialization.
const assert = require('node:assert/strict');
const { spawn } = require('node:child_process');
const { once } = require('node:events');
const { createInterface } = require('node:readline');
const { FoxgloveClient } = require('@foxglove/ws-protocol');
const { parse } = require('@foxglove/rosmsg');
const { MessageReader } = require('@foxglove/rosmsg2-serialization');
const WebSocket = require('ws');

const kTopics = ['/tf_static', '/tf', '/bodies', '/force_arrow', '/wrench', '/cycle', '/joint_states', '/controller'];
const kProtocol = FoxgloveClient.SUPPORTED_SUBPROTOCOL;

/** Starts the program. Returns it and the address that it prints for Foxglove. */
async function start(program) {
  const live = spawn(program, ['cubes.toml', 'cubes-arm.toml', '--player', 'player.js', '--port', '0'],
    { stdio: ['ignore', 'pipe', 'inherit'] });
  for await (const line of createInterface({ input: live.stdout })) {
    const address = /ws:\S+/.exec(line);
    if (address) return { live, address: address[0] };
  }
  throw new Error('godobject-live prints no address');
}

/** A viewer that keeps and decodes what it gets. */
class Viewer {
  constructor(address, protocols = [kProtocol], options = {}) {
    this.socket = new WebSocket(address, protocols, options);
    this.client = new FoxgloveClient({ ws: this.socket });
    this.messages = Object.fromEntries(kTopics.map((topic) => [topic, []]));
    this.times = [];
    this.subscriptions = new Map();
    this.errors = [];
    this.client.on('error', (error) => this.errors.push(error));
    this.client.on('time', ({ timestamp }) => this.times.push(timestamp));
    this.client.on('message', (message) => this.take(message));
    this.info = new Promise((resolve) => this.client.on('serverInfo', resolve));
    this.channels = new Promise((resolve) => this.client.on('advertise', resolve));
    this.status = new Promise((resolve) => this.client.on('status', resolve));
  }

  take({ subscriptionId, timestamp, data }) {
    const { topic, reader } = this.subscriptions.get(subscriptionId);
    this.messages[topic].push({ timestamp, ...reader.readMessage(data) });
  }

  async subscribe(topics) {
    for (const channel of await this.channels) {
      if (!topics.includes(channel.topic)) continue;
      const reader = new MessageReader(parse(channel.schema, { ros2: true }));
      this.subscriptions.set(this.client.subscribe(channel.id), { topic: channel.topic, reader });
    }
  }

  unsubscribe() {
    for (const id of this.subscriptions.keys()) this.client.unsubscribe(id);
  }

  /** Waits until the messages fit; the limit is only for a program that never comes there. */
  async wait(fits) {
    for (const end = Date.now() + 60_000; !fits(this.messages); ) {
      assert.ok(Date.now() < end, 'the messages do not come');
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  }

  close() {
    assert.deepEqual(this.errors, []);
    this.client.close();
  }
}

const nanoseconds = ({ sec, nanosec }) => BigInt(sec) * 1_000_000_000n + BigInt(nanosec);
const range = (values) => Math.max(...values) - Math.min(...values);

function checkFixed(messages) {
  assert.equal(messages['/tf_static'].length, 1);
  assert.deepEqual(messages['/tf_static'][0].transforms.map((t) => [t.header.frame_id, t.child_frame_id]),
    [['upright', 'W']]);
  assert.equal(messages['/bodies'].length, 1);
  const { markers } = messages['/bodies'][0];
  assert.deepEqual(markers.map(({ type, ns, header, points }) => [type, ns, header.frame_id, points.length]),
    [[11, 'still body', 'W', 36], [11, 'god object', 'god_object', 36], [11, 'device pose', 'device', 36]]);
}

/** The hand presses the cube 10 mm into the plate: the device pose goes there, the god object stays at 30 mm. */
function checkMotion(messages) {
  const heights = (frame) => messages['/tf'].map(({ transforms }) =>
    transforms.find((t) => t.child_frame_id === frame).transform.translation.z);
  assert.ok(range(heights('device')) > 0.015, `the device moves by ${range(heights('device'))} m`);
  assert.ok(Math.min(...heights('device')) < 0.0299, `the device comes to ${Math.min(...heights('device'))} m`);
  const lowest = Math.min(...heights('god_object'));
  assert.ok(lowest > 0.0299, `the god object comes to ${lowest} m`);
  const forces = messages['/wrench'].map(({ wrench }) => wrench.force);
  assert.ok(Math.max(...forces.map(({ z }) => z)) > 1, 'the plate pushes upwards');
  assert.equal(forces[0].z, 0);
  assert.ok(messages['/force_arrow'].some(({ markers: [arrow] }) => arrow.action === 0 && arrow.points.length === 2));
  const outcomes = new Set(messages['/cycle'].map(({ outcome }) => outcome));
  assert.ok(outcomes.has('free') && outcomes.has('contact'), [...outcomes].join());
}

function checkArm(messages) {
  const joints = messages['/joint_states'];
  const { name, position, velocity, effort } = joints.at(-1);
  assert.deepEqual(name, [1, 2, 3, 4, 5, 6, 7].map((i) => `joint${i}`));
  assert.deepEqual([position.length, velocity.length, effort.length], [7, 7, 7]);
  assert.ok(range(joints.map((joint) => joint.position[1])) > 0.005, 'a joint moves');
  assert.ok(joints.some((joint) => Math.abs(joint.velocity[1]) > 0.001), 'a joint has a velocity');
  assert.ok(joints.some((joint) => Math.abs(joint.effort[1]) > 0.1), 'a joint has a torque');
  assert.ok(messages['/controller'].some(({ mode, fault, share }) => mode === 'running' && fault === 0 && share === 1));
}

function checkTimes(viewer) {
  viewer.times.forEach((time, i) => assert.ok(i === 0 || time >= viewer.times[i - 1], 'the time goes back'));
  const known = new Set(viewer.times);
  for (const [topic, messages] of Object.entries(viewer.messages)) {
    for (const { timestamp, header, transforms } of messages) {
      assert.ok(known.has(timestamp), `${topic}: a time that is not the server's`);
      const stamp = header?.stamp ?? (topic === '/tf' ? transforms[0].header.stamp : undefined);
      if (stamp) assert.equal(nanoseconds(stamp), timestamp, topic);
    }
  }
}

const tests = {
  async 'all channels are decoded, and show a contact'(address) {
    const viewer = new Viewer(address);
    const { name, capabilities } = await viewer.info;
    assert.deepEqual([name, capabilities], ['godobject-live', ['time']]);
    assert.deepEqual((await viewer.channels).map(({ topic }) => topic), kTopics);
    await viewer.subscribe(kTopics);
    const pressed = (messages) => messages['/wrench'].some(({ wrench }) => wrench.force.z > 2);
    await viewer.wait((messages) => pressed(messages) && messages['/cycle'].at(-1).outcome === 'free');
    checkFixed(viewer.messages);
    checkMotion(viewer.messages);
    checkArm(viewer.messages);
    checkTimes(viewer);
    viewer.close();
  },

  async 'a viewer gets what it subscribes to, and the bodies once for each subscription'(address) {
    const viewer = new Viewer(address, [kProtocol, 'foxglove.sdk.v1']);
    await viewer.subscribe(['/bodies', '/cycle']);
    await viewer.wait((messages) => messages['/cycle'].length > 5);
    viewer.unsubscribe();
    await viewer.subscribe(['/bodies']);
    await viewer.wait((messages) => messages['/bodies'].length > 1);
    const cycles = viewer.messages['/cycle'].length;
    const ticks = viewer.times.length;
    await viewer.wait(() => viewer.times.length > ticks + 5);
    assert.equal(viewer.messages['/cycle'].length, cycles);
    assert.equal(viewer.messages['/bodies'].length, 2);
    assert.deepEqual(kTopics.filter((topic) => viewer.messages[topic].length > 0), ['/bodies', '/cycle']);
    viewer.close();
  },

  async 'a wrong message gets a warning, and the connection stays'(address) {
    const viewer = new Viewer(address, ['foxglove.sdk.v1']);
    await viewer.info;
    assert.equal(viewer.socket.protocol, 'foxglove.sdk.v1');
    viewer.client.setParameters([{ name: 'stiffness', value: 1 }]);
    assert.equal((await viewer.status).level, 1);
    viewer.client.sendMessage(1, new Uint8Array(100));
    await viewer.subscribe(['/tf']);
    await viewer.wait((messages) => messages['/tf'].length > 0);
    viewer.close();
  },

  async 'nobody comes in without the token, or from another page'(address) {
    const refused = async (url, origin) => {
      const socket = new WebSocket(url, [kProtocol], { origin });
      const opens = await new Promise((resolve) => {
        socket.on('open', () => resolve(true));
        socket.on('error', () => resolve(false));
      });
      assert.ok(!opens, `${url} ${origin}`);
    };
    await refused(address.replace(/token=.*/, 'token=guess'));
    await refused(address.replace(/\?.*/, ''));
    await refused(address, 'https://evil.example');
    const viewer = new Viewer(address.replace('/?', '/foxglove?'), [kProtocol], { origin: 'https://app.foxglove.dev' });
    await viewer.info;
    viewer.close();
  },
};

(async () => {
  const { live, address } = await start(process.argv[2]);
  try {
    for (const [name, test] of Object.entries(tests)) {
      await test(address);
      console.log(`passed: ${name}`);
    }
  } finally {
    live.kill();
  }
  const [code] = live.exitCode === null ? await once(live, 'exit') : [live.exitCode];
  assert.equal(code, 0);
})().catch((error) => {
  console.error(error);
  process.exit(1);
});
