// SPDX-License-Identifier: Apache-2.0
// Checks for what a test needs. If it is missing, the test says so and exits with 77: ctest skips it.
import { existsSync, readFileSync } from 'node:fs';

function skip(why) {
  console.log(`SKIPPED: ${why.trim()}`);
  process.exit(77);
}

/** Needs Chromium at this path. */
export function needChromium(path = '') {
  if (!existsSync(path)) skip(`no Chromium at '${path}'; apt-get install chromium`);
}

/** Needs the npm packages that the build puts into a folder, all of them: npm writes this file last. */
export function needPackages(folder, remedy) {
  if (existsSync(`${folder}/node_modules/.package-lock.json`)) return;
  const without = `${folder}/without.txt`;
  skip(existsSync(without) ? readFileSync(without, 'utf8') : `no npm packages in '${folder}'; ${remedy}`);
}
