// usage: node page_test.js CHROMIUM FOLDER
// Opens FOLDER/{one,two,long}.html from the disk and uses them as a viewer would.
const assert = require('node:assert/strict');
const path = require('node:path');
const {
  assertDistances, assertLegend, coloursOfNearest, finishDistances, placesOf,
} = require('../../support/browser/distances.js');
const { assertFitsPhone, openTab, phone, pixels, runTests, softwareGl } = require('../../support/browser/tabs.js');

const [, , chromium, folder] = process.argv;

function open(browser, name, { hash = '', ...settings } = {}) {
  const address = `file://${path.resolve(folder, name)}${hash}`;
  return openTab(browser, address, (url) => /^(file|data|blob):/.test(url), settings);
}

const time = (tab) => tab.evaluate(() => window.godobjectPage.clock.time);
const sample = (tab) => tab.evaluate(() => window.godobjectPage.clock.sample);

const tests = {
  async 'opens playing just before the first contact'(browser) {
    const tab = await open(browser, 'long.html');
    const first = await time(tab);
    assert.ok(first > 24.8 && first < 40, `${first}`);
    await tab.waitForFunction((t) => window.godobjectPage.clock.time > t + 0.01, {}, first);
    assert.equal(await tab.evaluate(() => window.godobjectPage.clock.playing), true);
    return tab;
  },

  async 'draws the bodies and the force'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0.9' });
    const { blue, grey, red, violet } = await pixels(tab);
    assert.ok(blue > 2000 && grey > 2000 && red > 200 && violet < 100, JSON.stringify({ blue, grey, red, violet }));
    return tab;
  },

  async 'a scrub moves the god object'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0' });
    const before = await pixels(tab);
    const scrub = await (await tab.$('.track input')).boundingBox();
    await tab.mouse.click(scrub.x + scrub.width / 2, scrub.y + scrub.height / 2);
    const at = await sample(tab);
    assert.ok(at > 450 && at < 550, `sample ${at}`);
    const z = await tab.evaluate(() => window.godobjectPage.picture.motions[0].godObject.position.z);
    assert.ok(Math.abs(z - Math.max(0.03 - 0.06 * (at / 1000), 0)) < 1e-6, `z ${z}`);
    const after = await pixels(tab);
    assert.ok(after.row > before.row + 20, `${before.row} ${after.row}`);
    assert.match(await tab.$eval('.time', (e) => e.textContent), /^0\.[45]/);
    return tab;
  },

  async 'keys play, pause, step by one cycle and change the speed'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0.5' });
    await tab.keyboard.press('ArrowRight');
    assert.equal(await sample(tab), 501);
    await tab.keyboard.press('ArrowLeft');
    await tab.keyboard.press('ArrowLeft');
    assert.equal(await sample(tab), 499);
    await tab.keyboard.press('Space');
    await tab.waitForFunction(() => window.godobjectPage.clock.sample > 505);
    await tab.keyboard.press('Space');
    const [slow, fast] = await tab.evaluate(() => {
      const { clock } = window.godobjectPage;
      const moved = (speed) => {
        const select = document.querySelector('.transport select');
        select.value = speed;
        select.dispatchEvent(new Event('change'));
        clock.seekSample(0);
        clock.playing = true;
        clock.advance(0.2);
        clock.playing = false;
        return clock.time;
      };
      return [moved('0.1'), moved('2')];
    });
    assert.ok(Math.abs(slow - 0.02) < 1e-9 && Math.abs(fast - 0.4) < 1e-9, `${slow} ${fast}`);
    return tab;
  },

  async 'stops at the end, or begins again on request'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#t=0.99&speed=2' });
    await tab.waitForFunction(() => !window.godobjectPage.clock.playing);
    assert.equal(await sample(tab), 1000);
    await tab.keyboard.press('l');
    await tab.evaluate(() => window.godobjectPage.clock.seekTime(0.99));
    await tab.keyboard.press('Space');
    await tab.waitForFunction(() => window.godobjectPage.clock.time < 0.5 && window.godobjectPage.clock.playing);
    return tab;
  },

  async 'a click in a plot seeks, and its line follows'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0' });
    const plot = await (await tab.$('.plot .u-over')).boundingBox();
    await tab.mouse.click(plot.x + 0.75 * plot.width, plot.y + plot.height / 2);
    assert.ok(Math.abs((await time(tab)) - 0.75) < 0.02, `${await time(tab)}`);
    const line = await (await tab.$('.plot .now')).boundingBox();
    assert.ok(Math.abs(line.x - plot.x - 0.75 * plot.width) < 4);
    assert.equal(await tab.$eval('.plot .value', (e) => e.textContent), '15.00');
    return tab;
  },

  async 'shows two replays side by side with one camera'(browser) {
    const tab = await open(browser, 'two.html', { hash: '#paused&t=0.9' });
    const [left, right] = [await pixels(tab, 0, 0.5), await pixels(tab, 0.5, 1)];
    assert.ok(left.blue > 500 && left.violet < 100, JSON.stringify(left));
    assert.ok(right.violet > 500, JSON.stringify(right));
    const box = await (await tab.$('.picture')).boundingBox();
    await tab.mouse.move(box.x + 0.75 * box.width, box.y + box.height / 2);
    await tab.mouse.down();
    await tab.mouse.move(box.x + 0.75 * box.width, box.y + box.height / 2 + 90, { steps: 4 });
    await tab.mouse.up();
    const turned = await pixels(tab, 0, 0.5);
    const change = Math.max(Math.abs(turned.row - left.row), Math.abs(turned.blue - left.blue) / 100);
    assert.ok(change > 1, 'the left view turns, too');
    const names = await tab.$$eval('.label .name', (labels) => labels.map((label) => label.textContent));
    assert.deepEqual(names, ['replay contact', 'replay paper']);
    assert.equal(await tab.$$eval('.plot .value.inside', (values) => values.length), 1); // the depth of paper
    return tab;
  },

  async 'cuts the still body open'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0.1' });
    const before = await pixels(tab);
    await tab.keyboard.press('c');
    const after = await pixels(tab);
    assert.ok(after.cap > before.cap + 2000, `${before.cap} ${after.cap}`);
    return tab;
  },

  async 'colours the god object by distance on request'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0.9' });
    const before = await pixels(tab);
    assert.equal(await tab.evaluate(() => window.godobjectPage.picture.colours.motions), undefined);
    assert.deepEqual((await placesOf(tab)).legend, [0, 0]);
    await tab.keyboard.press('m');
    await finishDistances(tab);
    const coloured = await pixels(tab);
    assert.ok(coloured.green > before.green + 100, `${before.green} ${coloured.green}`);
    const near = await coloursOfNearest(tab);
    assert.ok(near.some(([red, green, blue]) => red > 150 && green > 150 && blue < 110), JSON.stringify(near));
    await assertLegend(tab);
    assert.match(await tab.$eval('.legend', (e) => e.textContent), /^inside0.*mm$/);
    await tab.keyboard.press('m');
    assert.deepEqual((await placesOf(tab)).legend, [0, 0]);
    const { blue: restored, green: arcs } = await pixels(tab);
    assert.ok(Math.abs(restored - before.blue) < 0.02 * before.blue && Math.abs(arcs - before.green) < 30);
    return tab;
  },

  async 'measures distances as all triangles tell them, also after a motion'(browser) {
    const tab = await open(browser, 'two.html', { hash: '#paused&t=0.3&distance' });
    for (const share of [0.3, 0.9, 0.55, 0.551]) {
      await tab.evaluate((time) => window.godobjectPage.clock.seekTime(time), share);
      await finishDistances(tab);
      await assertDistances(tab, 25, 1e-6);
    }
    return tab;
  },

  async 'marks places inside the still body'(browser) {
    const tab = await open(browser, 'two.html', { hash: '#paused&t=0.9&cut=y' });
    const before = await pixels(tab, 0.5, 1);
    await tab.keyboard.press('m');
    await finishDistances(tab);
    const after = await pixels(tab, 0.5, 1);
    assert.ok(after.red > before.red + 200, `${before.red} ${after.red}`);
    return tab;
  },

  async 'cuts large triangles for their colours, without gaps'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0.9&distance' });
    const { longest, triangles, areas, borders } = await tab.evaluate(() => {
      const { picture } = window.godobjectPage;
      const [{ surface, coloured }] = picture.motions;
      const V = picture.target.constructor;
      const cornersOf = ({ index, attributes: { position } }) => Array.from(index ? index.array : position.array.keys())
        .slice(0, index ? index.count : position.count).map((i) => new V().fromBufferAttribute(position, i));
      const area = (all) => all.reduce((sum, a, i) => (i % 3 ? sum : sum +
        all[i + 1].clone().sub(a).cross(all[i + 2].clone().sub(a)).length() / 2), 0);
      const fine = cornersOf(coloured.geometry);
      const { vertex } = coloured.geometry.attributes;
      const sides = new Map();
      coloured.geometry.index.array.forEach((corner, i, all) => {
        const pair = [corner, all[i % 3 === 2 ? i - 2 : i + 1]].map((c) => vertex.array[c]).sort((a, b) => a - b).join();
        sides.set(pair, (sides.get(pair) ?? 0) + 1);
      });
      return {
        longest: Math.max(...fine.map((a, i) => a.distanceTo(fine[i % 3 === 2 ? i - 2 : i + 1]))) / picture.size,
        triangles: fine.length / 3, areas: [area(cornersOf(surface.geometry)), area(fine)],
        borders: [...sides.values()].filter((count) => count !== 2).length,
      };
    });
    assert.ok(longest <= 1.001 / 48 && triangles < 60_000, `${longest} ${triangles}`);
    assert.ok(Math.abs(areas[0] - areas[1]) < 1e-5 * areas[0], `${areas}`);
    assert.equal(borders, 0);
    return tab;
  },

  async 'follows the god object, and resets the view'(browser) {
    const tab = await open(browser, 'one.html', { hash: '#paused&t=0' });
    const camera = () => tab.evaluate(() => window.godobjectPage.picture.camera.position.toArray());
    const before = await camera();
    await tab.click('.options label');
    await tab.evaluate(() => window.godobjectPage.clock.seekTime(0.5));
    const moved = (await camera()).map((value, axis) => value - before[axis]);
    assert.ok(Math.abs(moved[0] - 0.03) < 1e-6 && Math.abs(moved[2] + 0.03) < 1e-6, `${moved}`);
    await tab.keyboard.press('r');
    const after = await camera();
    assert.ok(after.every((value, axis) => Math.abs(value - before[axis]) < 1e-9), `${after}`);
    return tab;
  },

  async 'follows the system in light and dark until a button is pressed'(browser) {
    const ground = (tab) => tab.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await open(browser, 'one.html', { scheme: 'light' });
    const dark = await open(browser, 'one.html', { scheme: 'dark' });
    assert.notEqual(await ground(light), await ground(dark));
    await dark.keyboard.press('d');
    assert.equal(await ground(light), await ground(dark));
    assert.deepEqual(light.complaints, []);
    await light.close();
    return dark;
  },

  async 'fits a phone'(browser) {
    for (const name of ['one.html', 'two.html']) {
      const tab = await open(browser, name, { viewport: phone, hash: '#paused&t=0.9&cut=y&distance' });
      await assertFitsPhone(tab);
      await assertLegend(tab);
      assert.deepEqual(tab.complaints, []);
      await tab.close();
    }
  },

  async 'shows the extremes of a long replay'(browser) {
    const tab = await open(browser, 'long.html', { hash: '#paused&t=30' });
    const { bucket, samples, largest } = await tab.evaluate(() => {
      const { data } = window.godobjectPage;
      const { extremes } = data.replays[0].plots.force;
      return { bucket: data.bucket, samples: data.t.length, largest: Math.max(...extremes) };
    });
    assert.equal(bucket, 3);
    assert.equal(samples, 16667);
    assert.ok(largest > 55, `${largest}`);
    return tab;
  },
};

async function withoutWebGl(browser) {
  const tab = await open(browser, 'one.html', { hash: '#paused' });
  assert.match(await tab.$eval('.message', (e) => e.textContent), /needs WebGL 2/);
  assert.equal(await tab.$eval('.label .name', (e) => e.textContent), 'replay contact');
  const plot = await (await tab.$('.plot .u-over')).boundingBox();
  await tab.mouse.click(plot.x + 0.75 * plot.width, plot.y + plot.height / 2);
  assert.ok(Math.abs((await time(tab)) - 0.75) < 0.02);
  return tab;
}

(async () => {
  await runTests(chromium, softwareGl, tests);
  await runTests(chromium, ['--disable-3d-apis'], {
    'without WebGL it says so, and the plots work': withoutWebGl,
  });
})().catch((error) => {
  console.error(error);
  process.exit(1);
});
