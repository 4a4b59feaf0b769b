// SPDX-License-Identifier: Apache-2.0
// A browser for the tests of a report, and what they measure of a page.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const { CHROMIUM, PACKAGES, REPORT } = process.env;
const { chromium } = createRequire(`${PACKAGES}/`)('playwright-core');

const FLAGS = [
  '--headless', '--no-sandbox', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
];

export const launch = () => chromium.launch({ executablePath: CHROMIUM, args: FLAGS });

/** Opens the report in its own context; `page.faults` collects what a page must not do. */
export async function open(browser, { before, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  page.faults = [];
  page.on('console', (message) => page.faults.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => page.faults.push(`error: ${error.message}`));
  const report = pathToFileURL(REPORT).href;
  page.on('request', (request) => {
    const url = request.url().replace(/#.*/, '');
    if (url !== report && !url.startsWith('data:')) page.faults.push(`request: ${url}`);
  });
  if (before) await page.addInitScript(before);
  await page.goto(report);
  return page;
}

/** Small copies of a view's canvases: three numbers of colour and one of opacity per pixel. */
const thumbnails = (page, tree = 0) => page.evaluate(async (tree) => {
  const SIZE = 48;
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const canvases = document.querySelectorAll('.view')[tree].querySelectorAll('canvas');
  return [...canvases].map((canvas) => {
    const small = Object.assign(document.createElement('canvas'), { width: SIZE, height: SIZE });
    const context = small.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, 0, 0, SIZE, SIZE);
    return [...context.getImageData(0, 0, SIZE, SIZE).data];
  });
}, tree);

/** The part of a thumbnail that a shape covers. */
export const covered = (pixels) =>
  pixels.filter((value, i) => i % 4 === 3 && value > 0).length / (pixels.length / 4);

/** How much two thumbnails differ: the mean over the numbers that are positive in either. */
export function difference(a, b) {
  const changes = a.map((value, i) => Math.abs(value - b[i]));
  const shown = a.filter((value, i) => value > 0 || b[i] > 0).length;
  return changes.reduce((sum, change) => sum + change, 0) / Math.max(1, shown);
}

/** Scrolls to the view of a tree and returns thumbnails once each canvas shows something. */
export async function openView(page, tree = 0) {
  await page.locator('.view').nth(tree).scrollIntoViewIfNeeded();
  for (let wait = 0; wait < 600; ++wait) {
    const pictures = await thumbnails(page, tree);
    if (pictures.length === 3 && pictures.every((pixels) => covered(pixels) > 0)) return pictures;
    await page.waitForTimeout(100);
  }
  throw new Error('no shape appeared in a minute');
}

export { thumbnails as pictures };

/** What sticks out of the window, except for hidden elements and those that `scrolls` matches. */
export const overflow = (page, scrolls = '.scroll, .chart') => page.evaluate((scrolls) => {
  const width = document.documentElement.clientWidth;
  const may = (element) => element.closest('.skip, .symbols, caption') || element.closest(scrolls);
  return [...document.querySelectorAll('body *')]
    .filter((element) => !may(element) && element.getBoundingClientRect().right > width + 1)
    .map((element) => `${element.tagName}.${element.className} ends at ` +
      `${element.getBoundingClientRect().right} of ${width}`);
}, scrolls);

/** Texts whose contrast with the page is below 4.5 to 1. */
export const faint = (page) => page.evaluate(() => {
  const luminance = (color) => {
    const [r, g, b] = color.match(/[\d.]+/g).map((part) => {
      const value = part / 255;
      return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const paper = luminance(getComputedStyle(document.body).backgroundColor);
  const found = new Set();
  const texts = 'p, a, th, td, li, dt, dd, span, figcaption, button, caption, summary';
  for (const element of document.querySelectorAll(texts)) {
    const { color } = getComputedStyle(element);
    const ink = luminance(color);
    const contrast = (Math.max(paper, ink) + 0.05) / (Math.min(paper, ink) + 0.05);
    if (contrast < 4.5) found.add(`${element.tagName}.${element.className} ${color} ${contrast}`);
  }
  return [...found];
});
