// SPDX-License-Identifier: Apache-2.0
// What a test needs and may lack: it ends with 77 then, which ctest takes for skipped, and says why.
import { existsSync, readFileSync } from 'node:fs';

function skip(why) {
  console.log(`SKIPPED: ${why.trim()}`);
  process.exit(77);
}

/** Chromium, by its path. */
export function needChromium(path = '') {
  if (!existsSync(path)) skip(`no Chromium at '${path}'; apt-get install chromium`);
}

/** The packages in a folder that the build fills, all of them: npm writes this file last. */
export function needPackages(folder, remedy) {
  if (existsSync(`${folder}/node_modules/.package-lock.json`)) return;
  const without = `${folder}/without.txt`;
  skip(existsSync(without) ? readFileSync(without, 'utf8') : `no packages of npm in '${folder}'; ${remedy}`);
}
