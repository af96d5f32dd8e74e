// usage: node readers_test.js FOLDER
// Reads FOLDER/{replay,telemetry}.mcap with the readers of @mcap/core, once by the index and once from begin to end with
// all checksums, and the messages with @foxglove/rosmsg2-serialization. The numbers must be those of FOLDER/*.csv.
const assert = require('node:assert/strict');
const fs = require('node:fs');
const path = require('node:path');
const { McapIndexedReader, McapStreamReader } = require('@mcap/core');
const { parse } = require('@foxglove/rosmsg');
const { ros2jazzy } = require('@foxglove/rosmsg-msgs-common');
const { MessageReader } = require('@foxglove/rosmsg2-serialization');

const folder = process.argv[2];
const text = (bytes) => new TextDecoder().decode(bytes);

/** A file in memory, as McapIndexedReader wants it. */
class Bytes {
  constructor(bytes) { this.bytes = bytes; }
  async size() { return BigInt(this.bytes.length); }
  async read(offset, size) { return this.bytes.subarray(Number(offset), Number(offset + size)); }
}

/** Reads a record by its index. Returns its reader and the decoded messages of each topic. */
async function readByIndex(bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: new Bytes(bytes) });
  const decoders = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    decoders.set(channel.id, new MessageReader(parse(text(schema.data), { ros2: true })));
  }
  const topics = {};
  const raw = [];
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const { topic } = reader.channelsById.get(message.channelId);
    (topics[topic] ??= []).push({ time: message.logTime, ...decoders.get(message.channelId).readMessage(message.data) });
    raw.push(message);
  }
  return { reader, topics, raw };
}

/** Reads a record from begin to end. Returns its messages. */
function readAsStream(bytes) {
  const reader = new McapStreamReader({ validateCrcs: true });
  const messages = [];
  let begin = 0;
  const takeRecords = () => {
    for (let record = reader.nextRecord(); record; record = reader.nextRecord())
      if (record.type === 'Message') messages.push(record);
  };
  for (; begin < bytes.length; begin += 100_000) {
    reader.append(bytes.subarray(begin, begin + 100_000));
    takeRecords();
  }
  assert.ok(reader.done());
  return messages;
}

/** Returns the columns of a CSV file: numbers where they are. */
function rowsOf(name) {
  const [header, ...lines] = fs.readFileSync(path.join(folder, name), 'utf8').trim().split('\n');
  const names = header.split(',');
  const number = (word) => (Number.isNaN(Number(word)) ? word : Number(word));
  return lines.map((line) => Object.fromEntries(line.split(',').map((word, i) => [names[i], number(word)])));
}

/** Fields of a message definition that are no constants, as `type[] name`. */
const fields = ({ definitions }) => definitions.filter((field) => !field.isConstant)
  .map((field) => `${field.type}${field.isArray ? '[]' : ''} ${field.name}`);

/** Compares the definitions of a record with those of ROS 2. */
function checkDefinitions(reader) {
  let compared = 0;
  for (const schema of reader.schemasById.values()) {
    assert.equal(schema.encoding, 'ros2msg');
    for (const definition of parse(text(schema.data), { ros2: true })) {
      const name = (definition.name ?? schema.name).replace('/msg/', '/');
      if (name.startsWith('godobject_msgs/')) continue;
      // in ROS 2 time and duration are messages of their own
      const plain = (list) => list.map((field) => field.replace(/builtin_interfaces\/(msg\/)?(Time|Duration)/,
        (_, __, kind) => kind.toLowerCase()).replace('/msg/', '/'));
      if (name.startsWith('builtin_interfaces/')) continue;
      assert.ok(ros2jazzy[name], name);
      assert.deepEqual(plain(fields(definition)), plain(fields(ros2jazzy[name])), name);
      compared += 1;
    }
  }
  assert.ok(compared > 10, `${compared} definitions were compared`);
}

