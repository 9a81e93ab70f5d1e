// Operates every control of a report, and writes the observations into the page.

const canvas = document.getElementById('scene');
const { report } = canvas;
const data = JSON.parse(document.getElementById('data').textContent);
const asked = JSON.parse(document.getElementById('asked').textContent);
const byId = (id) => document.getElementById(id);
const checks = [];
const check = (what, holds, ...seen) => checks.push({ what, holds: Boolean(holds), seen: seen.map(String) });

const frames = async (count) => {
  for (let i = 0; i < count; i++) await new Promise((done) => requestAnimationFrame(done));
};
const picture = async () => {
  await frames(2);
  return canvas.toDataURL();
};
const press = (key, options = {}, target = document.body) =>
  target.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true, ...options }));
const set = (id, value, kind = 'input') => {
  byId(id).value = value;
  byId(id).dispatchEvent(new Event(kind, { bubbles: true }));
};
const near = (a, b, scale) => Math.abs(a - b) <= 1e-9 * Math.max(Math.abs(scale), 1e-300);
const pointer = (target, type, x, y, buttons = 1, more = {}) => target.dispatchEvent(
  new PointerEvent(type, { pointerId: 1, clientX: x, clientY: y, buttons, bubbles: true, cancelable: true, ...more }),
);
const drag = (from, to, more) => {
  const box = canvas.getBoundingClientRect();
  pointer(canvas, 'pointerdown', box.left + from[0], box.top + from[1], 1, more);
  pointer(canvas, 'pointermove', box.left + to[0], box.top + to[1], 1, more);
  pointer(canvas, 'pointerup', box.left + to[0], box.top + to[1], 0, more);
};
// Synthetic pointer events have no pointer that could be captured.
Element.prototype.setPointerCapture = () => {};

const { from, to } = data;
const duration = to - from;

