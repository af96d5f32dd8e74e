'use strict';
// foreign_slave.js PROGRAM LOG: a drive, node 5, and a panel, node 20h, written with the library `canopen`, for our master.
// The library lacks CiA 402, the boot-up message and TPDOs of type 255, so this file has the power states and sends both.
// At a reset the library restores neither 1005 nor sub-objects.

const assert = require('assert');
const { Device, DataType, ObjectType, AccessType, NmtState } = require('canopen');
const { Pipe } = require('./pipe.js');

const U8 = DataType.UNSIGNED8, U16 = DataType.UNSIGNED16, U32 = DataType.UNSIGNED32;
const I8 = DataType.INTEGER8, I16 = DataType.INTEGER16, I32 = DataType.INTEGER32;

function makeDevice(pipe, id, deviceType) {
  const device = new Device({ id });
  const { eds } = device;
  const object = (index, dataType, defaultValue = 0, accessType = AccessType.READ_WRITE) =>
      eds.getEntry(index) || eds.addEntry(index, { parameterName: index.toString(16), dataType, defaultValue, accessType });
  device.object = object;
  device.record = (index, types) => {
    const entry = eds.addEntry(index, { parameterName: index.toString(16), objectType: ObjectType.RECORD });
    types.forEach((dataType, i) => entry.addSubObject(i + 1, { parameterName: `${index.toString(16)}sub${i + 1}`, dataType }));
    return entry;
  };
  if (eds.getEntry(0x1000)) eds.removeEntry(0x1000);
  object(0x1000, U32, deviceType, AccessType.READ_ONLY);
  object(0x1005, U32, 0x80);
  object(0x1014, U32, 0x80 + id);
  object(0x1017, U16);
  eds.addSdoServerParameter(127, 0x580 + id, 0x600 + id);
  device.nmt.on('reset', () => setImmediate(() => setImmediate(() => pipe.send(0x700 + id, [0], device))));
  pipe.add(device);
  return device;
}

async function main() {
  const pipe = new Pipe(process.argv[2], process.argv[3]);
  const drive = makeDevice(pipe, 5, 0x00020192);
  const { object } = drive;
  object(0x1006, U32);
  drive.eds.addHeartbeatConsumer(127, 1000);
  drive.record(0x1029, [U8]);
  object(0x6007, I16);
  const controlword = object(0x6040, U16), statusword = object(0x6041, U16, 0x40);
  object(0x605A, I16, 2);
  object(0x605E, I16, 2);
  const mode = object(0x6060, I8), modeDisplay = object(0x6061, I8);
  const position = object(0x6064, I32, 12345);
  const target = object(0x6071, I16), actual = object(0x6077, I16);
  object(0x6076, U32, 2000, AccessType.READ_ONLY);
  object(0x6085, U32, 1000);
  drive.record(0x60C2, [U8, I8]);
  object(0x6502, U32, 1 << 9, AccessType.READ_ONLY);
  drive.eds.addReceivePdo({ cobId: 0x80000205, transmissionType: 255, dataObjects: [controlword, target] });
  drive.eds.addTransmitPdo({ cobId: 0x80000185, transmissionType: 255, dataObjects: [statusword, position, actual] });
  drive.eds.addTransmitPdo({ cobId: 0x80000285, transmissionType: 255, dataObjects: [modeDisplay] });
  setInterval(() => drive.nmt.state === NmtState.OPERATIONAL && pipe.send(0x285, [modeDisplay.value], drive), 100);
  const panel = makeDevice(pipe, 0x20, 0x00010191);
  const inputs = panel.record(0x6000, [U8]);
  panel.eds.addTransmitPdo({ cobId: 0x800001A0, transmissionType: 255, dataObjects: [inputs[1]] });

  mode.on('update', () => { modeDisplay.value = mode.value; });
  let permille = 0, stopped = 0;
  drive.pdo.on('pdo', () => {
    inputs[1].value = 0b011;  // emergency stop released, enable switch held
    const command = controlword.value & 0x0F;
    const state = statusword.value & 0x6F;
    if (command === 0x06) statusword.value = 0x1231;
    else if (command === 0x07 && state !== 0x40) statusword.value = 0x1233;
    else if (command === 0x0F && (state === 0x23 || state === 0x27)) statusword.value = 0x1237;
    else if (!(command & 0x04)) statusword.value = 0x1250;
    if (statusword.value === 0x1237) {
      actual.value = target.value;
      if (target.value !== 0) permille = target.value;
    } else {
      actual.value = 0;
    }
  });

  // the drive fails some time after it was enabled and stopped
  drive.sync.on('sync', () => {
    if (permille !== 0 && statusword.value === 0x1250 && ++stopped === 20) drive.emcy.write(0x7305, Buffer.alloc(5));
  });

  drive.start();
  panel.start();
  const code = await pipe.ended;
  assert.strictEqual(code, 0, `our master ended with ${code}`);
  assert.strictEqual(permille, -50);
  console.log('our master starts, enables, commands, stops and hears a foreign drive and a foreign panel: yes');
}

main().then(() => process.exit(0), (error) => {
  console.error(error);
  process.exit(1);
});
