/* The controls: every change runs the new settings, draws, and then runs their neighbours for the table. */
const $ = id => document.getElementById(id);
const PUBLISHED = {windows: 5, a: 5, b: 100, guess: 0, older: 0, omega: .5, table: 3};
const TOUR = [
  ['Window ends', {...PUBLISHED, degree: 1, exchange: ENDS, method: NONE, tolerance: 1e-8},
    'Each solver knows of the other only a straight line from window start to window end. Both solvers are good; what ' +
    'they exchange is not: the error is 3.3.'],
  ['Every sub-step', {...PUBLISHED, degree: 1, exchange: SAMPLES, method: NONE, tolerance: 1e-8},
    'The same solvers and steps, but the partner reads every sub-step: the error falls from 3.3 to 0.051, and the data ' +
    'agree after a fourth of the work.'],
  ['Cubic in time', {...PUBLISHED, degree: 3, exchange: SAMPLES, method: NONE, tolerance: 1e-8},
    'A cubic spline through the same samples: 0.0045. No call of a solver costs more. What is left comes from the five ' +
    'steps of A, as the table of changes says.'],
  ['Quasi-Newton', {...PUBLISHED, degree: 3, exchange: SAMPLES, method: ILS, tolerance: 1e-8},
    'Without acceleration a window is repeated until it stands still. IQN-ILS learns from earlier iterations, those of ' +
    'earlier windows, too: the same error for less work.'],
  ['Coarse tolerance', {...PUBLISHED, degree: 3, exchange: SAMPLES, method: ILS, tolerance: 1e-4},
    'Iterating far below the error in time buys nothing: with a tolerance of 1e-4 the error stays, and the work falls.'],
  ['One long window', {...PUBLISHED, windows: 1, a: 32, b: 100, degree: 3, exchange: SAMPLES, method: ILS, tolerance: 1e-6},
    'All of the time is one fixed point, and no window has been there to learn from. Compare the accelerators: what does ' +
    'it cost to have none, or Aitken?']];
const NO_STORY = 'A tour in six steps; or turn a knob. The address of this page holds the settings.';
const ANIMATION = 6000; /* ms for all of the time */

let S = settings([5, 5, 100, 3, SAMPLES, ILS, .5, 1e-8, 0, 0, 3]); /* shown now */
let R;           /* its run */
let before;      /* the run shown before, and the settings before that, for Undo */
let past = [];
let timer;       /* of the table */
let started = 0; /* when the animation was at time 0; 0: it stands still */

function short(v, digits = 3) {
  if (v === 0 || (v >= 1e-3 && v < 1e5)) return String(Number(v.toPrecision(digits)));
  return v.toExponential(1).replace('e+', 'e');
}

/* ---- numbers and calls ---- */

function tile(name, value, more) {
  return element('div', '', element('span', name), element('b', value), element('span', more));
}

function whyNot() {
  if (R.status < 0) return `Stopped, status ${R.status}: ${message(R.status)}.`;
  const window = `Window ${R.iterations.length} of ${S.windows}`;
  if (R.end === 2) return `${window} was left after 400,000 evaluations in all: as many as this page allows.`;
  const last = R.last > 202 ? `: ${message(R.last)}` : '';
  return `${window} gave up after ${R.iterations[R.iterations.length - 1]} iterations${last}.`;
}

function showNumbers() {
  const whole = v => v.toLocaleString('en');
  const add = (name, key, format, more) => {
    const changed = before && before[key] !== R[key];
    $('numbers').append(tile(name, format(R[key]), changed ? `before: ${format(before[key])}` : more));
  };
  $('numbers').replaceChildren();
  add('Largest error', 'error', short, `A ${short(R.errorA, 2)}, B ${short(R.errorB, 2)}`);
  add('Work', 'work', whole, 'evaluations');
  add('Iterations', 'total', whole, R.iterations.length === 1 ? 'in one window' : `in ${R.iterations.length} windows`);
  add('Unknowns', 'unknowns', whole, `spline of degree ${R.degree}`);
  if (!R.solved) $('numbers').append(element('p', whyNot()));
}

let shownCalls = [];
function showCalls() {
  const now = calls(S), old = new Set(shownCalls);
  $('code').replaceChildren(...now.flatMap(line => {
    const changed = shownCalls.length > 0 && !old.has(line);
    return [element(changed ? 'mark' : 'span', line), '\n'];
  }));
  shownCalls = now;
}

/* ---- what one change buys ---- */

function atLeast(list, v) {
  return list.find(x => x >= v) || list[list.length - 1];
}

