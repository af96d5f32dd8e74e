// usage: node live_test.js CHROMIUM URL
// Opens the page of a running godobject-live --hand and uses it as a viewer would. URL has the token. SPEED=yes also
// counts the pictures of a second, which only an idle machine draws fast enough.
const assert = require('node:assert/strict');
const {
  assertDistances, assertLegend, coloursOfNearest, placesOf,
} = require('../../support/browser/distances.js');
const {
  assertFitsPhone, openTab, phone, pixels, runTests, softwarePictures, wide,
} = require('../../support/browser/tabs.js');

const [, , chromium, address] = process.argv;
const { host } = new URL(address);

/**
 * Opens the page, waits for a controller that renders, and looks at the moving body, wherever other tests have left it.
 * `sent` of the page collects the messages to the server.
 */
async function open(browser, settings) {
  const isOwn = (url) => new URL(url).host === host || /^(data|blob):/.test(url);
  const tab = await openTab(browser, address, isOwn, settings);
  await tab.waitForFunction(() => window.godobjectPage.latest?.mode === 'running');
  await pause(tab);
  await tab.evaluate(() => {
    const { connection, picture } = window.godobjectPage;
    const moved = picture.motions[0].place().sub(picture.controls.target);
    picture.camera.position.add(moved);
    picture.controls.target.add(moved);
    picture.controls.update();
    const send = connection.send.bind(connection);
    window.sent = [];
    connection.send = (message) => {
      window.sent.push({ ...message, at: performance.now() });
      send(message);
    };
  });
  await pause(tab);
  return tab;
}

function pause(tab, pictures = 5) {
  return tab.evaluate(async (count) => {
    for (let i = 0; i < count; ++i) await new Promise((done) => requestAnimationFrame(done));
  }, pictures);
}

const latest = (tab, key) => tab.evaluate((name) => window.godobjectPage.latest[name], key);
const sent = (tab, type) => tab.evaluate((wanted) => window.sent.filter((m) => m.type === wanted), type);
const text = (tab, selector) => tab.$eval(selector, (e) => e.textContent);

/** Returns the places of the centres of the moving and the still body in the window [px]. */
function centres(tab) {
  return tab.evaluate(() => {
    const { data: { still }, picture } = window.godobjectPage;
    picture.camera.updateMatrixWorld();
    const moving = picture.motions[0].place();
    const middle = moving.clone().set(...still.low.map((low, axis) => (low + still.high[axis]) / 2));
    const box = picture.canvas.getBoundingClientRect();
    return [moving, middle].map((place) => {
      const { x, y } = place.project(picture.camera);
      return [box.left + ((x + 1) / 2) * box.width, box.top + ((1 - y) / 2) * box.height];
    });
  });
}

/** Waits for an expression of the page's parts to be true. */
const until = (tab, condition) => tab.waitForFunction(condition, { timeout: 60_000 });

/** Takes the moving body with the mouse. Returns its place [px]. */
async function grab(tab) {
  const [moving] = await centres(tab);
  await tab.mouse.move(...moving);
  await tab.mouse.down();
  await until(tab, () => window.godobjectPage.hand.holder === 'pointer');
  return moving;
}

/** Presses the moving body towards the still one until something holds it. Returns if it did. */
async function pressUntilContact(tab, [x, y]) {
  const [from, to] = await centres(tab);
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
  for (let i = 1; i < 80; ++i) {
    const along = (6 * i) / length;
    await tab.mouse.move(x + along * (to[0] - from[0]), y + along * (to[1] - from[1]));
    await pause(tab, 3);
    if (Math.hypot(...(await latest(tab, 'force'))) > 1) return true;
  }
  return false;
}

/** Chooses a stiffness as a viewer does. */
async function chooseStiffness(tab, value) {
  await tab.click('.quantity input[type=number]', { count: 3 });
  await tab.keyboard.type(String(value));
  await tab.keyboard.press('Enter');
}

