// SPDX-License-Identifier: MIT
// page_test.mjs FOLDER - FOLDER/page.html tells the same numbers as FOLDER/masses, under node and in Chromium; the calls that
// it prints make the same run; it obeys keys, fits on every screen, asks no network.  Writes pictures into FOLDER/page.
// Prints TAP; reads CC.
import {spawnSync} from 'node:child_process';
import {mkdirSync, readFileSync, statSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {Script, createContext} from 'node:vm';
import {Browser, findChromium} from './browser.mjs';

const folder = resolve(process.argv[2]), here = dirname(fileURLToPath(import.meta.url)), top = resolve(here, '../..');
const html = readFileSync(join(folder, 'page.html'), 'utf8');
const SHOWN = '#5,5,100,3,1,3,0.5,1e-8,0,0,3';
const READY = 'typeof R === "object" && !!R && document.querySelectorAll("#trade:not(.old) tr").length > 3';
let count = 0, failed = 0;

function check(good, name, more = '') {
  count++;
  if (!good) failed++;
  console.log(`${good ? 'ok' : 'not ok'} ${count} - ${name}`);
  if (!good && more) console.log(String(more).replace(/^/gm, '# '));
}

// ---- set-ups: those of the tour, corners, and some at random (xorshift: the same everywhere)

let seed = 2026;
function random(n) {
  seed ^= seed << 13;
  seed ^= seed >>> 17;
  seed ^= seed << 5;
  return (seed >>> 0) % n;
}

const cases = ['5,5,100,1,0,0,0.5,1e-08,0,0,3', '5,5,100,1,1,0,0.5,1e-08,0,0,3', '5,5,100,3,1,0,0.5,1e-08,0,0,3',
  '5,5,100,3,1,3,0.5,1e-08,0,0,3', '1,1,1,0,0,0,1,0.1,0,0,0', '50,1,100,9,2,4,0.5,1e-12,3,1,4', '1,100,100,3,1,1,0.1,1e-12,0,0,3',
  '50,100,100,3,3,1,0.3,1e-12,0,0,3', '50,100,100,9,2,4,0.5,1e-12,3,1,4', '0,5,5,1,1,0,1,1e-06,0,0,3', '1,3,3,3,1,0,1,1e-08,0,0,0', '2.5,3,3,3,1,0,1,1e-08,0,0,0'];
while (cases.length < 80)
  cases.push([1 + random(20), 1 + random(30), 1 + random(60), random(10), random(4), random(5), (1 + random(10)) / 10,
    10 ** -(1 + random(11)), random(4), random(2), random(5)].join());

// ---- the same numbers: lists of a run, its status in front

function number(text) {
  if (/nan/i.test(text)) return NaN;
  if (/inf/i.test(text)) return text[0] === '-' ? -Infinity : Infinity;
  return Number(text);
}

function lists(text) {
  return text.split('\n').map(line => line.trim() ? line.trim().split(' ').map(number) : []);
}

function same(a, b) {
  return a.length === b.length && a.every((v, i) => Object.is(v, b[i]));
}

const native = lists(spawnSync(join(folder, 'masses'), {input: cases.join('\n'), encoding: 'utf8', maxBuffer: 1 << 28}).stdout);
const module = new WebAssembly.Module(Buffer.from(html.match(/MODULE = '([^']+)'/)[1], 'base64'));
check(WebAssembly.Module.imports(module).length === 0, 'the module imports nothing');

// The model of the page, without the page: its first script file.
const model = createContext({TextDecoder, wasm: null});
new Script(readFileSync(join(top, 'examples/page/model.js'), 'utf8')).runInContext(model);
model.exports = new WebAssembly.Instance(module).exports;
new Script('wasm = exports').runInContext(model);
const inModel = text => new Script(text).runInContext(model);

const own = [];
for (const c of cases) {
  const told = inModel(`(() => { const r = run(settings([${c}])); return [[r.status], ...TOLD.map(name => Array.from(r[name]))]; })()`);
  own.push(...told);
}
const LISTS = own.length / cases.length;
const numbers = own.reduce((sum, l) => sum + l.length, 0);
const refused = cases.filter((_, i) => own[i * LISTS][0] < 0).length;
const unsolved = cases.filter((_, i) => own[i * LISTS + 1][6] > 0).length;
check(own.every((l, i) => same(l, native[i])) && refused === 2 && unsolved > 3,
  `node: ${numbers} numbers of ${cases.length} runs (${unsolved} not solved, ${refused} refused) equal the native ones to the bit`);

// ---- the calls that the page prints are a program: it makes the run that the page shows

function callsProgram(setups) {
  const bodies = setups.map((c, i) => {
    const [windows, stepsA, stepsB, , exchange] = c.split(',');
    return `static void setup${i}(void)\n{\nbegin(${windows}, ${stepsA}, ${stepsB}, ${exchange});\n` +
      inModel(`calls(settings([${c}])).join('\\n')`) + '\nend();\n}\n';
  });
  return '#include "calls.h"\n' + bodies.join('') +
    `int main(void)\n{\n${setups.map((_, i) => `setup${i}();`).join('\n')}\nreturn 0;\n}\n`;
}

function callsAgree() {
  const setups = cases.filter((c, i) => own[i * LISTS][0] === 0 && own[i * LISTS + 1][6] === 0);
  const source = join(folder, 'page', 'calls.c'), program = join(folder, 'page', 'calls');
  writeFileSync(source, callsProgram(setups));
  const built = spawnSync(process.env.CC || 'cc', ['-std=c99', '-Wall', '-Wextra', '-Werror', '-O1', '-I' + top, '-I' + join(top, 'examples'),
    '-I' + here, source, '-o', program, '-lm'], {encoding: 'utf8'});
  const told = built.status === 0 ? lists(spawnSync(program, {encoding: 'utf8'}).stdout) : [];
  const wrong = setups.filter((c, i) => {
    const [a, b, total] = own[cases.indexOf(c) * LISTS + 1], [a2, b2, total2] = told[i] || [];
    const slack = 1e-6 + 100 * Number(c.split(',')[7]); // both stop at the tolerance, not at the same iterate
    return !(Math.abs(a - a2) <= slack * (1 + a) && Math.abs(b - b2) <= slack * (1 + b) && Math.abs(total - total2) <= 2 + .2 * total);
  });
  check(built.status === 0 && wrong.length === 0, `the calls behind ${setups.length} pictures compile and make the same runs`,
    built.stderr + wrong.join('\n'));
}

mkdirSync(join(folder, 'page'), {recursive: true});
callsAgree();
check(!/(src|href)="(?!data:)|https?:|import\(|fetch\(|XMLHttp/.test(html.replace(/MODULE = '[^']+'/, '')), 'no address in the file');

// ---- the page in a browser

async function sameInBrowser(b) {
  const shown = await b.open(`file://${folder}/page.html#print=${cases.join(';')}`, READY);
  check(shown, 'Chromium: the page runs by file://');
  const told = lists(await b.value('document.getElementById("print").textContent'));
  check(own.every((l, i) => same(l, told[i] || [])), `Chromium: all ${numbers} numbers equal the native ones to the bit`);
}

async function obeysKeys(b) {
  await b.open(`file://${folder}/page.html${SHOWN}`, READY);
  check(await b.value('KEYS.map(k => S[k]).join()') === '5,5,100,3,1,3,0.5,1e-8,0,0,3', 'settings from the address');
  for (let i = 0; i < 40 && await b.value('document.activeElement.id') !== 'windows'; i++) await b.key('Tab', 9);
  await b.key('ArrowRight', 39);
  check(await b.value('S.windows === 6 && R.iterations.length === 6'), 'by keyboard: Tab to the windows, arrow: one more');
  await b.value('document.getElementById("undo").focus()');
  await b.send('Input.dispatchKeyEvent', {type: 'char', text: '\r', key: 'Enter'});
  check(await b.value('S.windows === 5'), 'by keyboard: Undo');
}

// Every button but Play makes a run with numbers; so does every neighbour in the table.
async function obeysButtons(b) {
  await b.value('document.querySelectorAll("details").forEach(d => d.open = true)');
  const pressed = await b.value(`(() => {
    let n = 0;
    for (let i = 0; ; i++) {
      trade(true);
      const button = document.querySelectorAll('button')[i];
      if (!button) return n;
      if (button.id === 'play') continue;
      button.click();
      n++;
      if (R.status < 0 || !R.numbers.every(isFinite)) return button.textContent + ': ' + KEYS.map(k => S[k]);
    }
  })()`);
  check(pressed > 25, `each of ${pressed} buttons makes a run`, pressed);
}

// What the sentences of the tour claim.
async function tourIsTrue(b) {
  const steps = await b.value('TOUR.map((_, k) => { tour(k); return {error: R.error, work: R.work, solved: R.solved, first: R.iterations[0]}; })');
  const [ends, samples, cubic, quasi, coarse, long] = steps;
  const near = (v, w, part) => Math.abs(v / w - 1) < part;
  check(steps.every(s => s.solved) && near(ends.error, 3.3, .02) && near(samples.error, .051, .01) && near(cubic.error, .0045, .01) &&
    samples.work < .35 * ends.work && samples.work > .15 * ends.work && cubic.work < 1.3 * samples.work &&
    near(quasi.error, cubic.error, .01) && quasi.work < cubic.work && near(coarse.error, quasi.error, .01) && coarse.work < .9 * quasi.work &&
    long.first > quasi.first, 'what the tour says is so', JSON.stringify(steps));
  const shares = await b.value(`(() => { tour(2); const r = name => neighbour(name, {...S, ...CHANGES.find(c => c[0] === name)[1](S)}).error;
    return [r('A: twice the sub-steps'), r('B: half the sub-steps')]; })()`);
  check(shares[0] < .25 && shares[1] < 1.5, 'the tour: what is left comes from the steps of A', shares);
}

// The table is made of runs: what a row says before it is pressed is what comes after.
async function tableIsTrue(b) {
  await b.value(`apply(settings([5, 5, 100, 3, 1, 3, .5, 1e-8, 0, 0, 3])), trade(true)`);
  const wrong = await b.value(`(() => {
    const from = S, was = R, rows = CHANGES.map(([name, how]) => ({name, to: {...from, ...how(from)}})).filter(row => KEYS.some(k => row.to[k] !== from[k]));
    return rows.filter(row => {
      const told = neighbour(row.name, row.to);
      apply(row.to);
      const there = [R.error / was.error, R.work / was.work];
      apply(from);
      return there[0] !== told.error || there[1] !== told.work;
    }).map(row => row.name);
  })()`);
  check(wrong.length === 0, 'what one change buys: each row is the run that its button makes', wrong);
}

async function isReadable(b) {
  for (const scheme of ['light', 'dark']) {
    await b.media({'prefers-color-scheme': scheme, 'prefers-reduced-motion': 'reduce'});
    const least = await b.value(`(() => {
      const channel = x => x <= .03928 ? x / 12.92 : ((x + .055) / 1.055) ** 2.4;
      const light = name => {
        const [r, g, b] = colour(name).slice(1).match(/../g).map(x => channel(parseInt(x, 16) / 255));
        return .2126 * r + .7152 * g + .0722 * b;
      };
      const ratio = (p, q) => (Math.max(light(p), light(q)) + .05) / (Math.min(light(p), light(q)) + .05);
      const inks = ['ink', 'soft', 'a', 'b', 'exact', 'count', 'good', 'bad'];
      return Math.min(...inks.flatMap(name => ['card', 'page', 'field'].map(paper => ratio(name, paper))),
        ratio('ink', 'mark'), ...['ink', 'good', 'bad', 'soft'].map(name => ratio(name, 'tint')));
    })()`);
    check(least >= 4.5, `${scheme} colours: least contrast ${least.toFixed(1)}`);
  }
  await b.open(`file://${folder}/page.html${SHOWN}`, READY);
  await b.value('document.querySelectorAll("details").forEach(d => d.open = true)');
  const wide = [];
  for (const width of [320, 390, 768, 1024, 1280, 1920]) {
    await b.size(width, 800, width < 700);
    await b.value('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))');
    if (await b.value('document.documentElement.scrollWidth') > width) wide.push(width);
  }
  check(wide.length === 0, 'from 320 to 1920 pixels: nothing sticks out', wide);
  const nameless = await b.value(`[...document.querySelectorAll('button, input, select, canvas')].filter(e =>
    !(e.textContent.trim() || e.getAttribute('aria-label') || (e.labels && e.labels.length))).map(e => e.outerHTML)`);
  check(nameless.length === 0, 'every control and picture has a name that can be read out', nameless);
}

async function survivesAddresses(b) {
  const odd = ['#0,5,5,1,1,0,1,1e-6,0,0,3', '#5,5,5,99,1,0,1,1e-6,0,0,3', '#7,9,11,3,1,0,.35,3e-7,0,0,3', '#x', '#%', '#5,5,5,1,7,9,1,1,9,9,9',
    '#1e9,1,1,1,1,1,1,1,1,1,1'];
  const wrong = [];
  for (const hash of odd)
    if (!await b.open(`file://${folder}/page.html${hash}`, READY) || !await b.value('R.status === 0 && R.numbers.every(isFinite)')) wrong.push(hash);
  check(wrong.length === 0, `${odd.length} odd addresses: the nearest settings, or the tour`, wrong);
}

async function isQuiet(b) {
  const noise = b.events.filter(e => ['Runtime.exceptionThrown', 'Runtime.consoleAPICalled', 'Log.entryAdded'].includes(e.method));
  check(noise.length === 0, 'nothing on the console', noise.map(e => JSON.stringify(e.params).slice(0, 300)).join('\n'));
  const asked = b.events.filter(e => e.method === 'Network.requestWillBeSent').map(e => e.params.request.url);
  const abroad = asked.filter(url => !/^(file|data|about):/.test(url));
  check(asked.length > 0 && abroad.length === 0, 'no request to any network', abroad.join('\n'));
}

// Plots are drawn for the size that they have, in the next frames: the table beside them may have grown since.
function drawnToSize(b) {
  return b.until(`[...document.querySelectorAll('canvas')].every(c => Math.abs(c.height - c.clientHeight * devicePixelRatio) <= 1 &&
    Math.abs(c.width - c.clientWidth * devicePixelRatio) <= 1)`);
}

async function pictures(b) {
  const drawn = [];
  for (const [name, width, scheme] of [['light', 1280, 'light'], ['dark', 1280, 'dark'], ['phone', 390, 'light']]) {
    await b.media({'prefers-color-scheme': scheme, 'prefers-reduced-motion': 'reduce'});
    await b.size(width, 900, width < 700);
    await b.open(`file://${folder}/page.html${SHOWN}`, READY);
    drawn.push(await drawnToSize(b));
    await b.picture(join(folder, 'page', name + '.png'));
  }
  // For the README: settings, motion and table, small.
  await b.size(1280, 900, false);
  await b.open(`file://${folder}/page.html${SHOWN}`, READY);
  drawn.push(await drawnToSize(b));
  check(drawn.every(Boolean), 'plots are drawn to their size', drawn);
  const part = await b.value(`(() => {
    const top = document.getElementById('knobs').getBoundingClientRect().top + scrollY - 14;
    const bottom = document.getElementById('buys').getBoundingClientRect().bottom + scrollY + 14;
    return {x: 0, y: top, width: 1280, height: bottom - top, scale: .7};
  })()`);
  const picture = join(folder, 'page', 'page.png');
  await b.picture(picture, part);
  const size = statSync(picture).size;
  check(size < 150000, `a picture for the README: ${Math.ceil(size / 1000)} kB`);
}

const chromium = findChromium();
if (!chromium) console.log(`ok ${++count} - # SKIP the page in a browser: no chromium (Debian: apt-get install chromium)`);
else {
  const b = await Browser.start(chromium);
  try {
    await b.media({'prefers-reduced-motion': 'reduce'});
    await b.size(1280, 1000, false);
    for (const part of [sameInBrowser, obeysKeys, obeysButtons, tourIsTrue, tableIsTrue, isReadable, survivesAddresses, isQuiet, pictures])
      await part(b);
  } catch (e) {
    check(false, 'the browser answers', e.stack);
  } finally {
    await b.stop();
  }
}
console.log(`1..${count}`);
process.exit(failed ? 1 : 0);
