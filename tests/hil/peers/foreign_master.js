'use strict';
// foreign_master.js PROGRAM LOG: the library `canopen` as master of our simulated drive, node 1.

const assert = require('assert');
const { Device, DataType } = require('canopen');
const { Pipe } = require('./pipe.js');

const node = 1;
const U8 = DataType.UNSIGNED8, U16 = DataType.UNSIGNED16, U32 = DataType.UNSIGNED32;
const I8 = DataType.INTEGER8, I16 = DataType.INTEGER16, I32 = DataType.INTEGER32;

async function main() {
  const pipe = new Pipe(process.argv[2], process.argv[3]);
  const master = new Device({ id: 127 });
  const { eds } = master;
  eds.addSdoClientParameter(node, 0x600 + node, 0x580 + node);
  eds.addEmcyConsumer(0x80 + node);
  eds.setSyncCobId(0x80);
  eds.setSyncGenerationEnable(true);
  const object = (index, dataType) => eds.addEntry(index, { parameterName: index.toString(16), dataType });
  const statusword = object(0x6041, U16), position = object(0x6064, I32), torque = object(0x6077, I16);
  const controlword = object(0x6040, U16), target = object(0x6071, I16);
  eds.addReceivePdo({ cobId: 0x180 + node, transmissionType: 1, dataObjects: [statusword, position, torque] });
  // transmission type 255: sent on request of this program
  eds.addTransmitPdo({ cobId: 0x200 + node, transmissionType: 255, dataObjects: [controlword, target] });
  pipe.add(master);
  master.start();
  master.nmt.startNode();  // itself

  const read = (index, subIndex, dataType) =>
      master.sdo.upload({ serverId: node, index, subIndex, dataType, timeout: 5000 });
  const write = (index, subIndex, dataType, data) =>
      master.sdo.download({ serverId: node, index, subIndex, dataType, data, timeout: 5000 });
  const refused = async (code, transfer) => {
    const abort = pipe.frame('abort', ({ id, data }) => id === 0x580 + node && data[0] === 0x80);
    await assert.rejects(transfer);
    assert.strictEqual((await abort).data.readUInt32LE(4).toString(16), code.toString(16));
  };

  // NMT and boot-up
  const boot = pipe.frame('boot-up', ({ id, data }) => id === 0x700 + node && data[0] === 0);
  master.nmt.resetNode(node);
  await boot;
  console.log('boot-up after NMT reset: yes');

  // SDO
  assert.strictEqual(await read(0x1000, 0, U32), 0x00020192);
  assert.strictEqual(await read(0x6502, 0, U32), 1 << 9);
  assert.strictEqual(await read(0x6076, 0, U32), 100000);
  await refused(0x06020000, read(0x5FFF, 0, U32));
  await refused(0x06090011, read(0x6091, 9, U32));
  await refused(0x06010002, write(0x6064, 0, I32, 1));
  await refused(0x06070010, write(0x6040, 0, U32, 6));
  console.log('SDO reads and aborts: yes');

  // PDO mapping: refused while the PDO is valid, then in the order of CiA 301
  const entries = [0x60410010, 0x60640020, 0x60770010];
  await write(0x1800, 1, U32, 0x180 + node);
  await refused(0x06010000, write(0x1A00, 1, U32, entries[0]));
  for (const [pdo, cob, type, map] of
      [[0x1800, 0x180 + node, 1, entries], [0x1400, 0x200 + node, 255, [0x60400010, 0x60710010]]]) {
    await write(pdo, 1, U32, 0x80000000 + cob);
    await write(pdo + 0x200, 0, U8, 0);
    for (let i = 0; i < map.length; ++i) await write(pdo + 0x200, i + 1, U32, map[i]);
    await write(pdo + 0x200, 0, U8, map.length);
    await write(pdo, 2, U8, type);
    await write(pdo, 1, U32, cob);
  }
  await write(0x6060, 0, I8, 10);
  await write(0x1017, 0, U16, 20);
  const beat = ({ id, data }) => id === 0x700 + node && data[0] === 0x7F;
  for (let i = 0; i < 3; ++i) await pipe.frame('heartbeat', beat);
  console.log('PDO mapping and heartbeat: yes');

  // SYNC, PDO and the power states
  const operational = pipe.frame('heartbeat', ({ id, data }) => id === 0x700 + node && data[0] === 5);
  master.nmt.startNode(node);
  await operational;
  const cycle = async (control, permille) => {
    const sample = pipe.frame('TPDO', ({ id }) => id === 0x180 + node);
    master.sync.write();
    const { data } = await sample;
    assert.strictEqual(data.length, 8);
    controlword.value = control;
    target.value = permille;
    master.pdo.write(0x200 + node);
    return statusword.value;
  };
  const reach = async (control, mask, value) => {
    for (let i = 0; i < 500; ++i) if ((await cycle(control, 0) & mask) === value) return;
    assert.fail(`statusword ${statusword.value.toString(16)} with controlword ${control}`);
  };
  await reach(0x06, 0x6F, 0x21);
  await reach(0x07, 0x6F, 0x23);
  await reach(0x0F, 0x6F, 0x27);
  for (let i = 0; i < 20; ++i) await cycle(0x0F, 30);
  assert.strictEqual(torque.value, 30);
  assert.ok(position.value > 0, `position ${position.value}`);
  console.log('SYNC, PDOs, switch on to operation enabled, torque: yes');
  await reach(0x02, 0x4F, 0x40);
  console.log('quick stop: yes');

  // emergency message, fault and its reset
  const emergency = new Promise((resolve) => master.emcy.on('emergency', resolve));
  await write(0x2000, 0, U16, 0x8400);
  const { em } = await emergency;
  assert.strictEqual(em.code, 0x8400);
  assert.strictEqual(await read(0x603F, 0, U16), 0x8400);
  assert.strictEqual(await cycle(0x00, 0) & 0x4F, 0x08);
  await reach(0x80, 0x4F, 0x40);
  console.log('EMCY, fault and reset: yes');

  const stopped = pipe.frame('heartbeat', ({ id, data }) => id === 0x700 + node && data[0] === 4);
  master.nmt.stopNode(node);
  await stopped;
  console.log('NMT stop: yes');
  master.stop();
  assert.strictEqual(await pipe.close(), 0);
}

main().then(() => process.exit(0), (error) => {
  console.error(error);
  process.exit(1);
});
