// The curves: one SVG for each group, with a cursor at the time shown.

const SVG = 'http://www.w3.org/2000/svg';

function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

function html(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** A quantity along the run: from the states, or with points of its own. */
class Curve {
  constructor(description, motion) {
    this.name = description.name;
    this.motion = motion;
    this.shown = true;
    this.live = description.live;
    const { coordinate, rate } = description;
    if (coordinate !== undefined || rate !== undefined) {
      this.index = coordinate ?? rate;
      this.isRate = rate !== undefined;
    } else {
      this.times = floats(description.times);
      const [stored, base] = [floats(description.values), description.base];
      this.values = base ? Float64Array.from(stored, (x) => x + base) : stored;
    }
  }

  /** Its value at time `t`. */
  at(t) {
    const { motion, times, values } = this;
    if (!times) {
      motion.state(t);
      return (this.isRate ? motion.v : motion.q)[this.index];
    }
    const forward = motion.duration >= 0;
    let [low, high] = [0, times.length - 1];
    if (high < 0) return NaN;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if ((times[middle] <= t) === forward) low = middle; else high = middle;
    }
    const span = times[high] - times[low];
    const share = span === 0 ? 0 : Math.min(Math.max((t - times[low]) / span, 0), 1);
    // A value beside a gap, where there are no numbers, is still a number.
    if (share === 0 || share === 1) return values[share === 0 ? low : high];
    return values[low] + share * (values[high] - values[low]);
  }

  /** The points that draw it on this many pixels: the minimum and maximum of every interval, or the cubics
   * between a few states. */
  points(pixels) {
    const { motion, times, values } = this;
    if (times) return Array.from(times, (t, i) => [t, values[i]]);
    const { count, n, states } = motion;
    const offset = (this.isRate ? n : 0) + this.index;
    const stored = (i) => [motion.time(i), states[2 * n * i + offset]];
    if (count <= pixels) {
      const between = Math.max(1, Math.ceil(pixels / 2 / count));
      const points = [];
      for (let i = 0; i < count; i++) {
        points.push(stored(i));
        const [start, end] = [motion.time(i), motion.time(Math.min(i + 1, count - 1))];
        for (let k = 1; k < between && i + 1 < count; k++) {
          const t = start + ((end - start) * k) / between;
          points.push([t, this.at(t)]);
        }
      }
      return points;
    }
    const stretch = Math.ceil(count / pixels);
    const points = [];
    for (let first = 0; first < count; first += stretch) {
      let [low, high] = [first, first];
      for (let i = first; i < Math.min(first + stretch, count); i++) {
        const value = states[2 * n * i + offset];
        if (value < states[2 * n * low + offset]) low = i;
        if (value > states[2 * n * high + offset]) high = i;
      }
      points.push(stored(Math.min(low, high)));
      if (low !== high) points.push(stored(Math.max(low, high)));
    }
    points.push(stored(count - 1));
    return points;
  }
}