const CHANGES = [
  ['A: twice the sub-steps', s => ({a: atLeast(STEPS, 2 * s.a)})],
  ['A: a method of order 5', () => ({table: 4})],
  ['B: twice the sub-steps', s => ({b: atLeast(STEPS, 2 * s.b)})],
  ['B: half the sub-steps', s => ({b: atLeast(STEPS, Math.ceil(s.b / 2))})],
  ['Twice the windows', s => ({windows: atLeast(WINDOWS, 2 * s.windows)})],
  ['Twice the windows, same steps', s => ({
    windows: atLeast(WINDOWS, 2 * s.windows),
    a: atLeast(STEPS, Math.ceil(s.a / 2)),
    b: atLeast(STEPS, Math.ceil(s.b / 2))})],
  ['Degree 1', () => ({degree: 1})],
  ['Degree 3', () => ({degree: 3})],
  ['Degree 5', () => ({degree: 5})],
  ['Exchange every sub-step', () => ({exchange: SAMPLES})],
  ['Exchange slopes, too', s => ({exchange: SLOPES, degree: Math.max(3, s.degree)})],
  ['No accelerator', () => ({method: NONE})],
  ['IQN-ILS', () => ({method: ILS})],
  ['Tolerance 100 times coarser', s => ({tolerance: nearest(KNOBS[7], 100 * s.tolerance)})],
  ['Linear first guess', () => ({guess: 1})],
  ['Older samples for the spline', s => ({older: 1, guess: Math.max(1, s.guess)})]];

/* Of a factor: its words, what it means, and the bar below, which goes one and a half decades to both sides. */
function describe(factor) {
  const reach = 1.5, part = 50 * Math.max(-1, Math.min(1, Math.log10(factor) / reach)); /* in per cent */
  const digits = v => v < 9.95 ? v.toFixed(1) : short(Math.round(v));
  if (Math.abs(factor - 1) < .05) return {words: 'same', kind: 'same', from: 50, wide: 0};
  if (factor < 1) return {words: '\u00f7 ' + digits(1 / factor), kind: 'good', from: 50 + part, wide: -part};
  return {words: '\u00d7 ' + digits(factor), kind: 'bad', from: 50, wide: part};
}

/* A neighbour of today's settings: factors of error and work, NaN where one of the two runs is not solved. */
function neighbour(name, to) {
  const r = run(to), both = r.solved && R.solved;
  return {name, to, r, error: both ? r.error / R.error : NaN, work: both ? r.work / R.work : NaN};
}

/* More accuracy: the least error x work; less work: where the error stays. */
function bestBuys(rows) {
  const least = (list, of) => list.reduce((best, row) => !best || of(row) < of(best) ? row : best, undefined);
  return {
    accuracy: least(rows.filter(row => row.error < .8), row => row.error * row.work),
    work: least(rows.filter(row => row.error < 1.05 && row.work < .95), row => row.work)};
}

function whyUnsolved(r) {
  return r.status >= 0 && r.end === 2 ? 'too much work' : 'gives up';
}

function factorCell(factor) {
  const {words, kind, from, wide} = describe(factor), bar = element('i');
  const cell = element('td', words, bar);
  cell.className = kind;
  bar.style.setProperty('--from', from + '%');
  bar.style.setProperty('--wide', wide + '%');
  return cell;
}

function rowElement(row, best) {
  const tr = element('tr'), button = element('button', row.name);
  button.type = 'button';
  button.onclick = () => change(row.to);
  button.title = row.r.solved ? `error ${short(row.r.error)}, work ${row.r.work.toLocaleString('en')}` : '';
  tr.append(element('td', '', button));
  if (row.r.solved && R.solved) tr.append(factorCell(row.error), factorCell(row.work));
  else {
    const cell = element('td', row.r.solved ? 'solves it' : whyUnsolved(row.r));
    cell.colSpan = 2;
    cell.className = row.r.solved ? 'good' : 'bad';
    tr.append(cell);
  }
  if (row === best.accuracy || row === best.work) tr.className = 'best';
  return tr;
}

function sentence(lead, row) {
  const name = row.name.replace(/^[A-Z](?=[a-z])/, c => c.toLowerCase());
  return element('span', '', element('b', lead), ` ${name}. `);
}

function showTrade(rows) {
  const best = bestBuys(rows), words = [];
  if (best.accuracy) words.push(sentence('More accuracy:', best.accuracy));
  if (best.work) words.push(sentence('Less work:', best.work));
  if (!R.solved) words.push('The present run is not solved.');
  if (!words.length) words.push('No single change is a bargain here.');
  $('best').replaceChildren(...words);
  $('trade').replaceChildren(...rows.map(row => rowElement(row, best)));
  $('trade').classList.remove('old');
}

/* One run after the other, so that a key pressed in between is answered; now: all at once. */
function trade(now) {
  const todo = CHANGES.map(([name, how]) => ({name, to: {...S, ...how(S)}}))
    .filter(({to}) => KEYS.some(key => to[key] !== S[key]));
  const rows = [];
  const next = () => {
    do {
      const {name, to} = todo.shift();
      rows.push(neighbour(name, to));
    } while (now && todo.length);
    if (todo.length) timer = setTimeout(next);
    else showTrade(rows);
  };
  clearTimeout(timer);
  $('trade').classList.add('old');
  if (now) next();
  else timer = setTimeout(next, 60);
}

/* ---- settings ---- */

