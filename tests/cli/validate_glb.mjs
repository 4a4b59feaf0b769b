// SPDX-License-Identifier: Apache-2.0
// node validate_glb.mjs FOLDER FILE... checks every FILE with the gltf-validator installed in FOLDER.
// Exits with 0 if no file has an error or a warning, 1 if one has, and 77 if there is no validator.
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [folder, ...files] = process.argv.slice(2);
const require = createRequire(resolve(folder, "package.json"));
let validator;
try {
  validator = require("gltf-validator");
} catch (error) {
  console.error(`no gltf-validator in ${folder}: ${error.code}`);
  process.exit(77);
}

for (const file of files) {
  const { issues } = await validator.validateBytes(new Uint8Array(await readFile(file)));
  const { numErrors, numWarnings, messages } = issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
  for (const { severity, code, message, pointer } of messages) {
    if (severity < 2) console.log(`  ${code} ${pointer ?? ""} ${message}`);
  }
  if (numErrors + numWarnings > 0) process.exitCode = 1;
}
if (files.length === 0) throw new Error("no files to check");
