// SPDX-License-Identifier: Apache-2.0
// Tests a real report in a real browser: node report.mjs, with these variables in the environment:
//   REPORT
//   CHROMIUM
//   PACKAGES  the folder whose node_modules hold playwright-core
//   WEB       the folder whose node_modules went into the report
// Exits with 77 if Chromium or packages are missing.
import assert from 'node:assert/strict';
import test, { after, before } from 'node:test';

import { needChromium, needPackages } from '../needed.mjs';

needChromium(process.env.CHROMIUM);
needPackages(process.env.WEB, 'build the target all');
needPackages(process.env.PACKAGES, 'build the target test_packages');
const { covered, difference, faint, launch, open, openView, overflow, pictures } =
  await import('./browser.mjs');

const TREES = ['ash', 'hornbeam_behind_the_garden_wall'];
const CLAIMS = 11;
const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

const PAPER = { width: 672, height: 986 };  // A4 without the margins, at 96 pixels per inch

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

const differences = (before, now) => now.map((picture, i) => difference(picture, before[i]));

function assertAllChanged(before, now) {
  const changes = differences(before, now);
  assert.ok(changes.length === 3 && changes.every((change) => change > 3), `changes ${changes}`);
}

function assertNoneChanged(before, now) {
  const changes = differences(before, now);
  assert.ok(changes.length === 3 && changes.every((change) => change < 1), `changes ${changes}`);
}

async function drag(page, view, dx, dy, options) {
  const box = await page.locator('.view').first().locator('canvas').nth(view).boundingBox();
  const x = box.x + box.width / 2, y = box.y + box.height / 2;
  await page.mouse.move(x, y);
  await page.mouse.down(options);
  await page.mouse.move(x + dx, y + dy, { steps: 4 });
  await page.mouse.up(options);
}

test('every view shows its shape, and nothing is fetched or complained of', async () => {
  const page = await open(browser);
  const [isotropic, uncontrolled, controlled] = (await openView(page)).map(covered);
  assert.ok(isotropic > 0.1 && isotropic < 0.8, `L&D covers ${isotropic}`);
  assert.ok(controlled > 0.1 && controlled < 0.8, `CTRLED covers ${controlled}`);
  assert.ok(uncontrolled > 0.01 && uncontrolled < 0.8, `UNCTRLED covers ${uncontrolled}`);
  assert.equal(await page.locator('.view').first().locator('img:visible').count(), 0);
  assert.deepEqual(page.faults, []);
});

test('what moves one view moves all, and Reset brings them back', async () => {
  const page = await open(browser);
  const start = await openView(page);
  for (const move of [
    () => drag(page, 2, 80, 20),
    () => drag(page, 0, 30, 30, { button: 'right' }),
    () => page.getByRole('button', { name: 'Zoom in' }).first().click(),
  ]) {
    const earlier = await pictures(page);
    await move();
    assertAllChanged(earlier, await pictures(page));
  }
  await page.getByRole('button', { name: 'Reset' }).first().click();
  assertNoneChanged(start, await pictures(page));
  assert.deepEqual(page.faults, []);
});

test('the shapes of another tree stay', async () => {
  const page = await open(browser);
  const start = await openView(page);
  await openView(page, 1);
  await page.getByRole('button', { name: 'Zoom in' }).nth(1).click();
  assertNoneChanged(start, await openView(page));
  assert.deepEqual(page.faults, []);
});

test('keys turn a view that has the focus', async () => {
  const page = await open(browser);
  const start = await openView(page);
  await page.locator('canvas').first().focus();
  await page.keyboard.press('ArrowRight');
  assertAllChanged(start, await pictures(page));
  await page.keyboard.press('Home');
  assertNoneChanged(start, await pictures(page));
});

test('the wheel scrolls the page until a view is clicked', async () => {
  const page = await open(browser);
  const start = await openView(page);
  const scrolled = () => page.evaluate(() => scrollY);
  const top = await scrolled();
  await page.locator('canvas').first().hover();
  await page.mouse.wheel(0, 60);
  await page.waitForFunction((y) => scrollY > y, top);
  assertNoneChanged(start, await pictures(page));

  await page.locator('canvas').first().click();
  const below = await scrolled();
  await page.mouse.wheel(0, 60);
  assertAllChanged(start, await pictures(page));
  assert.equal(await scrolled(), below);
});

test('a finger turns the shapes on a phone', async () => {
  const page = await open(browser, PHONE);
  const start = await openView(page);
  await page.locator('canvas').first().scrollIntoViewIfNeeded();
  const { x, y } = await page.locator('canvas').first().boundingBox();
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) =>
    session.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x: x + 100, y: y + 100 }]);
  for (const dx of [20, 40, 60, 80]) await touch('touchMove', [{ x: x + 100 + dx, y: y + 100 }]);
  await touch('touchEnd', []);
  assertAllChanged(start, await pictures(page));
});

test('a view out of sight lets go of its shapes and takes them up again', async () => {
  const page = await open(browser);
  const start = await openView(page);
  await page.evaluate(() => scrollTo(0, document.documentElement.scrollHeight));
  await page.waitForTimeout(200);
  await openView(page);
  await page.getByRole('button', { name: 'Zoom in' }).first().click();
  assertAllChanged(start, await pictures(page));
  assert.deepEqual(page.faults, []);
});

