// Bundles the page: sources in src/, three.js from npm, one file dist/page.html that src/view/embed_page.cmake takes into the
// library. usage: npm ci && npm run build
import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { copyFileSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const read = name => readFileSync(join(here, name), 'utf8');

// tests/view/bundle_test.py computes the same: each file's name, a zero byte, its bytes, a zero byte.
function hashOfSources() {
  const names = [...readdirSync(join(here, 'src')).map(name => `src/${name}`), 'build.mjs', 'package-lock.json', 'package.json'].sort();
  const hash = createHash('sha256');
  for (const name of names) hash.update(`${name}\0`).update(readFileSync(join(here, name))).update('\0');
  return hash.digest('hex');
}

const options = { absWorkingDir: here, bundle: true, minify: true, write: false, target: 'es2020', charset: 'ascii', legalComments: 'none', logLevel: 'warning' };
const script = await build({ ...options, entryPoints: ['src/main.js'], format: 'iife' });
const style = await build({ ...options, entryPoints: ['src/style.css'], charset: 'utf8' });
const three = JSON.parse(read('package.json')).dependencies.three;
const notice = `/* three.js ${three}, https://threejs.org, MIT licence:\n${read('node_modules/three/LICENSE').trim()}\n*/\n`;

// A function as replacement: a dollar sign in the bundle means nothing. A closing tag in a string would end the element.
const page = read('src/page.html')
  .replace('@STYLE@', () => style.outputFiles[0].text.trim())
  .replace('@SCRIPT@', () => (notice + script.outputFiles[0].text.trim()).replaceAll('</script', '<\\/script'))
  .replace('</html>', () => `</html>\n<!-- sources ${hashOfSources()} -->`);
mkdirSync(join(here, 'dist'), { recursive: true });
writeFileSync(join(here, 'dist/page.html'), page);
copyFileSync(join(here, 'node_modules/three/LICENSE'), join(here, 'dist/LICENSE.three'));
console.log(`dist/page.html: ${(page.length / 1024).toFixed(0)} kB`);