function showKnobs() {
  for (const knob of KNOBS) {
    const e = $(knob.key);
    e.value = knob.list ? knob.list.indexOf(S[knob.key]) : S[knob.key];
    if (!knob.list) continue;
    const words = knob.key === 'tolerance' ? S.tolerance.toExponential() : String(S[knob.key]);
    e.nextSibling.textContent = words;
    e.setAttribute('aria-valuetext', words);
  }
  const off = {omega: S.method !== RELAXATION && S.method !== AITKEN, older: !S.guess};
  for (const key of Object.keys(off)) {
    $(key).disabled = off[key];
    $(key).parentNode.classList.toggle('off', off[key]);
  }
  $('undo').disabled = past.length === 0;
  document.querySelectorAll('#tour button').forEach(b => b.setAttribute('aria-pressed', 'false'));
  if ($('story').textContent !== NO_STORY) $('story').textContent = NO_STORY; /* or it is read out again */
}

/* Show these settings. */
function apply(to) {
  S = to;
  before = R;
  R = run(S);
  showKnobs();
  showNumbers();
  showCalls();
  draw();
  history.replaceState(null, '', '#' + KEYS.map(key => S[key]).join());
  trade(false);
}

/* The same, and Undo knows the way back. */
function change(to) {
  if (KEYS.every(key => to[key] === S[key])) return;
  past.push(S);
  apply(to);
}

function undo() {
  if (past.length) apply(past.pop());
}

function tell(k) {
  $('story').textContent = TOUR[k][2];
  $('tour').children[k].setAttribute('aria-pressed', 'true');
}

function tour(k) {
  change({...S, ...TOUR[k][1]});
  tell(k);
}

/* ---- the animation ---- */

function play(on) {
  started = on ? performance.now() - shownTime() % 1 * ANIMATION : 0;
  $('play').textContent = on ? 'Pause' : 'Play';
  $('play').setAttribute('aria-pressed', String(on));
  if (on) requestAnimationFrame(frame);
}

function frame(now) {
  if (!started) return;
  moveTo((now - started) % ANIMATION / ANIMATION);
  requestAnimationFrame(frame);
}

function moveTo(time) {
  $('cursor').value = POINTS * time;
  drawScene();
  drawTime();
}

/* ---- once ---- */

function knobElement(knob) {
  const label = element('label', knob.name), e = element(knob.list ? 'input' : 'select');
  e.id = knob.key;
  if (knob.list) {
    e.type = 'range';
    e.min = 0;
    e.max = knob.list.length - 1;
    e.addEventListener('input', () => change({...S, [knob.key]: knob.list[e.value]}));
    label.append(e, element('output'));
  } else {
    knob.texts.forEach((words, i) => e.add(new Option(words, i)));
    e.addEventListener('change', () => change({...S, [knob.key]: Number(e.value)}));
    label.append(e);
    label.className = 'wide';
  }
  return label;
}

function build() {
  for (const [name, keys] of GROUPS)
    $('knobs').append(element('h3', name), ...keys.map(key => knobElement(KNOBS[KEYS.indexOf(key)])));
  TOUR.forEach(([name], k) => {
    const button = element('button', '', element('b', String(k + 1)), name);
    button.type = 'button';
    button.onclick = () => tour(k);
    $('tour').append(button);
  });
  const show = set => {
    change({...S, ...set});
    $('numbers').scrollIntoView({block: 'start'});
  };
  const branches = parseTree($('tree-text').textContent.split('\n')).branches.map(b => branchElement(b, show));
  branches[1].open = true; /* what this page is about */
  $('branches').append(...branches);
  $('undo').onclick = undo;
  $('play').onclick = () => play(!started);
  $('cursor').oninput = () => {
    play(false);
    moveTo(shownTime());
  };
  $('time').onpointermove = e => {
    const box = $('time').getBoundingClientRect();
    play(false);
    moveTo(Math.min(1, Math.max(0, (e.clientX - box.left - 42) / (box.width - 52))));
  };
  const resized = new ResizeObserver(draw); /* also when the table beside the motion grows */
  document.querySelectorAll('canvas').forEach(canvas => resized.observe(canvas));
  window.addEventListener('hashchange', fromAddress);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
}

/* #eleven numbers: settings.  #print=settings;settings: every number of these runs, for tests. */
function fromAddress() {
  const hash = location.hash.slice(1), numbers = hash.split(',').map(Number);
  if (hash.startsWith('print=')) {
    $('print').textContent = hash.slice(6).split(';').map(s => {
      const r = run(settings(s.split(',').map(Number)));
      return [r.status, ...TOLD.map(name => r[name].join(' '))].join('\n');
    }).join('\n');
    apply(S);
  } else if (numbers.length === KEYS.length && numbers.every(isFinite))
    apply(settings(KNOBS.map((knob, i) => nearest(knob, numbers[i]))));
  else {
    apply({...S, ...TOUR[0][1]});
    tell(0);
  }
}

WebAssembly.instantiate(Uint8Array.from(atob(MODULE), c => c.charCodeAt(0))).then(made => {
  wasm = made.instance.exports;
  build();
  fromAddress();
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) play(true);
});
