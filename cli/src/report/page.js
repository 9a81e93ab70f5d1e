// The controls of the page.

const byId = (id) => document.getElementById(id);

class Player {
  constructor() {
    const data = JSON.parse(byId('data').textContent);
    this.motion = new Motion(data);
    this.canvas = byId('scene');
    this.drawing = new Drawing(this.canvas, data.picture, this.motion);
    this.plots = data.panels.map((panel) => new Plot(panel, this.motion, (t) => this.seek(t)));
    this.drawing.bear(this.plots.flatMap((plot) => plot.curves), data.impacts);
    byId('plots').append(...this.plots.map((plot) => plot.element));
    this.t = this.motion.from;
    this.playing = false;
    this.speed = 1;
    this.dirty = true;
    this.before = null;
    this.numbersAt = 0;
    this.connect();
    this.connectPointer();
    this.connectKeys();
    this.connectPage();
    this.layOut();
    this.readFragment();
    requestAnimationFrame((now) => this.frame(now));
  }

  get length() {
    return Math.abs(this.motion.duration);
  }

  /** Shows the machine at time `t`, or at the nearer end of the run if `t` is outside it. */
  seek(t) {
    const { from, to } = this.motion;
    if (!Number.isFinite(t)) return;
    this.t = Math.min(Math.max(t, Math.min(from, to)), Math.max(from, to));
    this.numbersAt = 0;
    this.dirty = true;
  }

  play() {
    if (this.length === 0) return;
    if (this.t === this.motion.to) this.seek(this.motion.from);
    this.playing = true;
    this.before = null;
    this.showPlaying();
  }

  pause() {
    this.playing = false;
    this.numbersAt = 0;
    this.dirty = true;
    this.showPlaying();
  }

  showPlaying() {
    byId('play').textContent = this.playing ? 'Pause' : 'Play';
    byId('play').setAttribute('aria-pressed', String(this.playing));
  }

  /** Draws one picture if something has changed. */
  frame(now) {
    if (this.playing) this.advance(now);
    if (this.dirty) this.show(now);
    requestAnimationFrame((next) => this.frame(next));
  }

  advance(now) {
    // After the browser has paused the page, the motion continues from where it was.
    const passed = this.before === null ? 0 : Math.min((now - this.before) / 1000, 0.25);
    this.before = now;
    const { from, to, duration } = this.motion;
    let done = (this.t - from) / duration + (passed * this.speed) / this.length;
    if (done >= 1) {
      if (byId('loop').checked) done %= 1;
      else {
        this.t = to;
        this.pause();
        return;
      }
    }
    this.t = from + done * duration;
    this.dirty = true;
  }

  show(now) {
    this.dirty = false;
    this.drawing.draw(this.t);
    const numbers = !this.playing || now - this.numbersAt > 120;
    if (numbers) this.numbersAt = now;
    this.plots.forEach((plot) => plot.show(this.t, numbers));
    const slider = byId('time');
    slider.value = this.length === 0 ? 0 : (this.t - this.motion.from) / this.motion.duration;
    const digits = Math.max(2, Math.min(9, 3 - Math.floor(Math.log10(this.length || 1))));
    const text = `t = ${this.t.toFixed(digits).replaceAll('-', '−')} s`;
    byId('clock').textContent = text;
    slider.setAttribute('aria-valuetext', text);
  }

  layOut() {
    this.drawing.resize();
    this.plots.forEach((plot) => plot.build());
    // Draw at once, because resizing clears a canvas.
    this.show(performance.now());
  }

  connect() {
    const { drawing, motion } = this;
    byId('play').disabled = byId('time').disabled = this.length === 0;
    byId('play').addEventListener('click', () => (this.playing ? this.pause() : this.play()));
    byId('time').addEventListener('input', (event) => {
      this.seek(motion.from + Number(event.target.value) * motion.duration);
    });
    this.connectSpeed();
    const trail = byId('trail');
    const setTrail = () => {
      // The square gives short trails more of the slider's range.
      drawing.trail = Number(trail.value) ** 2;
      this.dirty = true;
    };
    trail.addEventListener('input', setTrail);
    trail.value = 0.4;
    setTrail();
    const check = (id, set) => byId(id).addEventListener('change', (event) => {
      set(event.target.checked);
      this.dirty = true;
    });
    check('labels', (on) => { drawing.names = on; });
    check('axes', (on) => { drawing.frames = on; });
    if (byId('forces')) check('forces', (on) => { drawing.showsForces = on; });
    const follow = byId('follow');
    drawing.picture.bodies.forEach((body, index) => {
      follow.append(html('option', { value: index }, body.name));
    });
    follow.addEventListener('change', () => {
      drawing.follow = follow.value === '' ? null : Number(follow.value);
      this.dirty = true;
    });
    const fit = () => {
      drawing.view.reset();
      this.dirty = true;
    };
    byId('fit').addEventListener('click', fit);
    this.canvas.addEventListener('dblclick', fit);
    byId('hint').textContent = drawing.picture.dimension === 3
      ? 'Drag to turn, with Shift to move, wheel to zoom. Space plays, ← and → step, Home and End go to the ends.'
      : 'Drag to move, wheel to zoom. Space plays, ← and → step, Home and End go to the ends.';
  }

