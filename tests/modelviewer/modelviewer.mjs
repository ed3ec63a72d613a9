// modelviewer.mjs PACKAGE ASSETS HDR OUT CHROMIUM SIZE LIST: serves modelviewer.html, model-viewer, the environment and the
// models to a headless Chromium, which draws each model and sends the picture and its camera back. Writes OUT/NAME-there.png,
// OUT/NAME.camera (options of gnomon), and OUT/NAME.glb: a binary model that has lights or cameras without them, or a chart.
// TONE (neutral) and EXPOSURE (1) are model-viewer's.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { chart } from './chart.mjs';

const [packageFolder, assets, hdr, out, chromium, size, list] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname);
const models = fs.readFileSync(list, 'utf8').split('\n').filter((line) => line && !line.startsWith('#')).map((line) => {
    const [name, file, theta, phi] = line.split(/\s+/);
    return { name, file: file.startsWith('chart:') ? file : path.join(assets, file), theta, phi };
});
const types = { '.html': 'text/html', '.js': 'text/javascript', '.gltf': 'model/gltf+json', '.glb': 'model/gltf-binary', '.png': 'image/png', '.jpg': 'image/jpeg' };

// A copy without lights and cameras, or null where the file has none.
function bare(file) {
    const bytes = fs.readFileSync(file);
    if (bytes.toString('latin1', 0, 4) !== 'glTF') return null;
    const length = bytes.readUInt32LE(12), json = JSON.parse(bytes.toString('utf8', 20, 20 + length));
    if (!json.extensions?.KHR_lights_punctual && !json.cameras) return null;
    delete json.cameras;
    delete json.extensions?.KHR_lights_punctual;
    json.extensionsUsed = (json.extensionsUsed ?? []).filter((name) => name !== 'KHR_lights_punctual');
    for (const node of json.nodes ?? []) {
        delete node.camera;
        delete node.extensions?.KHR_lights_punctual;
    }
    let text = Buffer.from(JSON.stringify(json));
    text = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
    const copy = Buffer.concat([bytes.subarray(0, 20), text, bytes.subarray(20 + length)]);
    copy.writeUInt32LE(copy.length, 8);
    copy.writeUInt32LE(text.length, 12);
    return copy;
}

for (const model of models) {
    const copy = model.file.startsWith('chart:') ? chart(model.file.slice(6).split(',')) : bare(model.file);
    if (!copy) continue;
    model.file = path.join(out, `${model.name}.glb`);
    fs.writeFileSync(model.file, copy);
}

function end(status, text) {
    if (text) console.error(text);
    browser?.kill();
    server.close();
    process.exitCode = status;
    setTimeout(() => {
        fs.rmSync(profile, { recursive: true, force: true });
        process.exit(status);
    }, 500);
}

// /package/.. is model-viewer, /models/NAME/.. the folder of that model, / this folder
function fileOf(url) {
    const [, root, ...rest] = decodeURIComponent(url.split('?')[0]).split('/');
    if (root === 'studio.hdr') return hdr;
    const model = root === 'models' && models.find((one) => one.name === rest[0]);
    const folder = model ? path.dirname(model.file) : root === 'package' ? packageFolder : here;
    const file = path.join(folder, model ? rest.slice(1).join('/') : root === 'package' ? rest.join('/') : root);
    return file.startsWith(folder) && fs.existsSync(file) && fs.statSync(file).isFile() ? file : null;
}

const server = http.createServer((request, response) => {
    const [, what, name] = request.url.split('/');
    if (request.method === 'POST') {
        const parts = [];
        request.on('data', (part) => parts.push(part));
        request.on('end', () => {
            const body = Buffer.concat(parts), known = models.some((model) => model.name === name);
            response.end();
            if (what === 'picture' && known) fs.writeFileSync(path.join(out, `${name}-there.png`), body);
            if (what === 'camera' && known) fs.writeFileSync(path.join(out, `${name}.camera`), `${body}\n`);
            if (what === 'fails') end(1, `modelviewer: ${body}`);
            if (what === 'done') end(0);
        });
        return;
    }
    const file = fileOf(request.url);
    response.writeHead(file ? 200 : 404, { 'Content-Type': types[path.extname(file ?? '')] ?? 'application/octet-stream' });
    response.end(file ? fs.readFileSync(file) : '');
});
const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'modelviewer-'));
let browser;
server.listen(0, '127.0.0.1', () => {
    const asked = models.map(({ name, file, theta, phi }) => ({ name, file: `${name}/${path.basename(file)}`, theta, phi }));
    browser = spawn(chromium, ['--headless=new', '--no-sandbox', '--disable-gpu-sandbox', '--use-gl=angle',
        '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', '--no-first-run',
        '--force-device-scale-factor=1', '--window-size=1600,1200', `--user-data-dir=${profile}`,
        `http://127.0.0.1:${server.address().port}/modelviewer.html?size=${size}&tone=${process.env.TONE ?? 'neutral'}&exposure=${process.env.EXPOSURE ?? 1}&models=${encodeURIComponent(JSON.stringify(asked))}`],
        { stdio: 'ignore' });
    browser.on('exit', (status) => { if (process.exitCode === undefined) end(1, `modelviewer: ${chromium} ended with status ${status}`); });
});
setTimeout(() => end(1, 'modelviewer: no end after 20 minutes'), 20 * 60 * 1000).unref();
