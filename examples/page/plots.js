/* What is drawn.  S: the settings, R: their run, both in page.js. */
const FONT = '12px Inter, "Segoe UI", Roboto, system-ui, sans-serif';
const POINTS = 480; /* of the cursor */
const TENTHS = [0, .2, .4, .6, .8, 1];

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

/* A canvas with a pen, cleared, in CSS pixels. */
function paper(id) {
  const canvas = document.getElementById(id), ratio = window.devicePixelRatio || 1;
  const w = canvas.clientWidth, h = canvas.clientHeight, g = canvas.getContext('2d');
  canvas.width = Math.round(w * ratio);
  canvas.height = Math.round(h * ratio);
  g.scale(ratio, ratio);
  g.font = FONT;
  g.lineJoin = 'round';
  return {g, w, h};
}

function power(exponent) {
  const digits = '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079';
  return '10' + (exponent < 0 ? '\u207b' : '') + [...String(Math.abs(exponent))].map(d => digits[d]).join('');
}

function text(g, words, x, y, name, align, baseline) {
  g.fillStyle = colour(name);
  g.textAlign = align;
  g.textBaseline = baseline;
  g.fillText(words, x, y);
}

/* Distance of lines on an axis of that span, for at most six of them. */
function step(span, log) {
  const steps = log ? [1, 2, 3, 4, 5, 10] : [.5, 1, 2, 5, 10, 20, 50];
  return steps.find(s => span / s <= 6) || Math.ceil(span / 6);
}

/* Axes: x [from, to, places of numbers], y [from, to], names in words, log: of y.  Returns how to draw in them. */
function axes(id, x, y, xName, yName, log) {
  const {g, w, h} = paper(id), left = 42, right = w - 10, top = 22, bottom = h - 34;
  const scale = v => log ? Math.log10(Math.max(v, 1e-99)) : v;
  const low = scale(y[0]), high = scale(y[1]), distance = step(high - low, log);
  const X = v => left + (v - x[0]) / (x[1] - x[0]) * (right - left);
  const Y = v => Math.min(Math.max(top + (high - scale(v)) / (high - low) * (bottom - top), top), bottom);

  g.strokeStyle = colour('grid');
  for (let k = Math.ceil(low / distance); k * distance <= high + 1e-9; k++) {
    const at = Y(log ? 10 ** (k * distance) : k * distance);
    g.beginPath();
    g.moveTo(left, at);
    g.lineTo(right, at);
    g.stroke();
    text(g, log ? power(k * distance) : String(k * distance), left - 8, at, 'soft', 'right', 'middle');
  }
  for (const v of x[2]) text(g, String(v), X(v), bottom + 6, 'soft', 'center', 'top');
  text(g, xName, right, h - 2, 'soft', 'right', 'bottom');
  text(g, yName, 2, 2, 'soft', 'left', 'top');

  const path = (xs, ys) => {
    g.beginPath();
    for (let i = 0; i < xs.length; i++) g.lineTo(X(xs[i]), Y(ys[i]));
    g.stroke();
  };
  const line = (xs, ys, name, width, dash = []) => {
    g.strokeStyle = colour(name);
    g.lineWidth = width;
    g.setLineDash(dash);
    path(xs, ys);
    g.setLineDash([]);
  };
  const dots = (xs, ys, name, size, square) => {
    g.fillStyle = colour(name);
    for (let i = 0; i < xs.length; i++) {
      g.beginPath();
      if (square) g.rect(X(xs[i]) - size, Y(ys[i]) - size, 2 * size, 2 * size);
      else g.arc(X(xs[i]), Y(ys[i]), size, 0, 7);
      g.fill();
    }
  };
  return {g, w, X, Y, left, right, top, bottom, line, dots};
}

function windowEnds(p) {
  p.g.strokeStyle = colour('line');
  p.g.setLineDash([2, 3]);
  p.g.beginPath();
  for (let k = 1; k < S.windows; k++) {
    p.g.moveTo(p.X(k / S.windows), p.top);
    p.g.lineTo(p.X(k / S.windows), p.bottom);
  }
  p.g.stroke();
  p.g.setLineDash([]);
}