/** Checks poses and wrench of one cycle. `column`: returns the number of a column without its unit. */
function checkMotion(topics, i, column) {
  const [device, god, centre] = topics['/tf'][i].transforms;
  for (const [frame, begin] of [[device, 'd'], [god, 'g']]) {
    const { translation, rotation } = frame.transform;
    for (const axis of 'xyz') {
      assert.equal(translation[axis], column(`${begin}p${axis}`));
      assert.equal(rotation[axis], column(`${begin}q${axis}`));
    }
    assert.equal(rotation.w, column(`${begin}qw`));
  }
  assert.deepEqual([device, god, centre].map((frame) => [frame.header.frame_id, frame.child_frame_id]),
    [['W', 'device'], ['W', 'god_object'], ['W', 'device_centre']]);
  const { force, torque } = topics['/wrench'][i].wrench;
  for (const axis of 'xyz') {
    assert.equal(force[axis], column(`f${axis}`));
    assert.equal(torque[axis], column(`t${axis}`));
  }
}

/** What both kinds of records have. */
async function checkRecord(name) {
  const bytes = new Uint8Array(fs.readFileSync(path.join(folder, `${name}.mcap`)));
  const { reader, topics, raw } = await readByIndex(bytes);
  assert.equal(reader.header.profile, 'ros2');
  assert.equal(Number(reader.statistics.messageCount), raw.length);
  assert.ok(reader.chunkIndexes.length > 1);
  const all = readAsStream(bytes);
  assert.equal(all.length, raw.length);
  const key = (m) => `${m.logTime} ${m.channelId} ${m.sequence} ${Buffer.from(m.data).toString('base64')}`;
  assert.deepEqual(raw.map(key).sort(), all.map(key).sort());
  checkDefinitions(reader);
  assert.deepEqual(topics['/bodies'][0].markers.map(({ type, ns, header }) => [type, ns, header.frame_id]),
    [[11, 'still body', 'W'], [11, 'god object', 'god_object'], [11, 'device pose', 'device']]);
  assert.equal(topics['/bodies'][0].markers[0].points.length % 3, 0);
  const rows = rowsOf(`${name}.csv`);
  assert.equal(topics['/tf'].length, rows.length);
  return { reader, topics, rows };
}

const tests = {
  async 'a replay is read with its numbers'() {
    const { topics, rows } = await checkRecord('replay');
    rows.forEach((row, i) => {
      checkMotion(topics, i, (name) => row[name]);
      const { header, outcome, depth, contacts } = topics['/cycle'][i];
      assert.deepEqual([outcome, depth, contacts], [row.status, row.point_depth, row.contacts]);
      assert.equal(header.stamp.sec * 1000 + header.stamp.nanosec / 1e6, Math.round(1e3 * row.t));
      assert.equal(topics['/cycle'][i].time, BigInt(Math.round(1e9 * row.t)));
      assert.ok(Math.abs(topics['/solver_times'][i].look_ups - 4e-6) < 1e-15);
    });
  },

  async 'a telemetry is read with its joints'() {
    const { topics, rows } = await checkRecord('telemetry');
    const unit = { p: '_m', f: '_N', t: '_Nm' };
    rows.forEach((row, i) => {
      checkMotion(topics, i, (name) => row[name] ?? row[name + (unit[name[1] === 'p' ? 'p' : name[0]])]);
      const { name, position, velocity, effort } = topics['/joint_states'][i];
      assert.deepEqual(name, ['joint1', 'joint2']);
      assert.deepEqual([...position, ...velocity, ...effort],
        [row.q1_rad, row.q2_rad, row.qd1_rad_s, row.qd2_rad_s, row.torque1_Nm, row.torque2_Nm]);
      const { mode, share, absorbed } = topics['/controller'][i];
      assert.deepEqual([mode, share, absorbed], [row.mode, row.share, row.absorbed_J]);
    });
  },

  async 'the index finds the messages of a topic after a time'() {
    const bytes = new Uint8Array(fs.readFileSync(path.join(folder, 'replay.mcap')));
    const reader = await McapIndexedReader.Initialize({ readable: new Bytes(bytes) });
    const times = [];
    for await (const { logTime } of reader.readMessages({ topics: ['/wrench'], startTime: 2_990_000_000n }))
      times.push(Number(logTime) / 1e6);
    assert.deepEqual(times, [2990, 2991, 2992, 2993, 2994, 2995, 2996, 2997, 2998, 2999]);
  },
};

(async () => {
  for (const [name, test] of Object.entries(tests)) {
    await test();
    console.log(`passed: ${name}`);
  }
})().catch((error) => {
  console.error(error);
  process.exit(1);
});