const tests = {
  async 'draws the bodies and the arm'(browser) {
    const tab = await open(browser);
    const { blue, grey } = await pixels(tab);
    assert.ok(blue > 2000 && grey > 2000, JSON.stringify({ blue, grey }));
    const joints = (await latest(tab, 'arm')).length;
    assert.ok(joints > 1, `${joints}`);
    const drawn = () => tab.evaluate(() => window.godobjectPage.objects.arm.visible);
    await tab.keyboard.press('a');
    assert.equal(await drawn(), false);
    await tab.keyboard.press('a');
    assert.equal(await drawn(), true);
    return tab;
  },

  async 'states arrive and are plotted'(browser) {
    const tab = await open(browser);
    const first = await latest(tab, 't');
    await tab.waitForFunction((t) => window.godobjectPage.latest.t > t + 0.3, {}, first);
    assert.match(await text(tab, '.fact.time'), /^\d+\.\d s$/);
    assert.equal(await text(tab, '.mode'), 'running');
    const { figures, buckets } = await tab.evaluate(() => {
      const { plots } = window.godobjectPage;
      return { figures: plots.figures.length, buckets: plots.history.t.length };
    });
    assert.equal(figures, 8);
    assert.ok(buckets > 5, `${buckets}`);
    assert.match(await text(tab, '.plot .value'), /^\d+\.\d\d$/);
    return tab;
  },

  async 'keeps an extreme between two states'(browser) {
    const tab = await open(browser);
    const largest = await tab.evaluate(() => {
      const { latest: state, plots } = window.godobjectPage;
      plots.take({ t: state.t + 0.001, plots: { ...state.plots, force: [0, 0, 77] } });
      plots.take({ t: state.t + 0.002, plots: { ...state.plots, force: [0, 0, 0] } });
      return Math.max(...plots.table(plots.figures[0].quantity)[2]);
    });
    assert.equal(largest, 77);
    return tab;
  },

  async 'draws a gap for a number that is not known'(browser) {
    const tab = await open(browser);
    const [low, high] = await tab.evaluate(() => {
      const { latest: { t, plots: known }, plots } = window.godobjectPage;
      const take = (time, energy) => plots.take({ t: time, plots: { ...known, energy: [energy, energy, energy] } });
      const { quantity } = plots.figures.find((figure) => figure.quantity.key === 'energy');
      plots.history.clear();
      for (const [after, energy] of [[1, null], [1.02, 3], [1.04, null], [1.041, 5], [1.042, null]]) take(t + after, energy);
      const [, ...rows] = plots.table(quantity);
      plots.history.clear();
      return rows;
    });
    assert.deepEqual(low, [null, 3000, null, 5000]);
    assert.deepEqual(high, low);
    return tab;
  },

  async 'begins the plots again when the time goes back'(browser) {
    const tab = await open(browser);
    const times = await tab.evaluate(() => {
      const { latest: { t, plots: known }, plots } = window.godobjectPage;
      for (const time of [t + 1, t + 1.02, 0.001, 0.002, 0.03]) plots.take({ t: time, plots: known });
      const [shown] = plots.table(plots.figures[0].quantity);
      plots.history.clear();
      return Array.from(shown, (time) => Math.round(1e3 * time));
    });
    assert.deepEqual(times, [-29, -28, 0]);
    return tab;
  },

  async 'a drag on the body moves the hand into contact'(browser) {
    const tab = await open(browser);
    await until(tab, () => !document.querySelector('.notice.hint').hidden);
    const place = await grab(tab);
    assert.ok(await pressUntilContact(tab, place), 'no force');
    await until(tab, () => window.godobjectPage.latest.hand === 'yours');
    await pause(tab);
    const { red } = await pixels(tab);
    assert.ok(red > 15, `${red} red pixels`);
    assert.equal(await text(tab, '.state'), 'contact');
    assert.equal(await tab.$eval('.notice.hint', (e) => e.hidden), true);
    await tab.mouse.up();
    await until(tab, () => window.godobjectPage.latest.hand === 'free');
    const poses = await sent(tab, 'hand');
    const rate = (1000 * (poses.length - 1)) / (poses.at(-1).at - poses[0].at);
    assert.ok(poses.length > 5 && rate <= 61, `${poses.length} poses, ${rate} a second`);
    for (const { pose } of poses) assert.ok(Math.abs(Math.hypot(...pose.slice(3)) - 1) < 1e-9 && pose.length === 7);
    assert.equal((await sent(tab, 'release')).length, 1);
    return tab;
  },

  async 'wheel, shift and alt push, turn and twist the target'(browser) {
    const tab = await open(browser);
    const target = () => tab.evaluate(() => {
      const { place, turn } = window.godobjectPage.hand.wanted;
      return [...place.toArray(), ...turn.toArray()];
    });
    const change = (a, b, from, to) => Math.hypot(...a.slice(from, to).map((v, i) => v - b[from + i]));
    const [x, y] = await grab(tab);
    const first = await target();
    await tab.mouse.wheel({ deltaY: -100 });
    await until(tab, () => {
      const { wanted, device } = window.godobjectPage.hand;
      return wanted.place.distanceTo(device.place) > 1e-4;
    });
    const pushed = await target();
    assert.ok(change(pushed, first, 0, 3) > 1e-4 && change(pushed, first, 3, 7) < 1e-12);
    await tab.keyboard.down('Shift');
    await tab.mouse.move(x + 40, y);
    await tab.keyboard.up('Shift');
    const turned = await target();
    assert.ok(change(turned, pushed, 3, 7) > 0.02 && change(turned, pushed, 0, 3) < 1e-12);
    await tab.keyboard.down('Alt');
    await tab.mouse.move(x + 40, y + 40);
    await tab.keyboard.up('Alt');
    const twisted = await target();
    assert.ok(change(twisted, turned, 3, 7) > 0.02 && change(twisted, turned, 0, 3) < 1e-12);
    await tab.mouse.up();
    return tab;
  },

  async 'keys move the hand and release it'(browser) {
    const tab = await open(browser);
    await tab.keyboard.down('ArrowUp');
    await until(tab, () => window.sent.filter((m) => m.type === 'hand').length > 3);
    await tab.keyboard.up('ArrowUp');
    await until(tab, () => window.sent.some((m) => m.type === 'release'));
    return tab;
  },

  async 'a gamepad and a SpaceMouse move the hand and release it'(browser) {
    const tab = await open(browser);
    const moves = async (begin, end) => {
      await tab.evaluate(() => (window.sent.length = 0));
      await tab.evaluate(begin);
      await until(tab, () => window.sent.filter((m) => m.type === 'hand').length > 3);
      await tab.evaluate(end);
      await until(tab, () => window.sent.some((m) => m.type === 'release'));
    };
    await moves(() => {
      const buttons = Array.from({ length: 16 }, () => ({ value: 0 }));
      navigator.getGamepads = () => [null, { axes: [0, -0.6, 0, 0], buttons }];
    }, () => (navigator.getGamepads = () => []));
    await tab.evaluate(() => {
      const device = Object.assign(new EventTarget(), { opened: true, productName: 'SpaceMouse' });
      const report = (z) => {
        const data = new DataView(new ArrayBuffer(6));
        data.setInt16(4, z, true);
        device.dispatchEvent(Object.assign(new Event('inputreport'), { reportId: 1, data }));
      };
      Object.defineProperty(navigator, 'hid', { value: { requestDevice: async () => [device] } });
      window.pressCap = () => (window.cap = setInterval(() => report(-200), 20)); // upwards
      window.releaseCap = () => clearInterval(window.cap);
    });
    const [button] = await tab.$$('xpath/.//button[text()="Connect SpaceMouse"]');
    await button.click();
    await until(tab, () => /SpaceMouse moves the hand/.test(document.querySelector('.notice.answer').textContent));
    await moves(() => window.pressCap(), () => window.releaseCap());
    return tab;
  },

  async 'a drag beside the body turns the camera'(browser) {
    const tab = await open(browser);
    const camera = () => tab.evaluate(() => window.godobjectPage.picture.camera.position.toArray());
    const before = await camera();
    const box = await (await tab.$('.picture')).boundingBox();
    await tab.mouse.move(box.x + box.width - 12, box.y + 0.5 * box.height);
    await tab.mouse.down();
    await tab.mouse.move(box.x + box.width - 90, box.y + 0.5 * box.height, { steps: 4 });
    await tab.mouse.up();
    assert.ok((await camera()).some((value, axis) => Math.abs(value - before[axis]) > 1e-4));
    assert.deepEqual(await sent(tab, 'hand'), []);
    return tab;
  },

  async 'changes the solver'(browser) {
    const tab = await open(browser);
    const choose = async (name) => {
      const [button] = await tab.$$(`xpath/.//div[@class="solvers"]/button[text()="${name}"]`);
      await button.click();
      await tab.waitForFunction((wanted) => window.godobjectPage.latest.settings.solver === wanted, {}, name);
      await tab.waitForFunction((wanted) => document.querySelector('.solvers .on').textContent === wanted, {}, name);
    };
    await choose('corrected');
    await choose('contact');
    return tab;
  },

  async 'shows a refusal, and tries anyway on request'(browser) {
    const tab = await open(browser);
    const { boundary, stiffness } = await latest(tab, 'settings');
    await chooseStiffness(tab, Math.round(1.3 * boundary));
    await until(tab, () => !document.querySelector('.refusal').hidden);
    assert.match(await text(tab, '.refusal span'), /stability boundary/);
    await until(tab, () => Number(document.querySelector('.quantity input[type=number]').value) ===
      Math.round(window.godobjectPage.latest.settings.stiffness));
    await tab.click('.refusal button');
    await until(tab, () => window.godobjectPage.latest.settings.beyond && document.querySelector('.limit.beyond'));
    await chooseStiffness(tab, Math.round(stiffness));
    await until(tab, () => !window.godobjectPage.latest.settings.beyond && !document.querySelector('.limit.beyond'));
    return tab;
  },

  async 'connects again'(browser) {
    const tab = await open(browser);
    await tab.evaluate(() => window.godobjectPage.connection.socket.close());
    await until(tab, () => document.querySelector('#player.offline') && !document.querySelector('.connection').hidden);
    const { blue } = await pixels(tab);
    assert.ok(blue > 2000, 'the last picture stays');
    await until(tab, () => !document.querySelector('#player.offline') && document.querySelector('.connection').hidden);
    const time = await latest(tab, 't');
    await tab.waitForFunction((t) => window.godobjectPage.latest.t > t, {}, time);
    return tab;
  },

  async 'tells a second viewer that the hand is taken'(browser) {
    const tab = await open(browser);
    const other = await open(browser);
    await tab.bringToFront();
    await pause(tab);
    await grab(tab);
    await tab.mouse.wheel({ deltaY: -10 });
    await other.waitForFunction(() => window.godobjectPage.latest.hand === 'other', { polling: 100 });
    assert.equal(await latest(other, 'viewers'), 2);
    assert.match(await text(other, '.fact.hand'), /another viewer/);
    await tab.mouse.up();
    assert.deepEqual(other.complaints, []);
    await other.close();
    return tab;
  },

  async 'fits a phone, where a finger moves the body'(browser) {
    const tab = await open(browser, { viewport: phone });
    await tab.keyboard.press('m');
    await assertFitsPhone(tab);
    await assertLegend(tab);
    const [[x, y]] = await centres(tab);
    await tab.touchscreen.touchStart(x, y);
    await tab.touchscreen.touchMove(x + 12, y - 8);
    await until(tab, () => window.sent.some((m) => m.type === 'hand'));
    await tab.touchscreen.touchEnd();
    await until(tab, () => window.sent.some((m) => m.type === 'release'));
    return tab;
  },

  async 'is light or dark as the system'(browser) {
    const ground = (tab) => tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await open(browser);
    const before = await ground(light);
    await light.close();
    const dark = await open(browser, { scheme: 'dark' });
    assert.notEqual(await ground(dark), before);
    return dark;
  },

  async 'colours the god object by distance on request'(browser) {
    const tab = await open(browser);
    await tab.keyboard.press('m');
    await assertLegend(tab);
    await until(tab, () => window.godobjectPage.picture.colours.motions[0].pass >= 2);
    await assertDistances(tab, 6, 0.05);
    assert.ok(await pressUntilContact(tab, await grab(tab)), 'no force');
    // the last pose is measured some pictures after it is there, and the body may still yield a little
    const isNear = ([red, green, blue]) => Math.min(red, green) > 120 && blue < 110;
    let near = await coloursOfNearest(tab);
    for (let i = 0; i < 40 && !near.some(isNear); ++i) {
      await pause(tab);
      near = await coloursOfNearest(tab);
    }
    await tab.mouse.up();
    assert.ok(near.some(isNear), JSON.stringify(near));
    await tab.click('.options label:has(+ .legend)');
    assert.deepEqual((await placesOf(tab)).legend, [0, 0]);
    const { blue } = await pixels(tab);
    assert.ok(blue > 2000, `${blue}`);
    return tab;
  },
};

const speed = {
  async 'draws 30 pictures a second without a graphics card'(browser) {
    const tab = await open(browser, { viewport: wide });
    await grab(tab);
    let most = 0;
    for (let second = 0; second < 12 && most < 30; ++second) { // the first ones make the page simpler
      await tab.mouse.wheel({ deltaY: second % 2 ? -60 : 60 });
      most = Math.max(most, await tab.evaluate(() => new Promise((done) => {
        const { picture } = window.godobjectPage;
        const begin = performance.now();
        let drawn = 0;
        const count = (now) => {
          picture.invalidate();
          drawn += 1;
          if (now - begin < 1000) requestAnimationFrame(count);
          else done(Math.round((1000 * drawn) / (now - begin)));
        };
        requestAnimationFrame(count);
      })));
    }
    await tab.mouse.up();
    assert.ok(most >= 30, `${most} a second`);
    return tab;
  },
};

runTests(chromium, softwarePictures, process.env.SPEED === 'yes' ? { ...tests, ...speed } : tests).catch((error) => {
  console.error(error);
  process.exit(1);
});