function dotSize(count) {
  if (count > 160) return 1.3;
  return count > 60 ? 1.9 : 3.2;
}

function largest(values) {
  return values.reduce((most, v) => Math.max(most, Math.abs(v)), 0);
}

function shownTime() {
  return document.getElementById('cursor').value / POINTS;
}

/* ---- the motion ---- */

function drawTime() {
  const most = 1.05 * Math.max(...[R.curve_a, R.curve_b, R.u_a, R.u_b].map(largest));
  const reach = Math.min(5, Math.max(1.2, most));
  const p = axes('time', [0, 1, TENTHS], [-reach, reach], 'time, in slow periods', 'displacement; 1: of A at the start', false);
  windowEnds(p);
  p.line(R.curve_time, R.exact_a, 'exact', 1.3, [5, 4]);
  p.line(R.curve_time, R.exact_b, 'exact', 1.3, [5, 4]);
  p.line(R.curve_time, R.curve_a, 'a', 2);
  p.line(R.curve_time, R.curve_b, 'b', 2);
  p.dots(R.time_b, R.u_b, 'b', .85 * dotSize(R.time_b.length), true);
  p.dots(R.time_a, R.u_a, 'a', dotSize(R.time_a.length));
  p.g.strokeStyle = colour('soft');
  p.g.lineWidth = 1;
  p.g.beginPath();
  p.g.moveTo(p.X(shownTime()), p.top);
  p.g.lineTo(p.X(shownTime()), p.bottom);
  p.g.stroke();
  document.getElementById('time').setAttribute('aria-label',
    `Displacement of both masses over time, computed and exact; largest error ${short(R.error)}`);
}

function spring(g, x0, x1, y) {
  const turns = 14, lead = 10;
  g.beginPath();
  g.moveTo(x0, y);
  g.lineTo(x0 + lead, y);
  for (let k = 1; k < turns; k++)
    g.lineTo(x0 + lead + (x1 - x0 - 2 * lead) * k / turns, y + (k % 2 ? -8 : 8));
  g.lineTo(x1 - lead, y);
  g.lineTo(x1, y);
  g.stroke();
}

function drawScene() {
  const {g, w} = paper('scene'), n = R.curve_time.length, third = w / 3, y = 40, half = 18;
  const all = S.windows * Math.floor(POINTS / S.windows); /* points of a run that goes to the end */
  const i = Math.min(n - 1, Math.round(shownTime() * all));
  const place = (side, u) => third * (side + 1) + .28 * third * Math.max(-1.4, Math.min(1.4, u));
  document.getElementById('clock').textContent = n ? 'time ' + R.curve_time[i].toFixed(3) : '';
  if (!n) return;
  const a = place(0, R.curve_a[i]), b = place(1, R.curve_b[i]);
  g.strokeStyle = colour('soft');
  g.lineWidth = 1.5;
  spring(g, 5, a - half, y);
  spring(g, a + half, b - half, y);
  spring(g, b + half, w - 5, y);
  g.fillStyle = colour('soft');
  g.fillRect(0, y - 32, 5, 64);
  g.fillRect(w - 5, y - 32, 5, 64);
  for (const [x, name] of [[a, 'a'], [b, 'b']]) {
    g.fillStyle = colour(name);
    g.beginPath();
    g.roundRect(x - half, y - half, 2 * half, 2 * half, 6);
    g.fill();
    g.font = '600 15px Inter, "Segoe UI", Roboto, system-ui, sans-serif';
    text(g, name.toUpperCase(), x, y + 1, 'card', 'center', 'middle');
  }
  g.strokeStyle = colour('ink');
  g.setLineDash([4, 3]);
  for (const x of [place(0, R.exact_a[i]), place(1, R.exact_b[i])]) {
    g.beginPath();
    g.roundRect(x - half, y - half, 2 * half, 2 * half, 6);
    g.stroke();
  }
}

