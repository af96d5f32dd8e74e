'use strict';
// load_eds.js EDS ...: the library `canopen` loads each of the files.

const assert = require('assert');
const { Eds } = require('canopen');

for (const file of process.argv.slice(2)) {
  const eds = Eds.fromFile(file);
  assert.strictEqual(eds.getEntry(0x1000).value & 0xFFFF, file.includes('drive') ? 402 : 401);
  assert.strictEqual(eds.getEntry(0x1A00)[1].value, file.includes('drive') ? 0x60410010 : 0x60000108);
  assert.strictEqual(eds.getEntry(0x1801)[2].value, 255);
  console.log(`${file.split('/').pop()}: ${[...eds.keys()].length} objects`);
}