/** Curves that share an axis. */
class Plot {
  constructor(panel, motion, seek) {
    this.motion = motion;
    this.seek = seek;
    this.rounding = panel.rounding ?? 0;
    this.curves = panel.curves.map((curve) => new Curve(curve, motion));
    this.svg = svg('svg', { class: 'plot', role: 'img', 'aria-label': `${panel.label} over time` });
    this.legend = html('div', { class: this.curves.length > 12 ? 'legend many' : 'legend' });
    this.values = this.curves.map((curve, index) => {
      const value = html('span', { class: 'value' });
      const swatch = html('span', { class: 'swatch', style: `color: ${this.colour(index)}` });
      const button = html('button', { type: 'button', 'aria-pressed': 'true', title: 'Show or hide' }, swatch, curve.name, value);
      button.addEventListener('click', () => {
        curve.shown = !curve.shown;
        button.setAttribute('aria-pressed', String(curve.shown));
        this.build();
      });
      this.legend.append(button);
      return value;
    });
    this.element = html('figure', {}, html('figcaption', {}, panel.label), this.svg, this.legend);
    const point = (event) => {
      const box = this.svg.getBoundingClientRect();
      const across = ((event.clientX - box.left) / box.width) * this.width;
      const share = (across - this.left) / (this.width - this.left - this.rightMargin);
      this.seek(this.early + Math.min(Math.max(share, 0), 1) * (this.late - this.early));
    };
    this.svg.addEventListener('pointerdown', (event) => {
      this.svg.setPointerCapture(event.pointerId);
      point(event);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) point(event);
    });
  }

  colour(index) {
    return seriesColour(index, this.curves.length);
  }

  /** Lays the plot out for its present width. */
  build(width = this.element.clientWidth || 600) {
    Object.assign(this, { width, left: 62, rightMargin: 8, top: 6, height: 150, foot: 20 });
    const { motion, left, top, height, foot } = this;
    const right = width - this.rightMargin;
    const bottom = height - foot;
    [this.early, this.late] = [Math.min(motion.from, motion.to), Math.max(motion.from, motion.to)];
    if (this.late === this.early) this.late += 1;
    const shown = this.curves.map((curve) => (curve.shown ? curve.points(right - left) : []));
    let [low, high] = [Infinity, -Infinity];
    for (const points of shown) {
      for (const [, value] of points) {
        if (!Number.isFinite(value)) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (!(low <= high)) [low, high] = [0, 1];
    // A curve that only varies by round-off is drawn as a constant.
    const largest = Math.max(Math.abs(low), Math.abs(high));
    const constant = largest > this.rounding ? 0.1 * largest : 1;
    const margin = high - low > this.rounding ? 0.06 * (high - low) : constant;
    [low, high] = [low - margin, high + margin];
    this.x = (t) => left + ((right - left) * (t - this.early)) / (this.late - this.early);
    const y = (value) => bottom - ((bottom - top) * (value - low)) / (high - low);

    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.svg.replaceChildren();
    const digits = (step, size) => Math.max(2, Math.min(8, Math.ceil(Math.log10(size / step)) + 1));
    const ticks = (from, to, most, place) => {
      const step = round125(((to - from) / most) * 2.4);
      const size = Math.max(Math.abs(from), Math.abs(to));
      for (let k = Math.ceil(from / step); k <= Math.floor(to / step); k++) {
        place(k * step, figure(k === 0 ? 0 : k * step, digits(step, size)));
      }
    };
    ticks(low, high, 5, (value, label) => {
      this.svg.append(svg('line', { class: 'tick', x1: left, x2: right, y1: y(value), y2: y(value) }));
      this.svg.append(svg('text', { x: left - 5, y: y(value) + 4, 'text-anchor': 'end' }, label));
    });
    ticks(this.early, this.late, Math.max(2, (right - left) / 45), (t, label) => {
      this.svg.append(svg('line', { class: 'tick', x1: this.x(t), x2: this.x(t), y1: top, y2: bottom }));
      if (this.x(t) < right - 36) {
        this.svg.append(svg('text', { x: this.x(t), y: height - 6, 'text-anchor': 'middle' }, label));
      }
    });
    this.svg.append(svg('text', { x: right, y: height - 6, 'text-anchor': 'end' }, 't [s]'));
    this.svg.append(svg('rect', { class: 'box', x: left, y: top, width: right - left, height: bottom - top }));
    shown.forEach((points, index) => {
      let path = '';
      let pen = false;
      for (const [t, value] of points) {
        if (Number.isFinite(value)) path += `${pen ? 'L' : 'M'}${this.x(t).toFixed(1)} ${y(value).toFixed(1)}`;
        pen = Number.isFinite(value);
      }
      this.svg.append(svg('path', { class: 'curve', d: path, style: `stroke: ${this.colour(index)}` }));
    });
    this.cursor = svg('line', { class: 'cursor', y1: top, y2: bottom });
    this.svg.append(this.cursor);
    this.show(this.t ?? motion.from);
  }

  /** Moves the cursor; updating the numbers beside the names is slower, and may be postponed. */
  show(t, numbers = true) {
    this.t = t;
    this.cursor.setAttribute('x1', this.x(t));
    this.cursor.setAttribute('x2', this.x(t));
    if (!numbers) return;
    this.curves.forEach((curve, index) => { this.values[index].textContent = figure(curve.at(t), 4); });
  }
}
