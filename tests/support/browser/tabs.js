// Opens pages of the player in chromium for tests, and counts what they draw. Needs NODE_PATH with puppeteer-core.
const assert = require('node:assert/strict');
const puppeteer = require('puppeteer-core');

const wide = { width: 1300, height: 860 };
const coarse = { ...wide, deviceScaleFactor: 0.5 }; // a quarter of the pixels, which a processor draws in less time
const phone = { width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2 };
// The processor draws in place of a graphics card: in all of the browser, or only the 3D pictures (faster).
const softwareGl = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const softwarePictures = ['--use-gl=angle', '--use-angle=swiftshader-webgl', '--enable-unsafe-swiftshader'];

/** Opens an address. `complaints` collects errors, warnings and requests that `isAllowed(url)` refuses. */
async function openTab(browser, address, isAllowed, { viewport = coarse, scheme = 'light' } = {}) {
  const tab = await browser.newPage();
  tab.setDefaultTimeout(300_000); // a busy machine draws slowly
  tab.complaints = [];
  tab.on('console', (message) => ['error', 'warn'].includes(message.type()) && !message.text().includes('GPU stall') &&
    tab.complaints.push(message.text()));
  tab.on('pageerror', (error) => tab.complaints.push(error.message));
  tab.on('request', (request) => isAllowed(request.url()) || tab.complaints.push(request.url()));
  await tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  await tab.setViewport(viewport);
  await tab.goto(address);
  await tab.waitForFunction(() => window.godobjectPage);
  await tab.waitForSelector('.plot canvas');
  return tab;
}

/** Draws, and returns for a part of the picture how many pixels have each colour, and the mean row of the blue ones. */
function pixels(tab, from = 0, to = 1) {
  return tab.evaluate((begin, end) => {
    const { picture } = window.godobjectPage;
    picture.setSharpness(1); // a slow machine draws fewer pixels
    picture.invalidate();
    picture.draw();
    const { width, height } = picture.canvas;
    const copy = new OffscreenCanvas(width, height).getContext('2d');
    copy.drawImage(picture.canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    const counts = { blue: 0, violet: 0, grey: 0, red: 0, green: 0, cap: 0, drawn: 0, row: 0 };
    for (let y = 0; y < height; ++y) {
      for (let x = Math.floor(begin * width); x < end * width; ++x) {
        const [r, g, b, a] = data.subarray(4 * (y * width + x), 4 * (y * width + x) + 4);
        if (a < 250) continue;
        counts.drawn += 1;
        if (b > r + 60 && b > g + 40 && r < g) { counts.blue += 1; counts.row += y; }
        if (b > g + 60 && r > g + 30) counts.violet += 1;
        if (r > g && g > b && r - b < 40 && r > 90) counts.grey += 1;
        if (r > 200 && g < 60) counts.red += 1;
        if (g > r + 40 && g > b + 30) counts.green += 1;
        if (r > g + 25 && g > b + 15 && r > 150) counts.cap += 1;
      }
    }
    counts.row /= counts.blue || 1;
    return counts;
  }, from, to);
}

/** Fails if a page is wider than the screen of a phone or has something to touch beside it. */
async function assertFitsPhone(tab) {
  assert.ok((await tab.evaluate(() => document.documentElement.scrollWidth)) <= phone.width);
  const right = await tab.$$eval('button, select, input, .value', (all) =>
    Math.max(...all.map((one) => one.getBoundingClientRect().right)));
  assert.ok(right <= phone.width, `${right}`);
}

/** Runs named tests in a browser. Each gets it, and may return a tab, which must have no complaints. */
async function runTests(chromium, options, tests) {
  const browser = await puppeteer.launch({
    executablePath: chromium,
    args: ['--no-sandbox', ...options],
    timeout: 300_000,
    protocolTimeout: 600_000,
  });
  try {
    for (const [name, test] of Object.entries(tests)) {
      const begin = Date.now();
      const tab = await test(browser);
      if (tab) assert.deepEqual(tab.complaints, [], name);
      await tab?.close();
      console.log(`passed: ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
    }
  } finally {
    await browser.close();
  }
}

module.exports = { assertFitsPhone, openTab, phone, pixels, runTests, softwareGl, softwarePictures, wide };
