// Draws the machine on a canvas.

/** Colours of the style sheet in the form that a canvas needs; read again when the theme changes. */
class Palette {
  constructor() {
    this.probe = document.createElement('span');
    this.probe.hidden = true;
    document.body.append(this.probe);
    this.read();
  }

  read() {
    const colour = (css) => {
      this.probe.style.color = css;
      return getComputedStyle(this.probe).color;
    };
    for (const name of ['paper', 'panel', 'ink', 'muted', 'line', 'grid', 'accent', 'force', 'impact']) {
      this[name] = colour(`var(--${name})`);
    }
    this.series = (index, count) => colour(seriesColour(index, count));
  }
}

/** The colour of one member of a family: from a few distinct colours, or from a ramp of hues for a large family. */
function seriesColour(index, count) {
  if (count <= 8) return `var(--c${index})`;
  return `hsl(${Math.round(210 + (290 * index) / count) % 360} 65% var(--ramp))`;
}

/** The whole drawing, from the picture that the page holds; see scene.rs for the meaning of its fields. */
class Drawing {
  constructor(canvas, picture, motion) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.picture = picture;
    this.motion = motion;
    this.palette = new Palette();
    this.names = false;
    this.frames = false;
    this.showsForces = true;
    this.forces = [];
    this.impacts = null;
    /** How long the impulse of an impact stays visible, in s of the run. */
    this.glow = 0;
    this.trail = 0;
    this.follow = null;
    this.stamp = '';
    const gravity = picture.gravity === null ? null : this.vector(motion.values(motion.from), picture.gravity);
    const down = gravity && Math.hypot(...gravity) > 0 ? unit(gravity) : null;
    this.view = new View(picture.dimension, down ? down.map((x) => -x) : [0, 0, 1]);
    this.arrangeElements();
    this.arrangeBodies();
    this.measure();
    this.tracePaths();
    this.recolour();
  }

  /** The vector of the values at a place, always with three components. */
  vector(x, place) {
    return [x[place], x[place + 1], this.picture.dimension === 3 ? x[place + 2] : 0];
  }

  /** One of the axes that begin at a place. */
  axis(x, place, index) {
    return this.vector(x, place + index * this.picture.dimension);
  }

  /** The position of a point given in a body's axes. */
  inBody(x, body, local) {
    let point = this.vector(x, body.at);
    if (body.axes === null) return along(point, 1, [...local, 0].slice(0, 3));
    local.forEach((s, k) => { point = along(point, s, this.axis(x, body.axes, k)); });
    return point;
  }

  recolour() {
    this.palette.read();
    const { bodies } = this.picture;
    this.colours = bodies.map((_, index) => this.palette.series(index, bodies.length));
  }

  /** Draws several springs and dampers at the same place side by side. */
  arrangeElements() {
    const groups = new Map();
    for (const element of this.picture.elements) {
      const key = JSON.stringify({ ...element, name: '', damper: false });
      groups.set(key, [...(groups.get(key) ?? []), element]);
    }
    for (const group of groups.values()) {
      group.forEach((element, index) => { element.beside = index - (group.length - 1) / 2; });
    }
  }

  /** Bodies that surround the centre of a smaller one, such as a gimbal around its rotor, are drawn as wire frames. Also finds the bodies
   * without an outline. */
  arrangeBodies() {
    const { bodies, circles } = this.picture;
    const size = ({ solid }) => Math.hypot(solid.radius ?? 0, ...[solid.half ?? 0].flat());
    bodies.forEach((body, index) => {
      const others = bodies.filter((other) => other !== body && other.solid && other.at === body.at);
      body.hollow = body.solid !== null && others.some((other) => size(other) < size(body));
      body.bare = body.solid === null && !circles.some((circle) => circle.body === index);
    });
  }

  /** The points that a picture must show, with the margin that each needs. */
  extent(x) {
    const { picture } = this;
    const points = [];
    const add = (point, radius = 0) => points.push([point, radius]);
    for (const body of picture.bodies) {
      const { solid } = body;
      const size = solid?.half?.length ? Math.hypot(...solid.half) : Math.hypot(solid?.radius ?? 0, solid?.half ?? 0);
      add(this.vector(x, body.at), size);
      solid?.corners?.forEach((corner) => add(this.vector(x, corner)));
      if (body.rod !== null) add(this.vector(x, body.rod));
    }
    for (const link of picture.links) link.ends.forEach((end) => add(this.vector(x, end)));
    for (const circle of picture.circles) add(this.vector(x, circle.center), Math.abs(x[circle.radius]));
    for (const element of picture.elements) {
      if (element.placed === 'between') element.ends.forEach((end) => add(this.vector(x, end)));
    }
    if (points.length === 0) add(this.vector(x, picture.ground));
    return points.filter(([point, radius]) => Number.isFinite(radius) && point.every(Number.isFinite));
  }

  /** Determines the size of the motion, which sets the view, and the height of the ground. */
  measure() {
    const { motion, view } = this;
    const instants = Math.min(600, Math.max(2, motion.count));
    const shown = [];
    for (let i = 0; i <= instants; i++) {
      shown.push(...this.extent(motion.values(motion.from + (motion.duration * i) / instants)));
    }
    const range = (direction) => rangeOf(shown, direction);
    const spans = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(range).map(([low, high]) => high - low);
    this.reach = Math.max(...spans, 0) || 1;
    shown.push(...this.sketches());
    view.reset(shown);
    // The ground plane: through the origin, or below the lowest hanging point.
    const [lowest] = range(view.up);
    this.floor = lowest < -0.02 * this.reach ? lowest : 0;
  }

  /** Connects contacts with the curves of their forces, and with the impulses of their impacts. */
  bear(curves, impacts) {
    const named = new Map(curves.map((curve) => [curve.name, curve]));
    this.forces = this.picture.contacts.map((contact) => ({
      contact,
      curves: contact.forces.map((name) => named.get(name)).filter(Boolean),
    }));
    if (impacts) {
      const { times, contacts, impulses } = impacts;
      this.impacts = { times: floats(times), contacts: floats(contacts), impulses: floats(impulses) };
    }
    this.weigh();
  }

  /** Determines which force and which impulse are drawn with a fifth of the size of the motion: the 95th percentile. */
  weigh() {
    const most = (sizes) => sizes.sort((a, b) => a - b)[Math.floor(0.95 * (sizes.length - 1))] ?? 0;
    const sizes = this.forces.flatMap(({ curves }) => Array.from(curves[0]?.times ?? [], (t) => Math.hypot(...curves.map((curve) => curve.at(t)))));
    this.fullForce = most(sizes.filter((size) => size > 0));
    const { times, impulses } = this.impacts ?? { times: [], impulses: [] };
    this.fullImpulse = most(Array.from(times, (_, k) => Math.hypot(...impulses.slice(3 * k, 3 * k + 3))));
  }

  /** The point of contact, and the force with these components on the body there. */
  forceOf(x, contact, components) {
    if (contact.placed === 'line') {
      return [this.inBody(x, this.picture.bodies[contact.body], contact.foot), [...contact.force.map((f) => components[0] * f), 0]];
    }
    const force = contact.directions.reduce(
      (sum, place, k) => along(sum, components[k] ?? 0, this.vector(x, place)),
      [0, 0, 0],
    );
    return [this.vector(x, contact.point), force];
  }

  /** The contact forces at time `t`, and the impulses of recent impacts, on the body that a contact names first. */
  contactForces(t, x) {
    const found = this.forces.map(({ contact, curves }) => {
      const [point, force] = this.forceOf(x, contact, curves.map((curve) => curve.at(t)));
      return { name: contact.name, point, force, unit: 'N', full: this.fullForce, age: 0 };
    });
    if (this.impacts) {
      const { times, contacts, impulses } = this.impacts;
      // Times are stored with 24 binary digits, and an impact must be visible at its own instant.
      const [from, to] = [this.motion.from, this.motion.to];
      const late = 2 ** -22 * Math.max(Math.abs(from), Math.abs(to));
      let [first, last] = [0, times.length];
      while (first < last) {
        const middle = (first + last) >> 1;
        if (times[middle] < t - this.glow - late) first = middle + 1; else last = middle;
      }
      for (let k = first; k < times.length && times[k] <= t + late; k++) {
        const { contact } = this.forces[contacts[k]];
        const [point, force] = this.forceOf(x, contact, impulses.slice(3 * k, 3 * k + 3));
        const age = this.glow > 0 ? Math.max(t - times[k], 0) / (this.glow + late) : 0;
        found.push({ name: contact.name, point, force, unit: 'N s', full: this.fullImpulse, age });
      }
    }
    return found.filter(({ point, force, full }) => {
      const size = Math.hypot(...force);
      return size > 0 && full > 0 && Number.isFinite(size) && point.every(Number.isFinite);
    });
  }

  /** An arrow for each contact force, and for each impulse, which fades. An arrow that is longer than the picture is cut off and has no tip. */
  drawForces(t, x) {
    const { view, palette, context: c } = this;
    for (const { name, point, force, unit: of, full, age } of this.contactForces(t, x)) {
      const size = Math.hypot(...force);
      const length = (0.2 * this.reach * size) / full;
      const colour = of === 'N' ? palette.force : palette.impact;
      const tip = along(point, Math.min(length, 2 * this.reach) / size, force);
      const [start, end] = [view.project(point), view.project(tip)];
      c.globalAlpha = 1 - 0.9 * age;
      if (length > 2 * this.reach) this.line(start, end, colour, 2); else this.arrow(start, end, colour, 2);
      if (this.names) this.text(`${name} ${figure(size, 3)} ${of}`, end[0] + 6, end[1] - 6, colour);
      c.globalAlpha = 1;
    }
  }

  /** The scales of the arrows, above the scale bar. */
  drawForceScales() {
    const { view, palette } = this;
    const scales = [[this.fullForce, 'N', palette.force], [this.fullImpulse, 'N s', palette.impact]];
    let y = view.height - 42;
    for (const [full, of, colour] of scales) {
      if (!(full > 0)) continue;
      const metres = 0.2 * this.reach;
      const size = round125(((0.24 * view.width) / view.scale) * (full / metres));
      const length = (size / full) * metres * view.scale;
      this.arrow([14, y], [14 + length, y], colour, 2);
      this.text(`${figure(size, 3)} ${of}`, 14 + length / 2, y - 9, colour, 'center');
      y -= 24;
    }
  }

  /** Springs and dampers of which only the line of action is known are attached to a stand on the ground, at some distance. */
  sketches() {
    const { picture, motion } = this;
    const elements = picture.elements.filter((element) => element.placed === 'sketch');
    const x = motion.values(motion.from);
    for (const element of elements) {
      const body = picture.bodies[element.body];
      const radius = Math.max(
        body.solid?.radius ?? 0,
        ...picture.circles.filter((circle) => circle.body === element.body).map((circle) => x[circle.radius]),
        0.02 * this.reach,
      );
      const off = Math.hypot(...element.foot);
      // At the rim of the body's outline, or, if the line of action lies outside it, as far along the line as its distance from the centre.
      const edge = off < radius ? Math.sqrt(radius ** 2 - off ** 2) : off;
      element.lug = off < radius ? null : radius / Math.hypot(off, edge);
      const away = element.along.map((a) => a * element.side);
      // The direction is fixed at the start; the point then moves with the body.
      element.edge = [...away.map((a) => a * edge), 0];
      element.edgeLocal = this.toBody(x, body, element.edge);
      const foot = this.inBody(x, body, element.foot.map((f, k) => f + element.edgeLocal[k]));
      element.stand = along(foot, 0.4 * radius + 0.14 * this.reach, [...away, 0]);
    }
    return elements.map((element) => [element.stand, 0]);
  }

  /** Converts a vector from the ground's axes to those of a body. */
  toBody(x, body, vector) {
    if (body.axes === null) return vector;
    return [0, 1].map((k) => dot(vector, this.axis(x, body.axes, k)));
  }

  /** The paths of the mass centres, sampled densely enough for straight lines. */
  tracePaths() {
    const { motion, picture } = this;
    const bodies = picture.bodies;
    const most = Math.max(400_000 / Math.max(bodies.length, 1), 2);
    const steps = Math.max(motion.count - 1, 1);
    const at = (t) => {
      const x = motion.values(t);
      return bodies.map((body) => this.vector(x, body.at));
    };
    const bend = (parts) => {
      let worst = 0;
      for (let probe = 0; probe < 48; probe++) {
        const step = Math.floor((probe / 48) * steps * parts);
        const time = (s) => motion.from + (motion.duration * s) / (steps * parts);
        const [a, m, b] = [step, step + 0.5, step + 1].map((s) => at(time(s)));
        m.forEach((point, i) => {
          worst = Math.max(worst, Math.hypot(...point.map((p, k) => p - (a[i][k] + b[i][k]) / 2)));
        });
      }
      return worst;
    };
    let parts = 1;
    while (parts < 64 && steps * parts * 2 <= most && bend(parts) > 0.001 * this.reach) parts *= 2;
    this.pathSteps = steps * parts;
    this.paths = bodies.map(() => new Float32Array(3 * (this.pathSteps + 1)));
    for (let step = 0; step <= this.pathSteps; step++) {
      at(motion.from + (motion.duration * step) / this.pathSteps)
        .forEach((point, i) => this.paths[i].set(point, 3 * step));
    }
  }

  /** Fits the drawing to the canvas, or to a sheet; `sharpness` is the number of picture pixels per page pixel. */
  resize(sharpness = window.devicePixelRatio || 1, width = this.canvas.clientWidth, height = this.canvas.clientHeight) {
    const { canvas, view } = this;
    view.width = width || 640;
    view.height = height || 480;
    canvas.width = Math.round(view.width * sharpness);
    canvas.height = Math.round(view.height * sharpness);
    this.sharpness = sharpness;
  }

  /** Draws the machine at time `t`. */
  draw(t) {
    const { context: c, view, picture, palette } = this;
    const x = this.motion.values(t);
    view.center = this.follow === null ? null : this.vector(x, picture.bodies[this.follow].at);
    c.setTransform(this.sharpness, 0, 0, this.sharpness, 0, 0);
    c.fillStyle = palette.paper;
    c.fillRect(0, 0, view.width, view.height);
    c.lineJoin = 'round';
    c.lineCap = 'round';
    c.font = '12px system-ui, sans-serif';
    this.drawGround();
    this.drawTrails(t);
    // Nearer parts cover farther ones; in the plane all have the same depth, and the order stays.
    const parts = [];
    this.drawCircles(x, parts);
    this.drawSolids(x, parts);
    this.drawJoints(x, parts);
    this.drawElements(x, parts);
    parts.sort((a, b) => a.depth - b.depth);
    parts.forEach((part) => part.draw());
    this.drawCentres(x);
    if (this.showsForces) this.drawForces(t, x);
    if (this.frames) this.drawFrames(x);
    if (this.names) this.drawNames(x);
    this.drawScale();
    if (this.showsForces) this.drawForceScales();
    this.drawGravity(x);
    // For printing, where the page's clock is not beside it.
    this.text(this.stamp, 14, 18, palette.ink);
  }

  polyline(points) {
    const c = this.context;
    c.beginPath();
    points.forEach(([px, py], i) => (i ? c.lineTo(px, py) : c.moveTo(px, py)));
  }

  stroke(colour, width) {
    this.context.strokeStyle = colour;
    this.context.lineWidth = width;
    this.context.stroke();
  }

  fill(colour, alpha = 1) {
    const c = this.context;
    c.globalAlpha = alpha;
    c.fillStyle = colour;
    c.fill('evenodd');
    c.globalAlpha = 1;
  }

  line(a, b, colour, width) {
    this.polyline([a, b]);
    this.stroke(colour, width);
  }

  disc([px, py], radius, fill, stroke, width = 1.2) {
    const c = this.context;
    c.beginPath();
    c.arc(px, py, Math.max(radius, 0), 0, 2 * Math.PI);
    if (fill) this.fill(fill);
    if (stroke) this.stroke(stroke, width);
  }

  /** A grid in the plane of the machine or on the ground, and the axes of the ground. */
  drawGround() {
    const { view, palette } = this;
    if (this.picture.dimension === 2) {
      const step = round125((90 / view.scale) * 1.3);
      const [left, top] = view.unproject(0, 0);
      const [right, bottom] = view.unproject(view.width, view.height);
      const rule = (from, to, ends) => {
        for (let k = Math.ceil(from / step); k <= Math.floor(to / step); k++) {
          const [a, b] = ends(k * step);
          this.line(view.project(a), view.project(b), k === 0 ? palette.line : palette.grid, 1);
        }
      };
      rule(left, right, (x) => [[x, bottom, 0], [x, top, 0]]);
      rule(bottom, top, (y) => [[left, y, 0], [right, y, 0]]);
      return;
    }
    const step = round125(this.reach / 4);
    const count = Math.ceil((0.75 * this.reach) / step) + 1;
    const base = view.up.map((u) => u * this.floor);
    const at = (i, k) => view.project(along(along(base, i * step, view.first), k * step, view.second));
    for (let k = -count; k <= count; k++) {
      const colour = k === 0 ? palette.line : palette.grid;
      this.line(at(k, -count), at(k, count), colour, 1);
      this.line(at(-count, k), at(count, k), colour, 1);
    }
    const origin = view.project([0, 0, 0]);
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, k) => {
      const tip = view.project(axis.map((a) => a * step));
      this.arrow(origin, tip, palette.muted, 1.2);
      this.text('xyz'[k], tip[0] + 6, tip[1], palette.muted);
    });
  }

  arrow(a, b, colour, width) {
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const size = Math.hypot(dx, dy);
    this.line(a, b, colour, width);
    if (size < 3) return;
    const head = Math.min(4 + 2 * width, 0.5 * size) / size;
    const side = (s) => [b[0] - head * dx + s * 0.45 * head * dy, b[1] - head * dy - s * 0.45 * head * dx];
    this.polyline([side(1), b, side(-1)]);
    this.context.closePath();
    this.fill(colour);
  }

  text(words, px, py, colour, align = 'left') {
    const c = this.context;
    c.textAlign = align;
    c.textBaseline = 'middle';
    c.lineWidth = 3;
    c.strokeStyle = this.palette.paper;
    c.strokeText(words, px, py);
    c.fillStyle = colour;
    c.fillText(words, px, py);
  }

  /** The trails of the mass centres, which fade with age. */
  drawTrails(t) {
    const { motion, picture, view } = this;
    const share = motion.duration === 0 ? 0 : (t - motion.from) / motion.duration;
    const end = share * this.pathSteps;
    const start = Math.max(0, end - this.trail * this.pathSteps);
    if (!(end > start)) return;
    const c = this.context;
    // In a long chain a few trails show the motion, while sixty would hide it; the last is always included.
    const every = Math.ceil(picture.bodies.length / 16);
    const most = 12_000 / (picture.bodies.length / every);
    const stride = Math.max(1, Math.ceil((end - start) / most));
    const fades = picture.bodies.length > 12 ? 3 : 6;
    const now = motion.x;
    const { x, y } = view.map;
    this.paths.forEach((path, index) => {
      if ((picture.bodies.length - 1 - index) % every !== 0) return;
      const lineTo = (step) => {
        const [a, b, d] = [path[3 * step], path[3 * step + 1], path[3 * step + 2]];
        c.lineTo(x[0] + x[1] * a + x[2] * b + x[3] * d, y[0] + y[1] * a + y[2] * b + y[3] * d);
      };
      for (let fade = 0; fade < fades; fade++) {
        const from = Math.ceil(start + ((end - start) * fade) / fades);
        const to = Math.floor(start + ((end - start) * (fade + 1)) / fades);
        c.beginPath();
        for (let step = from; step < to; step += stride) lineTo(step);
        lineTo(to);
        if (fade === fades - 1) c.lineTo(...view.project(this.vector(now, picture.bodies[index].at)));
        else lineTo(Math.min(to + 1, this.pathSteps));
        c.globalAlpha = (0.75 * (fade + 1)) / fades;
        this.stroke(this.colours[index], 1.3);
      }
      c.globalAlpha = 1;
    });
  }

  /** A circle in the plane of two axes, as points on the screen. */
  round(center, radius, a, b, count = 40) {
    const points = [];
    for (let i = 0; i < count; i++) {
      const angle = (2 * Math.PI * i) / count;
      points.push(this.view.project(
        along(along(center, radius * Math.cos(angle), a), radius * Math.sin(angle), b),
      ));
    }
    return points;
  }

  drawCircles(x, parts) {
    const { picture, view, palette } = this;
    const radiusOf = (circle) => Math.abs(x[circle.radius]);
    // Two circles about the same centre form a ring, such as a bored cylinder.
    const rings = Map.groupBy(picture.circles, (circle) => `${circle.body} ${circle.center}`);
    for (const circles of rings.values()) {
      const [outer, inner] = circles.toSorted((a, b) => radiusOf(b) - radiusOf(a));
      const [px, py, depth] = view.project(this.vector(x, outer.center));
      const colour = outer.body === null ? palette.muted : this.colours[outer.body];
      parts.push({
        depth,
        draw: () => {
          const c = this.context;
          c.beginPath();
          for (const circle of inner ? [outer, inner] : [outer]) {
            c.moveTo(px + radiusOf(circle) * view.scale, py);
            c.arc(px, py, radiusOf(circle) * view.scale, 0, 2 * Math.PI);
          }
          this.fill(colour, inner ? 0.22 : 0.08);
          for (const circle of circles) {
            this.disc([px, py], radiusOf(circle) * view.scale, null, colour, 1.6);
            // Shows its rotation.
            const center = this.vector(x, circle.center);
            const at = (share) => view.project(along(center, share * radiusOf(circle), this.axis(x, circle.axes, 0)));
            this.line(at(0.88), at(1), colour, 2.4);
          }
        },
      });
    }
  }

  drawSolids(x, parts) {
    this.picture.bodies.forEach((body, index) => {
      if (body.solid === null) return;
      const draw = {
        outline: 'drawOutline', disc: 'drawDisc', bar: 'drawBar', cylinder: 'drawCylinder', box: 'drawBox',
      };
      this[draw[body.solid.form]](x, body, this.colours[index], parts);
    });
  }

  drawOutline(x, body, colour, parts) {
    const corners = body.solid.corners.map((corner) => this.view.project(this.vector(x, corner)));
    parts.push({
      depth: this.view.project(this.vector(x, body.at))[2],
      draw: () => {
        this.polyline(corners);
        this.context.closePath();
        this.fill(colour, 0.16);
        this.stroke(colour, 1.4);
      },
    });
  }

  drawDisc(x, body, colour, parts) {
    const { view } = this;
    const at = this.vector(x, body.at);
    const center = view.project(at);
    const radius = body.solid.radius * view.scale;
    parts.push({
      depth: center[2],
      draw: () => {
        this.context.beginPath();
        this.context.arc(center[0], center[1], radius, 0, 2 * Math.PI);
        this.fill(colour, 0.16);
        this.stroke(colour, 1.4);
        if (body.axes === null) return;
        this.context.globalAlpha = 0.55;
        for (const k of [0, 1]) {
          const rim = (s) => view.project(along(at, s * body.solid.radius, this.axis(x, body.axes, k)));
          this.line(rim(-1), rim(1), colour, 1);
        }
        this.context.globalAlpha = 1;
        // The mark is on the first axis.
        const mark = view.project(along(at, 0.82 * body.solid.radius, this.axis(x, body.axes, 0)));
        this.disc(mark, Math.min(Math.max(0.1 * radius, 1.5), 5), colour, null);
      },
    });
  }

  drawBar(x, body, colour, parts) {
    const { view, palette } = this;
    const at = this.vector(x, body.at);
    const end = this.vector(x, body.solid.end);
    const other = along(at, -1, along(end, -1, at));
    const ends = [end, other].map((point) => view.project(point));
    const width = Math.min(Math.max(0.2 * body.solid.half * view.scale, 2.5), 15);
    parts.push({
      depth: view.project(at)[2],
      draw: () => {
        this.line(...ends, colour, width);
        if (width > 5) {
          this.line(...ends, palette.paper, width - 2.6);
          this.context.globalAlpha = 0.35;
          this.line(...ends, colour, width - 2.6);
          this.context.globalAlpha = 1;
        }
        this.disc(ends[0], Math.max(0.22 * width, 1), palette.paper, palette.ink, 1);
      },
    });
  }

  /** A flat face; the more it faces the viewer, the lighter it is. */
  face(points, normal, colour, parts, hollow) {
    const projected = points.map((point) => this.view.project(point));
    const depth = projected.reduce((sum, p) => sum + p[2], 0) / projected.length;
    const facing = Math.abs(dot(normal, this.view.toward));
    parts.push({
      depth,
      draw: () => {
        this.polyline(projected);
        this.context.closePath();
        if (!hollow) {
          this.fill(this.palette.paper, 0.55);
          this.fill(colour, 0.25 + 0.3 * (1 - facing));
        }
        this.stroke(colour, 1.1);
      },
    });
  }

  drawBox(x, body, colour, parts) {
    const { solid } = body;
    const at = this.vector(x, body.at);
    const axes = solid.axes.map((axis) => this.turned(x, body, axis));
    const half = solid.half.map((h) => Math.max(h, 0.004 * this.reach));
    const corner = (signs) => signs.reduce((point, s, k) => along(point, s * half[k], axes[k]), at);
    for (let k = 0; k < 3; k++) {
      const [i, j] = [(k + 1) % 3, (k + 2) % 3];
      for (const side of [-1, 1]) {
        const points = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => {
          const signs = [0, 0, 0];
          [signs[k], signs[i], signs[j]] = [side, a, b];
          return corner(signs);
        });
        this.face(points, axes[k], colour, parts, body.hollow);
      }
    }
  }

  drawCylinder(x, body, colour, parts) {
    const { solid } = body;
    const at = this.vector(x, body.at);
    const axis = this.turned(x, body, solid.axis);
    const spoke = [0, 1, 2]
      .map((k) => this.axis(x, body.axes, k))
      .map((e) => along(e, -dot(e, axis), axis))
      .reduce((a, b) => (Math.hypot(...a) >= 0.7 ? a : b));
    const first = unit(spoke);
    const second = cross(axis, first);
    const half = Math.max(solid.half, 0.01 * solid.radius);
    const count = 24;
    const rim = (side, i) => {
      const angle = (2 * Math.PI * i) / count;
      const center = along(at, side * half, axis);
      return along(along(center, solid.radius * Math.cos(angle), first), solid.radius * Math.sin(angle), second);
    };
    const ring = (side) => Array.from({ length: count }, (_, i) => rim(side, i));
    for (const side of [-1, 1]) this.face(ring(side), axis, colour, parts, body.hollow);
    if (body.hollow) {
      for (let i = 0; i < count; i += count / 4) {
        const [a, b] = [rim(-1, i), rim(1, i)].map((p) => this.view.project(p));
        parts.push({ depth: (a[2] + b[2]) / 2, draw: () => this.line(a, b, colour, 1.1) });
      }
      return;
    }
    // The lateral surface, in strips without edges: their depth keeps them between the ends.
    for (let i = 0; i < count; i += 2) {
      const points = [rim(-1, i), rim(-1, i + 2), rim(1, i + 2), rim(1, i)].map((p) => this.view.project(p));
      parts.push({
        depth: points.reduce((sum, p) => sum + p[2], 0) / 4,
        draw: () => {
          this.polyline(points);
          this.context.closePath();
          this.fill(colour, 0.25);
        },
      });
    }
    // Spokes show the rotation; one is marked.
    for (const side of [-1, 1]) {
      const center = along(at, side * half, axis);
      for (let i = 0; i < 4; i++) {
        const [a, b] = [center, rim(side, (i * count) / 4)].map((p) => this.view.project(p));
        parts.push({ depth: (a[2] + b[2]) / 2 + 1e-3 * this.reach, draw: () => this.line(a, b, colour, i ? 0.8 : 2.6) });
      }
    }
  }

  /** Converts a direction from a body's axes to the ground's. */
  turned(x, body, direction) {
    return direction.reduce((sum, s, k) => along(sum, s, this.axis(x, body.axes, k)), [0, 0, 0]);
  }

  /** Links, rods, the pins between them, and the stand on the ground. */
  drawJoints(x, parts) {
    const { picture, view, palette } = this;
    const pins = new Map();
    const join = (from, to, colour, width) => {
      const [a, b] = [from, to].map((place) => view.project(this.vector(x, place)));
      parts.push({ depth: (a[2] + b[2]) / 2, draw: () => this.line(a, b, colour, width) });
      pins.set(from, a);
    };
    for (const link of picture.links) {
      const colour = link.body === null ? palette.muted : this.colours[link.body];
      const width = picture.dimension === 2 ? 4 : 5;
      join(link.ends[0], link.ends[1], colour, link.rope ? 1.6 : width);
    }
    picture.bodies.forEach((body, index) => {
      if (body.rod !== null) join(body.rod, body.at, this.colours[index], 2.4);
      if (body.solid?.form === 'bar') pins.set(body.solid.end, view.project(this.vector(x, body.solid.end)));
    });
    for (const element of picture.elements) {
      if (!element.ends?.includes(picture.ground)) continue;
      pins.set(picture.ground, view.project(this.vector(x, picture.ground)));
    }
    const small = picture.bodies.length > 24 ? 1.6 : 3;
    for (const [place, at] of pins) {
      if (place === picture.ground) this.drawStand(at, parts);
      parts.push({ depth: at[2] + 1e-6, draw: () => this.disc(at, small, palette.paper, palette.ink, 1.2) });
    }
  }

  /** The support at the origin of the ground, on the side away from the machine. */
  drawStand(at, parts) {
    const { view, palette } = this;
    const machine = dot(view.home.center, view.above) >= 0 ? 1 : -1;
    parts.unshift({
      depth: -Infinity,
      draw: () => {
        const [px, py] = at;
        const down = machine;
        this.polyline([[px, py], [px - 8, py + 13 * down], [px + 8, py + 13 * down]]);
        this.context.closePath();
        this.fill(palette.panel);
        this.stroke(palette.muted, 1.2);
        this.hatch([px, py + 13 * down], [0, down], 15);
      },
    });
  }

  /** A piece of the ground: a line across a direction, hatched beyond it. */
  hatch([px, py], [dx, dy], half) {
    const { palette } = this;
    const across = (s, out) => [px - s * dy + out * dx, py + s * dx + out * dy];
    this.line(across(-half, 0), across(half, 0), palette.muted, 1.4);
    for (let s = -half + 3; s <= half; s += 5) this.line(across(s, 0), across(s - 5, 6), palette.muted, 1);
  }

  drawElements(x, parts) {
    const { picture, view } = this;
    for (const element of picture.elements) {
      if (element.placed === 'twist') {
        const at = view.project(this.vector(x, element.about));
        parts.push({ depth: at[2], draw: () => this.drawSpiral(at, element) });
        continue;
      }
      let ends;
      if (element.placed === 'between') {
        ends = element.ends.map((end) => view.project(this.vector(x, end)));
      } else {
        const local = element.foot.map((f, k) => f + element.edgeLocal[k]);
        const body = picture.bodies[element.body];
        const end = this.inBody(x, body, local);
        ends = [element.stand, end].map((point) => view.project(point));
        if (element.lug !== null) {
          // An arm of the body that extends to the line of action.
          const at = this.vector(x, body.at);
          const root = view.project(along(at, element.lug, along(end, -1, at)));
          const colour = this.colours[element.body];
          parts.push({ depth: root[2], draw: () => this.line(root, ends[1], colour, 3) });
        }
      }
      parts.push({ depth: (ends[0][2] + ends[1][2]) / 2, draw: () => this.drawElement(element, ends) });
    }
  }

  drawElement(element, [a, b]) {
    const { palette } = this;
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const length = Math.hypot(dx, dy);
    if (length < 2) return;
    const [ex, ey] = [dx / length, dy / length];
    // A short element is also thin.
    const thin = Math.min(1, length / 40);
    const aside = 15 * thin * element.beside;
    // Along the element, and across it.
    const at = (s, w) => [a[0] + s * ex - (w + aside) * ey, a[1] + s * ey + (w + aside) * ex];
    if (aside) {
      this.line(a, at(0, 0), palette.ink, 1);
      this.line(b, at(length, 0), palette.ink, 1);
    }
    if (element.placed === 'sketch') this.hatch(at(0, 0), [-ex, -ey], 9);
    const colour = element.damper ? palette.muted : palette.ink;
    if (element.damper) {
      // The cylinder is attached to the first end, the piston to the second.
      const pot = Math.min(26, 0.5 * length);
      const start = 0.5 * (length - pot);
      this.line(at(0, 0), at(start, 0), colour, 1.3);
      this.polyline([[start + pot, -5], [start, -5], [start, 5], [start + pot, 5]].map(([s, w]) => at(s, w * thin)));
      this.stroke(colour, 1.5);
      const piston = start + 0.55 * pot;
      this.line(at(piston, -3.6 * thin), at(piston, 3.6 * thin), colour, 2 * thin);
      this.line(at(piston, 0), at(length, 0), colour, 1.3);
      return;
    }
    const lead = Math.min(10, 0.15 * length);
    const coils = Math.max(3, Math.round(8 * thin));
    const points = [at(0, 0), at(lead, 0)];
    for (let i = 0; i < 2 * coils; i++) {
      const s = lead + ((length - 2 * lead) * (i + 0.5)) / (2 * coils);
      points.push(at(s, (i % 2 ? 5.5 : -5.5) * thin));
    }
    points.push(at(length - lead, 0), at(length, 0));
    this.polyline(points);
    this.stroke(colour, 1.3);
  }

  drawSpiral([px, py], element) {
    const points = [];
    const turns = 2.5;
    for (let i = 0; i <= 60; i++) {
      const angle = (2 * Math.PI * turns * i) / 60;
      const radius = 3 + (11 * i) / 60 + 4 * Math.abs(element.beside);
      points.push([px + radius * Math.cos(angle), py - radius * Math.sin(angle)]);
    }
    this.polyline(points);
    this.stroke(element.damper ? this.palette.muted : this.palette.ink, 1.2);
  }

  /** Mass centres: a ball for a particle, the usual quartered disc for a body. The area grows with the cube root of the mass. */
  drawCentres(x) {
    const { picture, view, palette } = this;
    const heaviest = Math.max(...picture.bodies.map((body) => body.mass));
    const base = Math.min(Math.max(0.012 * Math.min(view.width, view.height), 4), 9);
    // In a long chain they must not hide the links.
    const crowd = Math.min(1, 14 / picture.bodies.length);
    picture.bodies.forEach((body, index) => {
      const at = view.project(this.vector(x, body.at));
      if (!Number.isFinite(at[0] + at[1])) return;
      const share = body.mass > 0 && heaviest > 0 ? Math.cbrt(body.mass / heaviest) : 0;
      const size = base * (0.45 + 0.75 * share) * Math.max(crowd, 0.3);
      if (body.bare) {
        this.disc(at, 1.25 * size, this.colours[index], palette.ink, 1);
        return;
      }
      const radius = Math.max(0.75 * size, 1.2);
      this.disc(at, radius, palette.paper, null);
      const c = this.context;
      for (const quarter of [0, 2]) {
        c.beginPath();
        c.moveTo(at[0], at[1]);
        c.arc(at[0], at[1], radius, (quarter * Math.PI) / 2, ((quarter + 1) * Math.PI) / 2);
        this.fill(this.colours[index]);
      }
      this.disc(at, radius, null, this.colours[index], 1.2);
    });
  }

  drawFrames(x) {
    const { picture, view, palette } = this;
    const length = 0.09 * this.reach;
    for (const frame of picture.frames) {
      const origin = this.vector(x, frame.origin);
      const start = view.project(origin);
      for (let k = 0; k < picture.dimension; k++) {
        const tip = view.project(along(origin, length, this.axis(x, frame.axes, k)));
        this.arrow(start, tip, ['#d1495b', '#3a9d5d', '#3d7dca'][k], 1.5);
      }
      this.text(frame.name, start[0] + 7, start[1] + 11, palette.muted);
    }
  }

  drawNames(x) {
    const { picture, view, palette } = this;
    picture.bodies.forEach((body, index) => {
      const at = view.project(this.vector(x, body.at));
      this.text(body.name, at[0] + 10, at[1] - 10, this.colours[index]);
    });
    for (const element of picture.elements) {
      if (element.placed === 'twist') continue;
      const points = element.placed === 'between'
        ? element.ends.map((end) => view.project(this.vector(x, end)))
        : [view.project(element.stand)];
      const [px, py] = [0, 1].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
      this.text(element.name, px + 8, py + 12 + 13 * element.beside, palette.muted);
    }
    for (const circle of picture.circles) {
      const center = this.vector(x, circle.center);
      const at = view.project(along(center, -Math.abs(x[circle.radius]), this.axis(x, circle.axes, 1)));
      this.text(circle.name, at[0], at[1], palette.muted, 'center');
    }
  }

  drawScale() {
    const { view, palette } = this;
    const metres = round125((0.24 * view.width) / view.scale);
    const length = metres * view.scale;
    const y = view.height - 14;
    this.polyline([[14, y - 5], [14, y], [14 + length, y], [14 + length, y - 5]]);
    this.stroke(palette.ink, 1.4);
    this.text(lengthText(metres), 14 + length / 2, y - 10, palette.ink, 'center');
  }

  drawGravity(x) {
    const { picture, view, palette } = this;
    if (picture.gravity === null) return;
    const g = this.vector(x, picture.gravity);
    const size = Math.hypot(...g);
    if (!(size > 0)) return;
    const direction = [dot(g, view.right) / size, -dot(g, view.above) / size];
    const [px, py] = [view.width - 26, 36];
    const end = (s) => [px + 20 * s * direction[0], py + 20 * s * direction[1]];
    this.arrow(end(-1), end(1), palette.muted, 1.8);
    this.text('g', px - 9, py, palette.muted, 'right');
  }
}

/** A length as text, with a unit that keeps the number short. */
function lengthText(metres) {
  const [factor, name] = metres >= 1000 ? [1e-3, 'km'] : metres >= 0.1 ? [1, 'm'] : metres >= 1e-3 ? [1e3, 'mm'] : [1e6, 'µm'];
  return `${figure(metres * factor, 3)} ${name}`;
}
