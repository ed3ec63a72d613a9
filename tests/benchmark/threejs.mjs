// threejs.mjs THREE_FOLDER SCENES OUT CHROMIUM TYPE BIAS NORMAL_BIAS: serves threejs.html, three.js and the
// scenes to a headless Chromium, which renders each and sends its visibility back; writes OUT/NAME.pfm.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';

const [three, scenes, out, chromium, type, bias, normalBias] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname);
const names = fs.readdirSync(scenes).filter((file) => file.endsWith('.glb')).map((file) => file.slice(0, -4));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript' };

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

// /three/.. is the package, /scenes/.. the scenes, / this folder
function fileOf(url) {
    const [, root, ...rest] = decodeURIComponent(url.split('?')[0]).split('/');
    const folder = { three, scenes }[root];
    const file = path.join(folder ?? here, folder ? rest.join('/') : root);
    return file.startsWith(folder ?? here) && fs.existsSync(file) && fs.statSync(file).isFile() ? file : null;
}

// floats of grey, the lowest row first
function writePfm(name, body) {
    const [width, height] = name.startsWith('soft-') || name.startsWith('thin-') ? [480, 360] : [640, 480];
    if (body.length !== 4 * width * height) return end(1, `${name}: ${body.length} bytes came`);
    fs.writeFileSync(path.join(out, `${name}.pfm`), Buffer.concat([Buffer.from(`Pf\n${width} ${height}\n-1.0\n`), body]));
}

const server = http.createServer((request, response) => {
    const what = request.url.split('/');
    if (request.method === 'POST') {
        const parts = [];
        request.on('data', (part) => parts.push(part));
        request.on('end', () => {
            const body = Buffer.concat(parts);
            response.end();
            if (what[1] === 'picture' && names.includes(what[2])) writePfm(what[2], body);
            if (what[1] === 'says') console.log(body.toString());
            if (what[1] === 'fails') end(1, `threejs: ${body}`);
            if (what[1] === 'done') end(0);
        });
        return;
    }
    const file = fileOf(request.url);
    response.writeHead(file ? 200 : 404, { 'Content-Type': types[path.extname(file ?? '')] ?? 'application/octet-stream' });
    response.end(file ? fs.readFileSync(file) : '');
});
const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'threejs-'));
let browser;
server.listen(0, '127.0.0.1', () => {
    const list = encodeURIComponent(names.join(','));
    browser = spawn(chromium, ['--headless=new', '--no-sandbox', '--disable-gpu-sandbox', '--use-gl=angle',
        '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', '--no-first-run',
        `--user-data-dir=${profile}`,
        `http://127.0.0.1:${server.address().port}/threejs.html?type=${type}&bias=${bias}&normalBias=${normalBias}&scenes=${list}`],
        { stdio: 'ignore' });
    browser.on('exit', (status) => { if (process.exitCode === undefined) end(1, `threejs: ${chromium} ended with status ${status}`); });
});
setTimeout(() => end(1, 'threejs: no end after 20 minutes'), 20 * 60 * 1000).unref();
