'use strict';
// Connects devices of the library `canopen` with one of our programs by a pipe, one frame a line: 203#0F00CEFF. Writes the
// frames of both sides into a log in the format of candump -L.

const { spawn } = require('child_process');
const fs = require('fs');
const readline = require('readline');

class Pipe {
  constructor(program, logFile) {
    this.devices = [];
    this.watchers = [];
    this.log = fs.openSync(logFile, 'w');
    this.child = spawn(program, { stdio: ['pipe', 'pipe', 'inherit'] });
    this.child.stdin.on('error', () => {});  // it may end first
    this.ended = new Promise((resolve) => this.child.on('exit', (code) => resolve(code)));
    readline.createInterface({ input: this.child.stdout }).on('line', (line) => this.receive(line));
  }

  add(device) {
    this.devices.push(device);
    device.addListener('message', ({ id, data }) => this.send(id, data, device));
  }

  send(id, data, from) {
    const line = id.toString(16).toUpperCase().padStart(3, '0') + '#' +
        Buffer.from(data || []).toString('hex').toUpperCase();
    this.record(line);
    this.child.stdin.write(line + '\n');
    for (const device of this.devices) if (device !== from) this.deliver(device, line);
  }

  receive(line) {
    this.record(line);
    for (const device of this.devices) this.deliver(device, line);
    const message = this.parse(line);
    this.watchers = this.watchers.filter((watcher) => !watcher(message));
  }

  deliver(device, line) {
    device.receive(this.parse(line));
  }

  parse(line) {
    const [id, data] = line.split('#');
    return { id: parseInt(id, 16), data: Buffer.from(data, 'hex'), len: data.length / 2 };
  }

  record(line) {
    const us = process.hrtime.bigint() / 1000n;
    fs.writeSync(this.log, `(${us / 1000000n}.${String(us % 1000000n).padStart(6, '0')}) can0 ${line}\n`);
  }

  // Resolves to the first frame from now on for which `wanted` returns true.
  frame(what, wanted) {
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`no ${what} within 20 s`)), 20000);
      this.watchers.push((message) => {
        if (!wanted(message)) return false;
        clearTimeout(timer);
        resolve(message);
        return true;
      });
    });
  }

  close() {
    this.child.stdin.end();
    return this.ended;
  }
}

module.exports = { Pipe };
