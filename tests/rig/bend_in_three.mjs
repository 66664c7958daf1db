// Loads rigged .glb files in three.js, turns the joints of their limbs and measures what follows.
// usage: node bend_in_three.mjs CHROMIUM MODULES ALL FILE.glb...
//   MODULES  the folder node_modules with three
//   ALL      1: each joint of a limb that has a bone below it; 0: the first of each limb
// Each file's picture, at rest and with each limb bent, goes beside it as .png. The exit status counts the files with faults.
import fs from 'node:fs';
import path from 'node:path';
import { chromium } from 'playwright-core';

const [executablePath, modules, all, ...files] = process.argv.slice(2);
const HOST = 'http://bend.test/';
const PAGE = `<!doctype html><script type="importmap">{"imports": {
  "three": "${HOST}three/build/three.module.js", "three/addons/": "${HOST}three/examples/jsm/"}}</script>
  <canvas id="sheet"></canvas>
  <script type="module">
    import * as THREE from 'three';
    import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
    window.THREE = THREE;
    window.load = bytes => new Promise((done, failed) => new GLTFLoader().parse(bytes, '', done, failed));
    window.ready = true;
  </script>`;

// Runs in the page. What is asked for: see check in main.
async function measure({ encoded, all }) {
  const THREE = window.THREE, ANGLE = Math.PI / 4, LEAST_HEIGHT = 1e-4, TILE = 360, COLUMNS = 5;
  const { scene } = await window.load(Uint8Array.from(atob(encoded), c => c.charCodeAt(0)).buffer);
  const skins = [];
  scene.traverse(o => { if (o.isSkinnedMesh) skins.push(o); });
  if (skins.length !== 1) return { faults: [`${skins.length} skinned meshes`], rows: [] };
  const mesh = skins[0], bones = mesh.skeleton.bones, geometry = mesh.geometry, faults = [];
  const count = geometry.attributes.position.count, index = geometry.index.array, x = new THREE.Vector3();
  const place = into => {
    scene.updateMatrixWorld(true);
    mesh.skeleton.update();
    for (let v = 0; v < count; ++v) {
      mesh.getVertexPosition(v, x).applyMatrix4(mesh.matrixWorld);
      into.set([x.x, x.y, x.z], 3 * v);
    }
    return into;
  };
  const rest = place(new Float64Array(3 * count)), bent = new Float64Array(3 * count);
  const at = (points, v, into) => into.set(points[3 * v], points[3 * v + 1], points[3 * v + 2]);
  const box = new THREE.Box3();
  for (let v = 0; v < count; ++v) box.expandByPoint(at(rest, v, x));
  const diagonal = box.getSize(new THREE.Vector3()).length();
  const stored = geometry.attributes.position;
  for (let v = 0; v < count; ++v)
    if (at(rest, v, x).distanceTo(new THREE.Vector3().fromBufferAttribute(stored, v).applyMatrix4(mesh.matrixWorld)) > 1e-5 * diagonal) {
      faults.push('the rest pose is not the mesh');
      break;
    }

  // Of each vertex the bone that it follows most; per bone the limb it belongs to.
  const limbOf = bone => /^limb\d+(?=_)/.exec(bone.name)?.[0] + (/_[LR]$/.exec(bone.name)?.[0] ?? '');
  const strongest = [], skinIndex = geometry.attributes.skinIndex, skinWeight = geometry.attributes.skinWeight;
  for (let v = 0; v < count; ++v) {
    let k = 0;
    for (let i = 1; i < 4; ++i) if (skinWeight.getComponent(v, i) > skinWeight.getComponent(v, k)) k = i;
    strongest.push(bones[skinIndex.getComponent(v, k)]);
  }
  const limbs = new Map();
  for (const bone of bones) if (bone.name.startsWith('limb')) limbs.set(limbOf(bone), [...limbs.get(limbOf(bone)) ?? [], bone]);

  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(TILE, TILE);
  const world = new THREE.Scene();
  world.background = new THREE.Color(0xffffff);
  const light = new THREE.DirectionalLight(0xffffff, 2.5), middle = box.getCenter(new THREE.Vector3());
  world.add(scene, new THREE.AmbientLight(0xffffff, 0.7), light);
  const camera = new THREE.PerspectiveCamera(30, 1, 0.01 * diagonal, 10 * diagonal);
  camera.position.copy(middle).addScaledVector(new THREE.Vector3(0.6, 0.5, 1).normalize(), 2.1 * diagonal);
  camera.lookAt(middle);
  light.position.copy(camera.position).add(new THREE.Vector3(-diagonal, diagonal, 0));
  light.target.position.copy(middle);
  world.add(light.target);
  mesh.frustumCulled = false;
  mesh.material = new THREE.MeshStandardMaterial({ color: 0xb0b8c8, roughness: 0.7, side: THREE.FrontSide });
  const sheet = document.getElementById('sheet'), tiles = 1 + limbs.size, ink = sheet.getContext('2d');
  sheet.width = TILE * Math.min(tiles, COLUMNS);
  sheet.height = TILE * Math.ceil(tiles / COLUMNS);
  let tile = 0;
  const draw = text => {
    renderer.render(world, camera);
    const left = TILE * (tile % COLUMNS), top = TILE * Math.floor(tile / COLUMNS);
    ink.drawImage(renderer.domElement, left, top, TILE, TILE);
    ink.font = '16px sans-serif';
    ink.fillText(text, left + 8, top + 20);
    ++tile;
  };
  draw('rest');

  const p = [0, 1, 2].map(() => new THREE.Vector3()), q = [0, 1, 2].map(() => new THREE.Vector3());
  const normal = (t, into) => into.crossVectors(t[1].clone().sub(t[0]), t[2].clone().sub(t[0]));
  const n = new THREE.Vector3(), m = new THREE.Vector3(), rows = [];
  for (const [limb, chain] of limbs) {
    const tip = chain[chain.length - 1].getWorldPosition(new THREE.Vector3()), turning = chain.filter(bone => bone.children.length > 0);
    if (turning.length === 0) {
      rows.push({ limb, joint: '-', fault: 'no joint to bend' });
      continue;
    }
    let tipVertex = 0, least = Infinity;
    for (let v = 0; v < count; ++v) {
      const d = at(rest, v, x).distanceTo(tip);
      if (limbOf(strongest[v]) === limb && d < least) [tipVertex, least] = [v, d];
    }
    for (const bone of all ? turning : turning.slice(0, 1)) {
      const joint = bone.getWorldPosition(new THREE.Vector3()), own = bone.quaternion.clone();
      const weight = new Float64Array(count), below = new Set();
      bone.traverse(o => below.add(o));
      for (let v = 0; v < count; ++v)
        for (let i = 0; i < 4; ++i) if (below.has(bones[skinIndex.getComponent(v, i)])) weight[v] += skinWeight.getComponent(v, i);
      const row = { limb, joint: bone.name, tip: Infinity, others: 0, over: 0, far: 0 };
      for (let turn = 0; turn < 6; ++turn) {
        const axis = new THREE.Vector3().setComponent(turn >> 1, 1), angle = turn & 1 ? -ANGLE : ANGLE;
        bone.quaternion.copy(own).multiply(new THREE.Quaternion().setFromAxisAngle(axis, angle));
        place(bent);
        if (bone === turning[0] && turn === 4) draw(limb);
        // What lies r from the axis moves by 2 r sin(22.5°).
        const arm = at(rest, tipVertex, x).clone().sub(joint), r = arm.addScaledVector(axis, -arm.dot(axis)).length();
        const moved = at(bent, tipVertex, q[0]).distanceTo(at(rest, tipVertex, p[0]));
        if (r > 0.02 * diagonal) row.tip = Math.min(row.tip, moved / (2 * r * Math.sin(ANGLE / 2)));
        for (let v = 0; v < count; ++v)
          if (limbOf(strongest[v]) !== limb && strongest[v].name.startsWith('limb'))
            row.others = Math.max(row.others, at(bent, v, q[0]).distanceTo(at(rest, v, p[0])) / diagonal);
        for (let f = 0; f < index.length; f += 3) {
          const w = (weight[index[f]] + weight[index[f + 1]] + weight[index[f + 2]]) / 3;
          if (w === 0) continue;
          for (let k = 0; k < 3; ++k) {
            at(rest, index[f + k], p[k]);
            at(bent, index[f + k], q[k]);
          }
          normal(p, n).applyAxisAngle(axis, w * angle);
          // Slivers that nobody can see have no side to turn.
          const longest = Math.max(p[0].distanceTo(p[1]), p[1].distanceTo(p[2]), p[2].distanceTo(p[0]));
          if (n.length() < LEAST_HEIGHT * diagonal * longest) continue;
          if (n.dot(normal(q, m)) >= 0) continue;
          ++row.over;
          row.far = Math.max(row.far, p[0].clone().add(p[1]).add(p[2]).divideScalar(3).distanceTo(joint) / diagonal);
        }
      }
      bone.quaternion.copy(own);
      rows.push(row);
    }
  }
  place(bent);
  return { faults, rows, picture: sheet.toDataURL('image/png') };
}

