// A chart of spheres as a binary glTF file: a row for each kind of material, a column for each roughness.
const columns = [0, 0.25, 0.5, 0.75, 1], segments = 48, step = 2.2;
const rows = [
    { name: 'white', baseColorFactor: [0.9, 0.9, 0.9, 1], metallicFactor: 0 },
    { name: 'skin', baseColorFactor: [0.72, 0.42, 0.3, 1], metallicFactor: 0 },
    { name: 'black', baseColorFactor: [0.01, 0.01, 0.01, 1], metallicFactor: 0 },
    { name: 'silver', baseColorFactor: [0.97, 0.96, 0.92, 1], metallicFactor: 1 },
    { name: 'copper', baseColorFactor: [0.93, 0.62, 0.52, 1], metallicFactor: 1 },
    { name: 'coat', baseColorFactor: [0.5, 0.02, 0.02, 1], metallicFactor: 0, extensions: { KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatRoughnessFactor: 0.03 } } },
    { name: 'glass', baseColorFactor: [0.6, 0.8, 0.9, 1], metallicFactor: 0, extensions: { KHR_materials_transmission: { transmissionFactor: 1 } } },
];

function sphere() {
    const points = [], corners = [], width = segments + 1;
    for (let y = 0; y <= segments / 2; y++)
        for (let x = 0; x <= segments; x++) {
            const down = Math.PI * y / (segments / 2), around = 2 * Math.PI * x / segments;
            points.push(Math.sin(down) * Math.sin(around), Math.cos(down), Math.sin(down) * Math.cos(around));
        }
    for (let y = 0; y < segments / 2; y++)
        for (let x = 0; x < segments; x++) {
            const a = y * width + x, b = a + width;
            if (y > 0) corners.push(a, b + 1, a + 1);
            if (y < segments / 2 - 1) corners.push(a, b, b + 1);
        }
    return { points: Buffer.from(new Float32Array(points).buffer), corners: Buffer.from(new Uint16Array(corners).buffer) };
}

function chunk(type, bytes, fill) {
    const padded = Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, fill)]), head = Buffer.alloc(8);
    head.writeUInt32LE(padded.length, 0);
    head.write(type, 4, 'latin1');
    return Buffer.concat([head, padded]);
}

export function chart(names) {
    const { points, corners } = sphere(), materials = [], meshes = [], nodes = [], extensions = new Set();
    rows.filter((row) => names.includes(row.name)).forEach((row, y) => columns.forEach((roughness, x) => {
        const { name, extensions: more, ...pbr } = row;
        for (const extension of Object.keys(more ?? {})) extensions.add(extension);
        materials.push({ name: `${name} ${roughness}`, pbrMetallicRoughness: { ...pbr, roughnessFactor: roughness }, ...(more && { extensions: more }) });
        meshes.push({ primitives: [{ attributes: { POSITION: 0, NORMAL: 0 }, indices: 1, material: materials.length - 1 }] });
        nodes.push({ mesh: meshes.length - 1, translation: [step * x, -step * y, 0] });
    }));
    if (names.includes('backdrop')) { // behind what is transparent: a flat grey sphere
        materials.push({ name: 'backdrop', pbrMetallicRoughness: { baseColorFactor: [0.3, 0.3, 0.3, 1], metallicFactor: 0 } });
        meshes.push({ primitives: [{ attributes: { POSITION: 0, NORMAL: 0 }, indices: 1, material: materials.length - 1 }] });
        nodes.push({ mesh: meshes.length - 1, translation: [2 * step, 0, -2], scale: [8, 4, 0.02] });
    }
    const json = {
        asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: nodes.map((_, i) => i) }], nodes, meshes, materials,
        ...(extensions.size && { extensionsUsed: [...extensions] }),
        buffers: [{ byteLength: points.length + corners.length }],
        bufferViews: [{ buffer: 0, byteLength: points.length }, { buffer: 0, byteOffset: points.length, byteLength: corners.length }],
        accessors: [{ bufferView: 0, componentType: 5126, count: points.length / 12, type: 'VEC3', min: [-1, -1, -1], max: [1, 1, 1] },
            { bufferView: 1, componentType: 5123, count: corners.length / 2, type: 'SCALAR' }],
    };
    const body = Buffer.concat([chunk('JSON', Buffer.from(JSON.stringify(json)), ' '), chunk('BIN\0', Buffer.concat([points, corners]), 0)]);
    const head = Buffer.from('glTF\0\0\0\0\0\0\0\0', 'latin1');
    head.writeUInt32LE(2, 4);
    head.writeUInt32LE(12 + body.length, 8);
    return Buffer.concat([head, body]);
}
