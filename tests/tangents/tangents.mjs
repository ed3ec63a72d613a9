// tangents.mjs PACKAGE FILE.bin..: what tool_tangents wrote against mikktspace.c, the npm package of it. Exit status 1: under 99.9 %
// of the corners of a mesh agree within a degree, and in the orientation.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const [folder, ...files] = process.argv.slice(2);
const { generateTangents } = createRequire(import.meta.url)(folder);
let missed = false;
for (const file of files) {
    const bytes = fs.readFileSync(file), count = bytes.readUInt32LE(0);
    const take = (at, size) => Float32Array.from({ length: count * size }, (_, i) => bytes.readFloatLE(4 + 4 * (12 * Math.floor(i / size) + at + i % size)));
    const made = take(8, 4), reference = generateTangents(take(0, 3), take(3, 3), take(6, 2));
    let agree = 0, worst = 0, flipped = 0;
    for (let i = 0; i < count; i++) {
        const a = made.subarray(4 * i, 4 * i + 4), b = reference.subarray(4 * i, 4 * i + 4);
        const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2], degrees = Math.acos(Math.min(Math.max(cosine, -1), 1)) * 180 / Math.PI;
        const same = a[3] === -b[3]; // v points down in glTF
        flipped += !same;
        worst = Math.max(worst, degrees);
        agree += same && degrees < 1;
    }
    const share = 100 * agree / count;
    console.log(`${path.basename(file, '.bin').padEnd(12)} ${count} corners, ${share.toFixed(2)} % agree within a degree; worst ${worst.toFixed(3)} degrees, ${flipped} of the other orientation`);
    if (!(share >= 99.9)) missed = true;
}
process.exit(missed ? 1 : 0);
