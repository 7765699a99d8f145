/* Settings, a run of them, and the calls that they stand for. */
const STEPS = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25, 32, 40, 50, 64, 80, 100];
const WINDOWS = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25, 32, 40, 50];
const TOLERANCES = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];
const TABLES = ['euler', 'heun', 'kutta3', 'rk4', 'dp5'];
const ENDS = 0, SAMPLES = 1, SLOPES = 2, MEANS = 3; /* exchange */
const NONE = 0, RELAXATION = 1, AITKEN = 2, ILS = 3, IMVJ = 4; /* method */

/* In the order of the enum in masses.c.  A list of numbers is a slider; of texts a choice, whose value is the position. */
const KNOBS = [
  {key: 'windows', name: 'Time windows', list: WINDOWS},
  {key: 'a', name: 'Sub-steps of A', list: STEPS},
  {key: 'b', name: 'Sub-steps of B', list: STEPS},
  {key: 'degree', name: 'Degree in time', list: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]},
  {key: 'exchange', name: 'Exchange', texts: ['window ends', 'sub-steps', 'with slopes', 'as means']},
  {key: 'method', name: 'Accelerator', texts: ['none', 'relaxation', 'Aitken', 'IQN-ILS', 'IQN-IMVJ']},
  {key: 'omega', name: 'Relaxation', list: [.1, .2, .3, .4, .5, .6, .7, .8, .9, 1]},
  {key: 'tolerance', name: 'Tolerance', list: TOLERANCES},
  {key: 'guess', name: 'First guess', texts: ['constant', 'linear', 'quadratic', 'cubic']},
  {key: 'older', name: 'Older samples', texts: ['for the guess', 'for the spline']},
  {key: 'table', name: 'Method of A', texts: ['Euler', 'Heun, order 2', 'Kutta, order 3', 'RK4, order 4', 'DP5, order 5']}];
const GROUPS = [
  ['Time steps, in each window', ['windows', 'a', 'b', 'table']],
  ['What the partner gets', ['exchange', 'degree', 'older']],
  ['How the data come to agree', ['method', 'omega', 'tolerance', 'guess']]];
const KEYS = KNOBS.map(k => k.key);
const TOLD = ['numbers', 'curve_time', 'curve_a', 'curve_b', 'exact_a', 'exact_b', 'time_a', 'time_b', 'u_a', 'u_b',
  'error_a', 'error_b', 'iterations', 'residuals']; /* the lists of masses.c */

let wasm; /* the exports of masses.c */

function settings(numbers) {
  return Object.fromEntries(KEYS.map((key, i) => [key, numbers[i]]));
}

function message(status) {
  const text = status < 0 && status > -200 ? wasm.wf_message : wasm.iqn_message;
  const bytes = new Uint8Array(wasm.memory.buffer, text(status));
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

function run(s) {
  const memory = wasm.memory.buffer;
  new Float64Array(memory, wasm.setting_start(), KEYS.length).set(KEYS.map(key => s[key]));
  const r = {status: wasm.run()};
  TOLD.forEach((name, i) => {
    r[name] = new Float64Array(memory, wasm.list_start(i), wasm.list_length(i)).slice();
  });
  [r.errorA, r.errorB, r.total, r.work, r.unknowns, r.degree, r.end, r.last] = r.numbers;
  r.error = Math.max(r.errorA, r.errorB);
  r.solved = r.status >= 0 && r.end === 0;
  return r;
}

/* Settings from an address may be any numbers: the nearest that the knobs have. */
function nearest(knob, v) {
  const values = knob.list || knob.texts.map((_, i) => i);
  return values.reduce((best, c) => Math.abs(c - v) < Math.abs(best - v) ? c : best);
}

/* ---- the calls: between two fixed halves, see tests/page/calls.h, they are a program with the numbers of run(s) ---- */

function calls(s) {
  const per = s.exchange === SLOPES ? 2 : 1;
  const degree = per === 2 ? Math.max(2, s.degree) : s.degree;
  const samples = steps => s.exchange === ENDS ? 1 : steps;
  const columns = steps => per * (samples(steps) * (s.guess + 1) + 1);
  const slope = per === 2 ? 'WF_SLOPE' : '0';
  const unknowns = samples(s.b) * per;
  const read = s.exchange === MEANS ? 'wf_mean(b, t, t + h, &u)' : 'wf_read(b, t, 0, &u)';
  const lines = [];
  const add = (...more) => lines.push(...more);

  add(`T = rk_find("${TABLES[s.table]}"); /* solver A */`,
    `wf_make(&a, 1, ${degree}, ${columns(s.a)}, mem_a, sizeof mem_a); /* numbers, degree, columns */`,
    `wf_make(&b, 1, ${degree}, ${columns(s.b)}, mem_b, sizeof mem_b);`,
    `wf_make(&hb, 1, ${degree}, ${columns(s.b)}, mem_h, sizeof mem_h);`);
  if (s.guess && !s.older)
    add(`wf_restrict(a, ${degree}, 0); /* older samples: for the first guess alone */`,
      `wf_restrict(b, ${degree}, 0);`);
  add(`iqn_make(&q, ${unknowns}, 20, 1, mem_q, sizeof mem_q); /* unknowns, pairs */`,
    `iqn_set(q, IQN_TOL_ABSOLUTE, ${s.tolerance.toExponential()});`);
  if (s.method <= RELAXATION) add('iqn_set(q, IQN_METHOD, IQN_CONSTANT);');
  if (s.method === AITKEN) add('iqn_set(q, IQN_METHOD, IQN_AITKEN);');
  if (s.method === IMVJ) add('iqn_set(q, IQN_METHOD, IQN_IMVJ);');
  if (s.method <= AITKEN) add(`iqn_set(q, IQN_OMEGA, ${s.method === NONE ? 1 : s.omega});`);
  add(`*wf_column(a, wf_push(a, 0, ${slope})) = 1; /* the initial values */`,
    `*wf_column(b, wf_push(b, 0, ${slope})) = 0;`);
  if (per === 2)
    add('*wf_column(a, 1) = 0; /* and velocities */',
      '*wf_column(b, 1) = 0;');
  add(`for (window = 0; window < ${s.windows}; window++) {`,
    '    times_of(window, ta, tb); /* yours */',
    `    wf_begin(a, ${s.guess}, ${samples(s.a)}, ta, ${slope}); /* times, and a first guess */`,
    `    wf_begin(b, ${s.guess}, ${samples(s.b)}, tb, ${slope});`,
    '    wf_copy(hb, b); /* what b would be */',
    `    x = wf_column(b, wf_start(b) + ${per});`,
    `    hx = wf_column(hb, wf_start(hb) + ${per});`,
    '    do {',
    `        solve_a(a, b);  /* reads b: ${read} */`,
    '        solve_b(hb, a); /* hx = H(x) */',
    '        iqn_step(q, x, hx);',
    '    } while (!iqn_converged(q));',
    '    iqn_commit(q);',
    `    wf_advance(a, ${s.guess * samples(s.a)}); /* older samples that stay */`,
    `    wf_advance(b, ${s.guess * samples(s.b)});`,
    '}');
  return lines;
}