for (const options of [{}, PHONE]) {
  const width = options.viewport?.width ?? 1280;
  test(`nothing sticks out at ${width} pixels`, async () => {
    const page = await open(browser, options);
    await page.evaluate(() => document.querySelectorAll('details').forEach((d) => { d.open = true; }));
    assert.deepEqual(await overflow(page), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  });

  test(`the claims stand for both trees at ${width} pixels`, async () => {
    const page = await open(browser, options);
    assert.ok(await page.getByRole('region', { name: 'claims on each tree' }).evaluate(
      (region) => region.scrollWidth <= region.clientWidth));
    const marks = page.locator('.claims .mark:visible');
    assert.equal(await marks.count(), CLAIMS * TREES.length);
    // A wide table names the trees above their columns, a narrow one beside each mark.
    const named = await page.locator('.claims thead').isVisible()
      ? await page.locator('.claims thead a').allTextContents()
      : await page.locator('.claims tbody tr').first().locator('td[data-label]').evaluateAll(
        (cells) => cells.map((cell) => getComputedStyle(cell, '::before').content.match(/\w+/)[0]));
    assert.deepEqual(named, TREES);
  });

  test(`the contents lead to every tree at ${width} pixels`, async () => {
    const page = await open(browser, options);
    for (const name of TREES) {
      await page.getByRole('navigation').getByRole('link', { name, exact: true }).click();
      const heading = page.getByRole('heading', { name, exact: true, level: 2 });
      const { y } = await heading.boundingBox();
      assert.ok(y >= 0 && y < 200, `${name} is ${y} below the top`);
    }
  });
}

test('texts, tables and pictures stand without scripts', async () => {
  const page = await open(browser, { javaScriptEnabled: false });
  for (const text of ['13,368', '52,648', 'CTRLED', '35.382']) {
    assert.ok(await page.getByText(text).first().isVisible(), text);
  }
  assert.ok(await page.locator('table:visible').count() >= 4);
  assert.equal(await page.locator('canvas').count(), 0);
  assert.ok(await page.getByText('still pictures').first().isVisible());
  const images = page.locator('.frame img, .chart img:visible, .sheet img');
  assert.ok(await images.count() >= 15);
  for (const image of await images.all()) {
    assert.ok(await image.evaluate((element) => element.decode().then(() => element.naturalWidth > 0)));
    assert.ok(await image.isVisible());
  }
});

test('every tree tells where its band lies, the paper beside it', async () => {
  const page = await open(browser);
  assert.equal(await page.getByRole('heading', { name: 'Where the band lies' }).count(), TREES.length);
  const tables = page.getByRole('region', { name: 'Where the band lies' });
  assert.equal(await tables.count(), TREES.length);
  for (const table of await tables.all()) {
    for (const text of ['80–100%', '0–20%', '0 to 2 s', '18.2%']) {
      assert.ok(await table.getByText(text, { exact: true }).isVisible(), text);
    }
  }
  assert.equal(await page.getByAltText('as the band moves').count(), TREES.length);
});

test('without WebGL the still pictures stay, and the page says why', async () => {
  const page = await open(browser, {
    before: () => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...rest);
      };
    },
  });
  await page.getByText('needs WebGL, which this browser does not offer').first().waitFor();
  assert.ok(await page.locator('.frame img').first().isVisible());
  assert.equal(await page.locator('canvas').count(), 0);
});

test('on paper there are still pictures and no controls, within the margins', async () => {
  const page = await open(browser, { viewport: PAPER });
  await openView(page);
  await page.emulateMedia({ media: 'print' });
  assert.equal(await page.locator('canvas:visible, button:visible, nav:visible').count(), 0);
  const pictures = page.locator('.frame img, .sheet img');
  assert.ok(await pictures.count() > 3 * TREES.length);
  for (const picture of await pictures.all()) assert.ok(await picture.isVisible());
  assert.equal(await page.locator('details[open] .verdicts:visible').count(), TREES.length);
  assert.equal(await page.locator('details:not([open]):visible').count(), 0);
  assert.deepEqual(await overflow(page, 'none'), []);
});

for (const colorScheme of ['light', 'dark']) {
  test(`every text is readable in ${colorScheme} colours`, async () => {
    const page = await open(browser, { colorScheme });
    assert.deepEqual(await faint(page), []);
  });
}

test('what a screen reader needs is there', async () => {
  const page = await open(browser);
  await openView(page);
  for (const landmark of ['banner', 'main', 'navigation', 'contentinfo']) {
    assert.equal(await page.getByRole(landmark).count(), 1, landmark);
  }
  const faults = await page.evaluate(() => {
    const all = (selector) => [...document.querySelectorAll(selector)];
    const levels = all('h1, h2, h3, h4').map((heading) => Number(heading.tagName[1]));
    const ids = all('[id]').map((element) => element.id);
    return [
      ...all('img:not([alt]), img[alt=""]').map(() => 'a picture without alternative text'),
      ...all('table').filter((table) => !table.caption).map(() => 'a table without caption'),
      ...all('th:not([scope])').map((cell) => `a header without scope: ${cell.textContent}`),
      ...all('canvas:not([aria-label])').map(() => 'a canvas without a name'),
      ...all('a[href^="#"]').filter(({ hash }) => !ids.includes(hash.slice(1))).map(String),
      ...levels.filter((level, i) => i > 0 && level > levels[i - 1] + 1).map(() => 'a skipped level'),
      ...ids.filter((id, i) => ids.indexOf(id) !== i).map((id) => `the id ${id} twice`),
    ];
  });
  assert.deepEqual(faults, []);
});