/* ---- the numbers ---- */

function drawError() {
  const low = R.error < 1e-6 ? 1e-14 : R.error < 1e-3 ? 1e-10 : 1e-6, high = low < 1e-8 ? .1 : 10;
  const p = axes('error', [0, 1, TENTHS], [low, high], 'time, in slow periods', '', true);
  windowEnds(p);
  p.line(R.time_b, R.error_b, 'b', 1);
  p.line(R.time_a, R.error_a, 'a', 1);
  p.dots(R.time_b, R.error_b, 'b', .7 * dotSize(R.time_b.length), true);
  p.dots(R.time_a, R.error_a, 'a', .85 * dotSize(R.time_a.length));
  text(p.g, 'A', p.right - 14, 2, 'a', 'right', 'top');
  text(p.g, 'B', p.right, 2, 'b', 'right', 'top');
  text(p.g, 'error, in the same unit', 2, 2, 'soft', 'left', 'top');
  document.getElementById('error').setAttribute('aria-label',
    `Error at every sub-step, logarithmic: at most ${short(R.errorA)} for A, ${short(R.errorB)} for B`);
}

function drawBars() {
  const n = R.iterations.length, most = Math.max(4, ...R.iterations), every = Math.ceil(n / 10);
  const places = Array.from({length: n}, (_, i) => i + 1).filter(i => every === 1 || i % every === 0);
  const p = axes('bars', [.5, n + .5, places], [0, 1.15 * most], 'window', 'iterations', false);
  R.iterations.forEach((k, i) => {
    const x = p.X(i + .62), y = p.Y(k), wide = p.X(i + 1.38) - x, last = i === n - 1;
    p.g.fillStyle = colour(last && !R.solved ? 'bad' : 'count');
    p.g.fillRect(x, y, wide, p.bottom - y);
    if (n <= 16) text(p.g, String(k), x + wide / 2, y - 2, 'ink', 'center', 'bottom');
  });
  document.getElementById('bars').setAttribute('aria-label',
    'Iterations of each window: ' + R.iterations.join(', '));
}

function drawResidual() {
  const n = R.iterations.length, most = Math.max(...R.iterations, 2), every = Math.ceil(most / 10);
  const places = Array.from({length: most}, (_, i) => i + 1).filter(i => every === 1 || i % every === 0);
  const p = axes('residual', [1, most, places], [1e-14, 1e4], 'iteration', '|H(x) \u2212 x|, in the same unit', true);
  const ends = [];
  let from = 0;
  p.line([1, most], [S.tolerance, S.tolerance], 'soft', 1, [6, 4]);
  text(p.g, 'tolerance', p.left + 4, p.Y(S.tolerance) + 4, 'soft', 'left', 'top');
  R.iterations.forEach((k, i) => {
    const xs = Array.from({length: k}, (_, j) => j + 1), ys = R.residuals.subarray(from, from + k);
    const marked = i === 0 || i === n - 1;
    p.g.globalAlpha = marked ? 1 : .4;
    p.line(xs, ys, i === n - 1 && n > 1 ? 'count' : 'ink', marked ? 2 : 1);
    p.dots(xs, ys, i === n - 1 && n > 1 ? 'count' : 'ink', marked ? 2.4 : 1.6);
    ends.push([xs[k - 1], ys[k - 1]]);
    from += k;
  });
  p.g.globalAlpha = 1;
  text(p.g, n > 1 ? 'first window' : 'the window', p.right, 2, 'ink', 'right', 'top');
  if (n > 1) text(p.g, 'last window', p.right - 82, 2, 'count', 'right', 'top');
  document.getElementById('residual').setAttribute('aria-label',
    `Residual of each iteration, logarithmic, down to the tolerance ${S.tolerance}`);
}

function draw() {
  if (!R) return;
  drawScene();
  drawTime();
  drawError();
  drawBars();
  drawResidual();
}