async function pressEverything() {
  await frames(3);
  check('starts at the beginning, and waits', report.t === from && byId('play').textContent === 'Play', report.t);
  const first = await picture();

  // Play and pause.
  byId('play').click();
  await frames(20);
  check('plays', (report.t - from) / duration > 0, report.t);
  check('says so', byId('play').textContent === 'Pause' && byId('play').getAttribute('aria-pressed') === 'true');
  byId('play').click();
  const stopped = report.t;
  const still = await picture();
  check('moves what is drawn', still !== first);
  check('pauses', (await picture()) === still && report.t === stopped, report.t, stopped);

  // The speed is that of the clock times the chosen factor.
  const measure = async (speed) => {
    set('speed', speed, 'change');
    report.seek(from);
    report.play();
    await frames(2);
    const [t, now] = [report.t, await new Promise((done) => requestAnimationFrame(done))];
    const reached = report.t;
    await frames(15);
    const later = await new Promise((done) => requestAnimationFrame(done));
    const rate = Math.abs(report.t - reached) / ((later - now) / 1000);
    report.pause();
    return [rate / speed, t];
  };
  const slow = Math.abs(duration) > 1 ? 0.5 : 0.05;
  for (const speed of [slow, slow / 5]) {
    const [ratio] = await measure(speed);
    check(`runs at ${speed} of the clock`, Math.abs(ratio - 1) < 0.1, ratio);
  }

  // The slider and the cursors.
  for (const share of [0.25, 0.75, 1, 0]) {
    set('time', share);
    check(`scrubs to ${share}`, near(report.t, from + share * duration, duration), report.t);
    await frames(2);
    for (const plot of document.querySelectorAll('.plot')) {
      const cursor = plot.querySelector('.cursor');
      const frame = plot.querySelector('.box');
      const [left, width] = ['x', 'width'].map((name) => Number(frame.getAttribute(name)));
      const along = (Number(cursor.getAttribute('x1')) - left) / width;
      check('the cursor follows', Math.abs(along - (duration > 0 ? share : 1 - share)) < 1e-9, along, share);
    }
  }

  // The keyboard.
  press('End');
  check('End', report.t === to, report.t);
  press('Home');
  check('Home', report.t === from, report.t);
  press('ArrowRight');
  check('→', near(report.t, from + duration / 200, duration), report.t);
  press('ArrowRight', { shiftKey: true });
  press('ArrowLeft');
  check('Shift →, ←', near(report.t, from + duration / 20, duration), report.t);
  press(' ');
  await frames(3);
  check('Space plays', byId('play').textContent === 'Pause');
  press(' ');
  check('Space pauses', byId('play').textContent === 'Play');
  const kept = report.t;
  press('End', {}, byId('speed'));
  check('keys of a control are left to it', report.t === kept, report.t);

  // The ends of the run.
  set('speed', 1, 'change');
  for (const loop of [false, true]) {
    if (byId('loop').checked !== loop) byId('loop').click();
    report.seek(to - 0.001 * duration);
    report.play();
    await frames(loop ? 6 : 20);
    const there = report.t;
    report.pause();
    check(loop ? 'loops' : 'stops at the end', loop ? there !== to : there === to, there);
  }
  report.seek(to);
  report.play();
  await frames(3);
  check('plays again from the beginning', Math.abs(report.t - from) < 0.9 * Math.abs(duration), report.t);
  report.pause();

  // Rotating, moving, zooming.
  report.seek(from + 0.4 * duration);
  const middle = await picture();
  const before = report.positions(report.t).flat();
  const views = [middle];
  const ways = [
    ['across', [260, 200], {}],
    ['down', [200, 260], {}],
    ['with Shift', [260, 200], { shiftKey: true }],
  ];
  for (const [way, end, keys] of ways) {
    drag([200, 200], end, keys);
    const dragged = await picture();
    // In the plane Shift makes no difference.
    const same = data.picture.dimension === 2 && way === 'with Shift';
    check(`a drag ${way} moves or turns the view`, views.includes(dragged) === same);
    views.push(dragged);
    drag(end, [200, 200], keys);
    check('and back', (await picture()) === middle);
  }
  check('but not the machine', report.positions(report.t).flat().every((x, i) => x === before[i]));
  drag([200, 200], [260, 230]);
  byId('fit').click();
  check('Fit shows all again', (await picture()) === middle);
  canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: -300, clientX: 300, clientY: 300, bubbles: true, cancelable: true }));
  check('the wheel zooms', (await picture()) !== middle);
  canvas.dispatchEvent(new MouseEvent('dblclick', { bubbles: true }));
  check('a double click fits', (await picture()) === middle);
  const box = canvas.getBoundingClientRect();
  const finger = (id, type, x, y) => pointer(canvas, type, box.left + x, box.top + y, 1, { pointerId: id });
  finger(1, 'pointerdown', 200, 200);
  finger(2, 'pointerdown', 300, 200);
  finger(2, 'pointermove', 380, 200);
  finger(1, 'pointerup', 200, 200);
  finger(2, 'pointerup', 380, 200);
  check('two fingers zoom', (await picture()) !== middle);
  byId('fit').click();

  // Optional elements.
  for (const id of ['labels', 'axes']) {
    // A machine without frames has no axes to show.
    const shows = id === 'labels' || data.picture.frames.length > 0;
    byId(id).click();
    check(`shows ${id}`, ((await picture()) !== middle) === shows);
    byId(id).click();
    check(`hides ${id}`, (await picture()) === middle);
  }
  const trail = byId('trail').value;
  set('trail', 1);
  check('longer trails', (await picture()) !== middle);
  set('trail', trail);
  set('follow', String(data.picture.bodies.length - 1), 'change');
  check('follows a body', (await picture()) !== middle);
  set('follow', '', 'change');
  check('follows nothing', (await picture()) === middle);

  // Light and dark.
  const paper = () => getComputedStyle(document.documentElement).backgroundColor;
  const light = paper();
  byId('theme').click();
  check('the other theme', paper() !== light && (await picture()) !== middle, paper());
  byId('theme').click();
  check('the first theme', paper() === light && (await picture()) === middle, paper());

  // Printing uses a sharper, light picture.
  const width = canvas.width;
  window.dispatchEvent(new Event('beforeprint'));
  check('prints sharply', canvas.width === 2100 && canvas.height === 1320, canvas.width);
  window.dispatchEvent(new Event('afterprint'));
  check('and goes back', canvas.width === width && (await picture()) === middle);

  // A click in a plot.
  for (const plot of document.querySelectorAll('.plot')) {
    const frame = plot.querySelector('.box').getBoundingClientRect();
    pointer(plot, 'pointerdown', frame.left + 0.3 * frame.width, frame.top + 5);
    const wanted = Math.min(from, to) + 0.3 * Math.abs(duration);
    // The outline of the frame is a pixel wide.
    check('a click in a plot goes there', Math.abs(report.t - wanted) < (2 / frame.width) * Math.abs(duration), report.t, wanted);
  }
  const curve = document.querySelector('.legend button');
  const drawn = () => document.querySelector('.plot .curve').getAttribute('d');
  const path = drawn();
  check('a curve is drawn', path.length > 10);
  curve.click();
  check('a click on its name hides it', drawn() === '' && curve.getAttribute('aria-pressed') === 'false');
  curve.click();
  check('and shows it', drawn() === path);

  // The fragment of the address.
  location.hash = `#t=${from + 0.6 * duration}`;
  await frames(3);
  check('the fragment sets the time', near(report.t, from + 0.6 * duration, duration), report.t);
  location.hash = '#t=nonsense';
  await frames(3);
  check('nonsense does not', Number.isFinite(report.t), report.t);

  // However narrow the window is, nothing extends beyond it.
  const [needs, has] = [document.documentElement.scrollWidth, window.innerWidth];
  check('fits the window', needs <= has, needs, has);

  // Everything that can be operated has a name.
  for (const control of document.querySelectorAll('button, input, select, canvas')) {
    const label = control.getAttribute('aria-label') ?? control.closest('label')?.textContent ?? control.textContent;
    check('a control has a name', label.trim() !== '', control.outerHTML);
  }
}

let ended = null;
try {
  await pressEverything();
} catch (error) {
  ended = `${error}\n${error.stack}`;
}
const verdict = document.createElement('pre');
verdict.id = 'verdict';
verdict.textContent = JSON.stringify({
  ended,
  wrong: window.wrong,
  failed: checks.filter((one) => !one.holds),
  count: checks.length,
  width: window.innerWidth,
  positions: asked.map((t) => report.positions(t)),
});
document.body.append(verdict);
