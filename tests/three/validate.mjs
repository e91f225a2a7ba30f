// SPDX-License-Identifier: MIT
// What Khronos' validator says of glTF files, as JSON: node validate.mjs FILE...
// {"<file>": {"errors": 0, "warnings": 0, "messages": ["<code> <pointer>: <message>", ...]}}; infos are not listed.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

const answer = {};
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  answer[file] = {
    errors: report.issues.numErrors,
    warnings: report.issues.numWarnings,
    messages: report.issues.messages
      .filter((message) => message.severity < 2)
      .map((message) => `${message.code} ${message.pointer}: ${message.message}`),
  };
}
console.log(JSON.stringify(answer));
