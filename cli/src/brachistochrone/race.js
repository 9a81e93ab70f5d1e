// The page of the fastest motion: two machines under one clock.

const byId = (id) => document.getElementById(id);

class Race {
  constructor() {
    const data = JSON.parse(byId('data').textContent);
    const runners = ['fastest', 'free'].filter((name) => data[name]);
    this.motions = runners.map((name) => new Motion(data[name]));
    this.drawings = runners.map((name, index) => {
      const drawing = new Drawing(byId(name), data.picture, this.motions[index]);
      drawing.names = true;
      drawing.trail = 1;
      return drawing;
    });
    // One scale for both, so that they can be compared.
    const shown = this.drawings.flatMap(({ view }) => view.shown);
    this.drawings.forEach(({ view }) => view.reset(shown));
    [this.motion] = this.motions;
    this.plots = data.panels.map((panel) => new Plot(panel, this.motion, (t) => this.seek(t)));
    byId('plots').append(...this.plots.map((plot) => plot.element));
    this.t = this.motion.from;
    this.playing = false;
    this.speed = 1;
    this.before = null;
    this.connect();
    this.readFragment();
    this.layOut();
    requestAnimationFrame((now) => this.frame(now));
  }

  seek(t) {
    this.t = Math.min(Math.max(t, this.motion.from), this.motion.to);
    this.dirty = true;
  }

  setPlaying(playing) {
    if (playing && this.t === this.motion.to) this.seek(this.motion.from);
    this.playing = playing;
    this.before = null;
    byId('play').textContent = playing ? 'Pause' : 'Play';
    byId('play').setAttribute('aria-pressed', String(playing));
  }

  frame(now) {
    if (this.playing) {
      // After a pause of the browser's own the machines go on where they were.
      const passed = this.before === null ? 0 : Math.min((now - this.before) / 1000, 0.25);
      this.before = now;
      const { from, to, duration } = this.motion;
      let t = this.t + passed * this.speed;
      if (t >= to && byId('loop').checked) t = from + ((t - from) % duration);
      else if (t >= to) this.setPlaying(false);
      this.seek(t);
    }
    if (this.dirty) this.show();
    requestAnimationFrame((next) => this.frame(next));
  }

  show() {
    this.dirty = false;
    // One that ended early stays where it ended.
    this.drawings.forEach((drawing, index) => drawing.draw(Math.min(this.t, this.motions[index].to)));
    this.plots.forEach((plot) => plot.show(this.t));
    byId('time').value = (this.t - this.motion.from) / this.motion.duration;
    const digits = Math.max(2, Math.min(9, 3 - Math.floor(Math.log10(this.motion.duration))));
    byId('clock').textContent = `t = ${this.t.toFixed(digits)} s`;
  }

  /** `#t=1.5` in the address shows the machines at that time. */
  readFragment() {
    const t = Number(new URLSearchParams(location.hash.slice(1)).get('t') ?? NaN);
    if (Number.isFinite(t)) this.seek(t);
  }

  layOut() {
    this.drawings.forEach((drawing) => drawing.resize());
    this.plots.forEach((plot) => plot.build());
    this.show();
  }

  connect() {
    byId('play').addEventListener('click', () => this.setPlaying(!this.playing));
    byId('time').addEventListener('input', (event) => {
      this.seek(this.motion.from + Number(event.target.value) * this.motion.duration);
    });
    const speeds = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
    const slow = speeds.filter((speed) => this.motion.duration / speed >= 3);
    this.speed = Math.min(slow.length ? Math.max(...slow) : speeds[0], 1);
    const select = byId('speed');
    for (const speed of speeds) {
      const label = speed < 1 ? `1/${Math.round(1 / speed)}` : `${speed}`;
      select.append(html('option', { value: speed }, `${label} ×`));
    }
    select.value = this.speed;
    select.addEventListener('change', () => { this.speed = Number(select.value); });
    byId('labels').addEventListener('change', (event) => {
      this.drawings.forEach((drawing) => { drawing.names = event.target.checked; });
      this.dirty = true;
    });
    const root = document.documentElement;
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    const isDark = () => (root.dataset.theme ? root.dataset.theme === 'dark' : dark.matches);
    const repaint = () => {
      byId('theme').textContent = isDark() ? 'Light' : 'Dark';
      this.drawings.forEach((drawing) => drawing.recolour());
      this.dirty = true;
    };
    byId('theme').addEventListener('click', () => {
      root.dataset.theme = isDark() ? 'light' : 'dark';
      repaint();
    });
    dark.addEventListener('change', repaint);
    repaint();
    window.addEventListener('hashchange', () => this.readFragment());
    new ResizeObserver(() => this.layOut()).observe(document.querySelector('.pair'));
  }
}

const race = new Race();

// For those who want to drive the page, a test among them.
byId('fastest').report = Object.freeze({
  get t() { return race.t; },
  seek: (t) => race.seek(t),
  /** The mass centres of both machines at time `t`, in m. */
  positions: (t) => race.motions.map((motion) => {
    const { picture } = race.drawings[0];
    const x = motion.values(Math.min(t, motion.to));
    return picture.bodies.map((body) => Array.from(x.slice(body.at, body.at + picture.dimension)));
  }),
});