  /** Speeds from slow to fast motion; initially one at which the run takes a few seconds. */
  connectSpeed() {
    const speeds = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
    const select = byId('speed');
    for (const speed of speeds) {
      const label = speed < 1 ? `1/${Math.round(1 / speed)}` : `${speed}`;
      select.append(html('option', { value: speed }, `${label} ×`));
    }
    const slow = speeds.filter((speed) => this.length / speed >= 4);
    this.speed = Math.min(slow.length ? Math.max(...slow) : speeds[0], 1);
    select.value = this.speed;
    // An impulse is visible for a sixth of a second.
    const setSpeed = () => {
      this.speed = Number(select.value);
      this.drawing.glow = this.speed / 6;
      this.dirty = true;
    };
    select.addEventListener('change', setSpeed);
    setSpeed();
  }

  /** Rotating, moving and zooming, with a mouse or with fingers. */
  connectPointer() {
    const { canvas, drawing: { view } } = this;
    const spatial = view.dimension === 3;
    // In the plane one finger scrolls the page, and two change the view.
    canvas.style.touchAction = spatial ? 'none' : 'pan-y';
    const fingers = new Map();
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    });
    const lift = (event) => fingers.delete(event.pointerId);
    canvas.addEventListener('pointerup', lift);
    canvas.addEventListener('pointercancel', lift);
    canvas.addEventListener('pointermove', (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const now = [event.offsetX, event.offsetY];
      const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
      fingers.set(event.pointerId, now);
      if (fingers.size === 2) {
        const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
        const apart = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
        view.zoomAt((now[0] + other[0]) / 2, (now[1] + other[1]) / 2, apart(now) / apart(before));
        view.pan(dx / 2, dy / 2);
      } else if (spatial && !event.shiftKey && !(event.buttons & 2)) {
        view.turn(-0.008 * dx, 0.008 * dy);
      } else {
        view.pan(dx, dy);
      }
      this.dirty = true;
    });
    canvas.addEventListener('contextmenu', (event) => { if (spatial) event.preventDefault(); });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      view.zoomAt(event.offsetX, event.offsetY, Math.exp(-0.0015 * event.deltaY));
      this.dirty = true;
    }, { passive: false });
  }

  connectKeys() {
    document.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      // Controls use these keys themselves.
      if (event.target.closest?.('input, select, button, a, summary')) return;
      const step = this.motion.duration / (event.shiftKey ? 20 : 200);
      const keys = {
        ' ': () => (this.playing ? this.pause() : this.play()),
        ArrowRight: () => this.seek(this.t + step),
        ArrowLeft: () => this.seek(this.t - step),
        Home: () => this.seek(this.motion.from),
        End: () => this.seek(this.motion.to),
      };
      if (!(event.key in keys)) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  /** Theme, printing, the size of the window, and the fragment of the address. */
  connectPage() {
    const root = document.documentElement;
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    const isDark = () => (root.dataset.theme ? root.dataset.theme === 'dark' : dark.matches);
    const repaint = () => {
      byId('theme').textContent = isDark() ? 'Light' : 'Dark';
      this.drawing.recolour();
      this.dirty = true;
    };
    byId('theme').addEventListener('click', () => {
      root.dataset.theme = isDark() ? 'light' : 'dark';
      repaint();
    });
    dark.addEventListener('change', repaint);
    repaint();
    byId('print').addEventListener('click', () => window.print());
    // For printing, the picture is light and has the resolution of a printer.
    let theme;
    window.addEventListener('beforeprint', () => {
      theme = root.dataset.theme;
      root.dataset.theme = 'light';
      this.drawing.recolour();
      this.drawing.resize(3, 700, 440);
      this.drawing.stamp = byId('clock').textContent;
      this.drawing.draw(this.t);
      // The width for two columns.
      this.plots.forEach((plot) => plot.build(340));
    });
    window.addEventListener('afterprint', () => {
      this.drawing.stamp = '';
      if (theme === undefined) delete root.dataset.theme; else root.dataset.theme = theme;
      repaint();
      this.layOut();
    });
    new ResizeObserver(() => {
      if (!window.matchMedia('print').matches) this.layOut();
    }).observe(this.canvas.parentElement);
    window.addEventListener('hashchange', () => this.readFragment());
  }

  /** `#t=1.5` in the address shows the machine at that time. */
  readFragment() {
    const t = new URLSearchParams(location.hash.slice(1)).get('t');
    if (t !== null) this.seek(Number(t));
  }
}

const player = new Player();

// For scripts and tests that control the page: the interface is a property of the canvas, and nothing is global.
player.canvas.report = Object.freeze({
  get t() { return player.t; },
  seek: (t) => player.seek(t),
  play: () => player.play(),
  pause: () => player.pause(),
  /** The mass centres at time `t`, in m. */
  positions: (t) => {
    const { picture } = player.drawing;
    const x = player.motion.values(t);
    return picture.bodies.map((body) => Array.from(x.slice(body.at, body.at + picture.dimension)));
  },
  /** The contact forces that are drawn at time `t`, in N, and impulses, in N s, with their points of action. */
  forces: (t) => {
    const { drawing, motion } = player;
    return drawing.contactForces(t, motion.values(t)).map(({ name, point, force, unit: of }) => ({ name, point, force, unit: of }));
  },
});
