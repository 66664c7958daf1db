// Looks, picks, measures and switches on a page, as a person would. usage: node drive_page.mjs CHROMIUM PAGE FINE_PAGE
import assert from 'node:assert/strict';
import { chromium } from 'playwright-core';

const [executablePath, path, finePath] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath, headless: true, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});

async function open(options, file = path) {
  const context = await browser.newContext({ offline: true, ...options });
  const page = await context.newPage(), faults = [];
  page.on('console', message => { if (message.type() === 'error') faults.push(message.text()); });
  page.on('pageerror', error => faults.push(error.message));
  page.on('request', request => { if (!/^(file|data):/.test(request.url())) faults.push(`request of ${request.url()}`); });
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => window.mspskel?.state().frames > 0, null, { timeout: 60000 });
  return { page, faults };
}
const state = page => page.evaluate(() => window.mspskel.state());
const project = (page, node) => page.evaluate(n => window.mspskel.project(n), node);

// The middle node of the branch whose middle is farthest from other branches' nodes on the screen.
async function clearNode(page, count) {
  return page.evaluate(wanted => {
    const m = window.mspskel, all = [];
    for (let b = 0; b < m.branchCount; ++b) for (const n of m.branchNodes(b)) all.push({ b, n, at: m.project(n) });
    const best = [];
    for (let b = 0; b < m.branchCount; ++b) {
      const own = m.branchNodes(b), n = own[Math.floor(own.length / 2)], at = m.project(n);
      const away = Math.min(...all.filter(x => x.b !== b).map(x => Math.hypot(x.at.x - at.x, x.at.y - at.y)));
      best.push({ branch: b, node: n, at, away });
    }
    return best.sort((x, y) => y.away - x.away).slice(0, wanted);
  }, count);
}