const browser = await chromium.launch({
  executablePath, headless: true, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
let failed = 0;
try {
  for (const file of files) {
    const page = await browser.newPage(), errors = [];
    page.setDefaultTimeout(600000);
    page.on('console', message => { if (message.type() === 'error') errors.push(message.text()); });
    page.on('pageerror', error => errors.push(error.message));
    await page.route('**/*', route => {
      const name = decodeURIComponent(new URL(route.request().url()).pathname).slice(1);
      if (name === '') return route.fulfill({ contentType: 'text/html', body: PAGE });
      if (!name.startsWith('three/')) return route.fulfill({ status: 204 });
      return route.fulfill({ contentType: 'text/javascript', body: fs.readFileSync(path.join(modules, name)) });
    });
    await page.goto(HOST);
    await page.waitForFunction(() => window.ready);
    const encoded = fs.readFileSync(file).toString('base64');
    const { faults, rows, picture } = await page.evaluate(measure, { encoded, all: all === '1' });
    if (picture) fs.writeFileSync(file.replace(/\.glb$/, '.png'), Buffer.from(picture.split(',')[1], 'base64'));
    faults.push(...errors);
    if (rows.length === 0) faults.push('no limb');
    for (const row of rows) {
      if (row.fault) faults.push(`${row.limb}: ${row.fault}`);
      // A quarter of what turns as a whole: the tip of a short limb follows two bones.
      if (row.tip < 0.25) faults.push(`${row.joint}: the tip moves by ${row.tip.toFixed(2)} of the turn`);
      if (row.others > 0.01) faults.push(`${row.joint}: another limb moves by ${row.others.toFixed(3)} of the diagonal`);
      if (row.far > 0.1) faults.push(`${row.joint}: ${row.over} faces turn over, the farthest ${row.far.toFixed(3)} of the diagonal away`);
    }
    const most = (key, start) => rows.reduce((m, row) => Math[key === 'tip' ? 'min' : 'max'](m, row[key] ?? start), start);
    console.log(`${path.basename(file)}: ${rows.length} joints, tips move by ${most('tip', 9).toFixed(2)} or more of the turn, other limbs by ` +
      `${most('others', 0).toFixed(4)} of the diagonal, faces turned over ${rows.reduce((s, row) => s + (row.over ?? 0), 0)}, ` +
      `farthest ${most('far', 0).toFixed(3)}: ${faults.length ? 'FAULTS' : 'ok'}`);
    for (const fault of faults) console.log(`  ${fault}`);
    failed += faults.length ? 1 : 0;
    await page.close();
  }
} finally {
  await browser.close();
}
process.exit(failed);