try {
  const { page, faults } = await open({ viewport: { width: 1280, height: 800 }, colorScheme: 'light' });
  assert.equal((await state(page)).theme, 'light');
  assert.match(await page.textContent('#verdict'), /Topology proved/);
  assert.ok(await page.isVisible('#legend'), 'a legend');

  const [first, second] = await clearNode(page, 2);
  await page.mouse.move(first.at.x, first.at.y);
  await page.waitForSelector('#tip:not([hidden])');
  assert.match(await page.textContent('#tip'), new RegExp(`Branch ${first.branch}, length .*Radius .*MSP `, 's'));
  await page.mouse.click(first.at.x, first.at.y);
  assert.equal((await state(page)).picked.branch, first.branch, 'a click on the skeleton picks its branch');
  assert.match(await page.textContent('#card'), new RegExp(`Branch ${first.branch}.*Least radius`, 's'));

  await page.keyboard.press('m');
  for (const { at } of [first, second]) await page.mouse.click(at.x, at.y);
  const { measured } = await state(page);
  assert.ok(measured && measured.length >= measured.straight && measured.straight > 0, 'the way is no shorter than the straight line');
  await page.keyboard.press('Escape');

  await page.keyboard.press('2');
  assert.equal((await state(page)).layers.skeleton, false);
  const hit = await page.evaluate(n => window.mspskel.project(n), first.node);
  await page.mouse.click(hit.x, hit.y);
  const picked = await state(page);
  assert.ok(picked.picked.vertex >= 0 && picked.slice > 0, 'a click on the surface picks a vertex with its slice');
  assert.match(await page.textContent('#card'), /Part.*Follows/s, 'and tells its part and joint');
  await page.keyboard.press('2');
  for (const layer of ['surface', 'radius', 'mesh']) {
    const before = (await state(page)).layers[layer];
    await page.click(`label:has([data-layer="${layer}"])`);
    assert.equal((await state(page)).layers[layer], !before, `switch of ${layer}`);
    await page.click(`label:has([data-layer="${layer}"])`);
  }

  for (const mode of ['error', 'radius', 'branch', 'node', 'part', 'plain', 'msp']) {
    await page.click(`[data-mode="${mode}"]`);
    assert.equal((await state(page)).mode, mode);
    assert.equal(await page.isVisible('#legend'), mode !== 'plain');
  }

  // Each limb's first joint that has another below it moves the limb's tip, and no other limb.
  const limbs = await page.evaluate(() => {
    const m = window.mspskel, limb = name => name.startsWith('limb') ? name.split('_')[0] + (/_[LR]$/.exec(name) ?? '') : '';
    const rest = Array.from({ length: m.vertexCount }, (_, v) => m.position(v));
    const own = Array.from({ length: m.vertexCount }, (_, v) => limb(m.jointNames[m.joint(v)]));
    return m.jointNames.flatMap((name, j) => {
      if (!limb(name) || limb(m.jointNames[m.jointParents[j]]) || !m.jointParents.includes(j)) return [];
      m.bend(j, 'x', 45);
      let tip = 0, others = 0;
      rest.forEach((p, v) => {
        const moved = Math.hypot(...m.position(v).map((x, k) => x - p[k])) / 2;  // diagonals
        if (own[v] === limb(name)) tip = Math.max(tip, moved);
        else if (own[v]) others = Math.max(others, moved);
      });
      m.bend(j, 'x', 0);
      return [{ name, tip, others }];
    });
  });
  assert.ok(limbs.length >= 4, 'limbs to bend');
  for (const { name, tip, others } of limbs) {
    assert.ok(tip > 0.02, `${name} moves its tip by ${tip}`);
    assert.ok(others < 0.01, `${name} moves other limbs by ${others}`);
  }
  const start = await page.evaluate(() => window.mspskel.position(0));
  await page.selectOption('#joint', '0');
  await page.selectOption('#axis', 'z');
  await page.fill('#angle', '30');
  assert.notDeepEqual(await page.evaluate(() => window.mspskel.position(0)), start, 'the slider bends');
  await page.click('#straight');
  (await page.evaluate(() => window.mspskel.position(0))).forEach((x, k) => assert.ok(Math.abs(x - start[k]) < 1e-5, 'straight again'));
  await page.keyboard.press('Escape');

  await page.click('[data-tab="branches"]');
  const rows = () => page.$$eval('#branches tbody tr', list => list.map(row => Number(row.dataset.branch)));
  const all = await rows();
  assert.equal(all.length, await page.evaluate(() => window.mspskel.branchCount));
  await page.fill('#filter', 'end');
  const ends = await rows();
  assert.ok(ends.length > 0 && ends.length < all.length, 'the filter leaves the free ends');
  await page.click('#branches tbody tr:last-child');
  assert.equal((await state(page)).picked.branch, ends[ends.length - 1], 'a row picks its branch');
  assert.equal(await page.getAttribute('#branches tr[aria-selected="true"]', 'data-branch'), String(ends[ends.length - 1]));
  await page.fill('#filter', '');

  await page.click('[data-tab="charts"]');
  assert.equal(await page.locator('.chart svg').count(), 4);
  await page.click('[data-tab="report"]');
  assert.ok(await page.locator('.remark').count() >= 2);

  const camera = (await state(page)).camera;
  await page.focus('#canvas');  // arrows that a tab or a slider has are its own
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction(old => window.mspskel.state().camera[0] !== old[0], camera);
  await page.keyboard.press('r');
  const again = (await state(page)).camera;
  camera.forEach((x, k) => assert.ok(Math.abs(x - again[k]) < 1e-6, 'R shows all again'));
  assert.deepEqual(faults, []);

  const phone = await open({ viewport: { width: 390, height: 844 }, colorScheme: 'dark', hasTouch: true, isMobile: true });
  assert.equal((await state(phone.page)).theme, 'dark');
  const [node] = await clearNode(phone.page, 1);
  const at = await project(phone.page, node.node);
  await phone.page.touchscreen.tap(at.x, at.y);
  assert.equal((await state(phone.page)).picked.branch, node.branch, 'a tap picks');
  assert.ok(await phone.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing sticks out');
  await phone.page.waitForFunction(() => {
    const top = document.getElementById('title').getBoundingClientRect().bottom, bottom = document.getElementById('card').getBoundingClientRect().top;
    return Array.from({ length: window.mspskel.nodeCount }, (_, n) => window.mspskel.project(n).y).every(y => y > top && y < bottom);
  });  // the card hides nothing of the skeleton
  assert.deepEqual(phone.faults, []);

  // A mesh finer than what moves well without a graphics card moves coarsely, and rests finely.
  const fine = await open({ viewport: { width: 800, height: 600 } }, finePath);
  await fine.page.waitForFunction(() => !window.mspskel.state().hasty);
  const atRest = (await state(fine.page)).facesDrawn;
  const moving = await fine.page.evaluate(() => new Promise(done => {
    let frame = 0;
    const turn = () => {
      document.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }));
      if (++frame < 20) requestAnimationFrame(turn);
      else done(window.mspskel.state());
    };
    turn();
  }));
  assert.ok(moving.hasty && moving.facesDrawn > 1000 && moving.facesDrawn < atRest / 3, 'a moving view is coarse');
  await fine.page.waitForFunction(faces => { const s = window.mspskel.state(); return !s.hasty && s.facesDrawn === faces; }, atRest);
  assert.deepEqual(fine.faults, []);
  console.log('the page answers');
} finally {
  await browser.close();
}
