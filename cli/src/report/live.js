// Runs the machine in the page: sliders change its parameters and its start, and it is integrated again by the method of the command.

/** An explicit embedded Runge–Kutta pair, with its published coefficients. */
class Integrator {
  constructor(method, tolerance, mostSteps) {
    Object.assign(this, { method, tolerance, mostSteps });
    this.steps = 0;
  }

  /** The norm of a vector whose components are divided by the tolerances of the state before and after the step. */
  norm(vector, before, after) {
    let sum = 0;
    for (let i = 0; i < vector.length; i++) {
      const scale = this.tolerance * (1 + Math.max(Math.abs(before[i]), Math.abs(after[i])));
      sum += (vector[i] / scale) ** 2;
    }
    return Math.sqrt(sum / Math.max(1, vector.length));
  }

  /** Integrates the state `y` to each of the times in turn, and calls `tell` at each; `hold` projects it after each step.
   * Failures are thrown. */
  run(f, y, times, tell, hold) {
    const { a, c, error, coarse, power, stages, change: [least, most] } = this.method;
    const forward = times[times.length - 1] >= times[0] ? 1 : -1;
    const slopes = Array.from({ length: stages + 1 }, () => new Float64Array(y.length));
    let t = times[0];
    let h = 0;
    let isFirst = true;
    tell(y, 0);
    f(t, y, slopes[0]);
    const next = new Float64Array(y.length);
    const part = new Float64Array(y.length);
    const sum = (weights, count) => {
      for (let i = 0; i < y.length; i++) {
        let value = 0;
        for (let k = 0; k < count; k++) value += weights[k] * slopes[k][i];
        part[i] = value;
      }
      return part;
    };
    for (let index = 1; index < times.length; index++) {
      const until = times[index];
      while ((until - t) * forward > 0) {
        const left = Math.abs(until - t);
        if (h === 0) {
          // Chosen from a step of Euler's method: it may change the state by a hundredth of its size, or the step is a millionth
          // of the interval.
          const [size, rate] = [this.norm(y, y, y), this.norm(slopes[0], y, y)];
          h = size > 1e-5 && rate > 1e-5 ? Math.min(0.01 * (size / rate), left) : Math.min(1e-6, left);
        }
        const last = 1.01 * h >= left;
        const step = (last ? left : h) * forward;
        for (let stage = 1; stage <= stages; stage++) {
          sum(a[stage], stage);
          for (let i = 0; i < y.length; i++) next[i] = y[i] + step * part[i];
          if (stage < stages) f(t + c[stage] * step, next, slopes[stage]);
        }
        // Some pairs also use the slope at the new point.
        if (error.length > stages) f(t + step, next, slopes[stages]);
        let off = this.norm(sum(error, error.length), y, next);
        // The combination with the coarser estimate may be far too small in the first step: see `error_norm` of the library.
        const combines = coarse && !isFirst;
        if (combines && off > 0) {
          const other = this.norm(sum(coarse, coarse.length), y, next);
          off = (off * off) / Math.sqrt(off * off + 0.01 * other * other);
        }
        off *= Math.abs(step);
        if (++this.steps > this.mostSteps) throw new Error(`more than ${this.mostSteps} steps, at t = ${t} s`);
        const factor = off > 0 ? 0.9 * off ** (-1 / (coarse && isFirst ? power - 2 : power)) : most;
        if (off <= 1) {
          isFirst = false;
          t = last ? until : t + step;
          y.set(next);
          hold(t, y);
          f(t, y, slopes[0]);
          const longer = Math.abs(step) * Math.min(Math.max(factor, least), most);
          if (!last || longer > h) h = longer;
        } else {
          h = Math.abs(step) * (factor > 0 ? Math.min(Math.max(factor, least), 0.9) : 0.1);
          if (!(h > 1e-15 * (Math.abs(t) + 1e-3))) throw new Error(`steps become too short at t = ${t} s`);
        }
      }
      tell(y, index);
    }
  }
}

/**
 * Projects a state onto the constraints of the machine by the smallest change in the metric of inertia, dq = W Gᵀ (G W Gᵀ)⁻¹ (−g)
 * with W the inverse of the mass matrix, and likewise the rates with their residuals. Coordinates that the spec keeps do not
 * change at the start.
 */
class Constraints {
  constructor(p, { holonomic, kept }, n) {
    // Holonomic constraints first: rates must satisfy all constraints, positions only these.
    const order = [true, false].flatMap((wanted) => holonomic.flatMap((is, k) => (is === wanted ? [k] : [])));
    Object.assign(this, { p, holonomic, kept, n, order });
  }

  /** Remembers the largest coordinates and rates so far. At the start each is at least as large as any other with its unit,
   * and an angle, or a pure number, is at least 1. */
  remember(y) {
    const { n } = this;
    const units = machine.coordinate_units;
    const first = (values, level) => values.map((_, j) => {
      const alike = Array.from(values.filter((__, i) => units[i] === units[j]), Math.abs);
      return Math.max(level === 0 && ['rad', '1'].includes(units[j]) ? 1 : 0, ...alike);
    });
    const halves = [y.subarray(0, n), y.subarray(n)];
    this.largest = halves.map((values, level) => {
      const known = this.largest ? this.largest[level] : first(values, level);
      return values.map((x, j) => Math.max(known[j], Math.abs(x)));
    });
  }

  /** The residuals of each constraint in positions and in rates, and the sizes of their terms. What the constraints keep at
   * zero is as inexact as everything else, in the metric of inertia. */
  residuals(t, y) {
    const { p, n, largest } = this;
    const [q, v] = [y.subarray(0, n), y.subarray(n)];
    const rows = machine.constraint_matrix(p, t, q);
    const inertia = machine.mass_matrix(p, t, q).map((row, i) => row[i]);
    const ratesAtRest = machine.constraint_rates(p, t, q, new Float64Array(n));
    const sum = (term) => inertia.reduce((total, m, i) => total + term(m, i), 0);
    const sizes = (x) => rows.map((row) => {
      const terms = sum((m, i) => Math.abs(row[i] * x[i]));
      const [length, normSquared] = [sum((m, i) => (m > 0 ? row[i] * row[i] / m : 0)), sum((m, i) => m * x[i] * x[i])];
      return terms + 1e-4 * Math.sqrt(length * normSquared);
    });
    return {
      positions: { residuals: machine.constraint_positions(p, t, q), sizes: sizes(largest[0]).map((size) => size || 1) },
      rates: { residuals: machine.constraint_rates(p, t, q, v), sizes: sizes(largest[1]).map((size, k) => size + Math.abs(ratesAtRest[k]) || 1) },
    };
  }

  /** The largest residual, relative to the sizes of the terms. */
  off(t, y) {
    const { positions, rates } = this.residuals(t, y);
    const share = ({ residuals, sizes }) => residuals.map((x, k) => Math.abs(x) / sizes[k]);
    return Math.max(...share(positions), ...share(rates));
  }

  /** The Cholesky factor of the mass matrix without the coordinates that are kept; none if it is not positive definite. */
  factor(t, y, kept) {
    const { p, n } = this;
    const m = machine.mass_matrix(p, t, y.subarray(0, n)).map((row) => Array.from(row));
    for (let i = 0; i < n; i++) {
      for (let j = 0; j <= i; j++) {
        const apart = kept && (kept[i] || kept[j]);
        let sum = apart ? Number(i === j) : m[i][j];
        for (let k = 0; k < j; k++) sum -= m[i][k] * m[j][k];
        if (i !== j) {
          m[i][j] = sum / m[j][j];
        } else {
          if (!(sum > 1e-14 * (apart ? 1 : m[i][i]))) return null;
          m[i][i] = Math.sqrt(sum);
        }
      }
    }
    return m;
  }

  /** The matrices of a pose: the factor of the mass matrix, and the rows of the constraints, orthogonalized in its metric. */
  prepare(t, y, kept) {
    const { n } = this;
    const m = this.factor(t, y, kept);
    const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
    const basis = [];
    const rows = machine.constraint_matrix(this.p, t, y.subarray(0, n));
    this.order.forEach((k) => {
      const row = rows[k];
      const carried = new Float64Array(n);
      for (let i = 0; i < n; i++) {
        let sum = kept && kept[i] ? 0 : row[i];
        if (m) {
          for (let j = 0; j < i; j++) sum -= m[i][j] * carried[j];
          sum /= m[i][i];
        }
        carried[i] = sum;
      }
      const whole = dot(carried, carried);
      let rest = carried;
      const along = basis.map(() => 0);
      // Two passes of Gram–Schmidt suffice.
      for (let pass = 0; pass < 2; pass++) {
        basis.forEach(({ unit }, j) => {
          const part = dot(rest, unit);
          along[j] += part;
          rest = rest.map((entry, i) => entry - part * unit[i]);
        });
      }
      const square = dot(rest, rest);
      // Rows that depend on earlier ones are redundant.
      if (square > 1e-12 * whole) basis.push({ k, along, size: Math.sqrt(square), unit: rest.map((entry) => entry / Math.sqrt(square)) });
    });
    return { m, basis };
  }

  /** Residuals along the orthogonal rows: their norm is the distance to the constraints in the metric of inertia. */
  along({ basis }, residuals, level) {
    const values = [];
    for (const { k, along, size } of basis) {
      if (level === 'positions' && !this.holonomic[k]) break;
      values.push((residuals[k] - along.reduce((sum, part, j) => sum + part * values[j], 0)) / size);
    }
    return values;
  }

  /** The smallest change that removes the values along the rows, to be subtracted. */
  correction({ m, basis }, values, kept) {
    const { n } = this;
    const change = new Float64Array(n);
    values.forEach((value, j) => basis[j].unit.forEach((entry, i) => { change[i] += entry * value; }));
    for (let i = n - 1; i >= 0; i--) {
      if (m) {
        for (let j = i + 1; j < n; j++) change[i] -= m[j][i] * change[j];
        change[i] /= m[i][i];
      }
      if (kept && kept[i]) change[i] = 0;
    }
    return change;
  }

  /** Newton's method on positions or on rates, which keeps the matrices of one pose as long as it contracts and takes a part of a step
   * that is too long, as in the command. */
  newton(t, y, level, matrices, isFresh, kept, x) {
    const length = (values) => Math.hypot(...values);
    const seen = () => this.residuals(t, y)[level];
    const off = ({ residuals, sizes }) => Math.max(...residuals.map((r, k) => Math.abs(r) / sizes[k]));
    const isOn = (found) => off(found) <= 2.5e-14;
    let found = seen();
    let values = this.along(matrices, found.residuals, level);
    let far = length(values);
    let fresh = isFresh;
    for (let round = 0; round < 50 && !isOn(found); round++) {
      const before = x.slice();
      const change = this.correction(matrices, values, kept);
      let near;
      let part = 1;
      for (;; part *= 0.5) {
        for (let i = 0; i < x.length; i++) x[i] = before[i] - part * change[i];
        found = seen();
        values = this.along(matrices, found.residuals, level);
        near = length(values);
        if (near <= (1 - 0.25 * part) * far || part < 0.01 || off(found) < 1e-3) break;
      }
      if (isOn(found) || (fresh && !(near <= (1 - 0.125 * part) * far))) break;
      fresh = !(near <= 0.1 * far);
      if (fresh) {
        Object.assign(matrices, this.prepare(t, y, kept));
        values = this.along(matrices, found.residuals, level);
        near = length(values);
      }
      far = near;
    }
  }

  /** Projects a state onto the constraints; throws if that fails. */
  hold(t, y, isStart) {
    if (!this.order.length) return;
    this.remember(y);
    if (!(this.off(t, y) > (isStart ? 2.5e-14 : 1e-10))) return;
    const { n } = this;
    // After a step the rates begin with the last matrices of the positions.
    let matrices = null;
    for (const [level, from] of [['positions', 0], ['rates', n]]) {
      const kept = isStart && this.kept.includes(true) ? this.kept.slice(from, from + n) : null;
      const isFresh = !matrices || isStart;
      if (isFresh) matrices = this.prepare(t, y, kept);
      this.newton(t, y, level, matrices, isFresh, kept, y.subarray(from, from + n));
    }
    if (!(this.off(t, y) <= 1e-10)) throw new Error(`no state that satisfies the constraints was found at t = ${t} s`);
  }
}

class Live {
  constructor(player, data) {
    Object.assign(this, { player, data, motion: player.motion, wanted: false });
    this.parameters = Float64Array.from(data.parameters);
    this.inputs = Float64Array.from(data.inputs);
    // Start values that the user has set; the others follow the parameters.
    this.said = data.start.slice();
    const list = byId('sliders');
    const add = (group, name, unit, value, set) => {
      const range = html('input', { type: 'range', step: 'any', 'aria-label': name });
      const number = html('input', { type: 'number', step: 'any', 'aria-label': `${name}, as a number` });
      const reset = () => {
        const size = value === 0 ? 1 : Math.abs(value);
        range.min = value > 0 ? 0 : value - size;
        range.max = value < 0 ? 0 : value + size;
        range.value = value;
        number.value = value;
      };
      const changed = (text) => {
        const x = Number(text);
        if (text === '' || !Number.isFinite(x)) return;
        range.value = x;
        if (number.value !== text) number.value = String(x);
        set(x);
        this.ask();
      };
      range.addEventListener('input', () => changed(range.value));
      number.addEventListener('change', () => changed(number.value));
      reset();
      list.append(html('label', { class: 'slider', 'data-group': group, 'data-name': name },
        html('code', {}, name), range, number, html('span', { class: 'unit' }, unit)));
      return reset;
    };
    const resets = [
      ...machine.parameters.map((name, i) => add('parameter', name, machine.parameter_units[i], data.parameters[i],
        (x) => { this.parameters[i] = x; })),
      ...machine.inputs.map((name, i) => add('input', name, machine.input_units[i], data.inputs[i],
        (x) => { this.inputs[i] = x; })),
      ...data.states.flatMap(({ name, unit, value, hidden }, i) => (
        hidden ? [] : [add('start', name, unit, value, (x) => { this.said[i] = x; })])),
    ];
    byId('again').addEventListener('click', () => {
      this.parameters.set(data.parameters);
      this.inputs.set(data.inputs);
      this.said = data.start.slice();
      resets.forEach((reset) => reset());
      this.ask();
    });
  }

  /** Schedules one run before the next picture, however often a slider has moved. */
  ask() {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.run();
    });
  }

  run() {
    const { motion, data, player } = this;
    // The integrals of first-order states follow the coordinates; they are not drawn.
    const n = machine.coordinates.length;
    const drawn = motion.n;
    const before = performance.now();
    const integrator = new Integrator(data.method, data.tolerance, data.steps);
    const status = byId('live-status');
    try {
      const p = machine.prepare(this.parameters);
      const start = machine.start(this.parameters);
      const y = Float64Array.from({ length: 2 * n }, (_, i) => this.said[i] ?? start[i] ?? 0);
      const times = Array.from({ length: motion.count }, (_, k) => motion.time(k));
      const states = new Float64Array(2 * n * motion.count);
      const u = this.inputs;
      const f = (t, state, slopes) => {
        const v = state.subarray(n);
        const a = machine.accelerations(p, t, state, v, u);
        for (let i = 0; i < n; i++) {
          if (!Number.isFinite(a[i])) throw new Error(`the acceleration of ${machine.coordinates[i]} is not a number at t = ${t} s`);
          slopes[i] = v[i];
          slopes[n + i] = a[i];
        }
      };
      const constraints = new Constraints(p, data.constraints, n);
      // The first fact that does not hold after a step, or at the start.
      let broken = null;
      const check = (t, state) => {
        const holds = ({ strict }, k) => {
          const margin = machine[`assumption_${k}`](p, t, state, state.subarray(n), u);
          return margin > 0 || (!strict && margin >= 0);
        };
        const index = broken ? -1 : data.facts.findIndex((fact, k) => !holds(fact, k));
        if (index >= 0) broken = `the machine assumes ${data.facts[index].text}, which does not hold at t = ${t} s`;
      };
      constraints.hold(times[0], y, true);
      check(times[0], y);
      integrator.run(f, y, times, (state, k) => states.set(state, 2 * n * k), (t, state) => {
        constraints.hold(t, state, false);
        check(t, state);
      });
      motion.states = n === drawn ? states : Float64Array.from({ length: 2 * drawn * times.length }, (_, i) => {
        const [k, j] = [Math.floor(i / (2 * drawn)), i % (2 * drawn)];
        return states[2 * n * k + (j < drawn ? j : n + j - drawn)];
      });
      motion.parameters.set(this.parameters);
      player.plots.forEach((plot) => plot.curves.forEach((curve) => this.refresh(curve, p, times, states)));
      player.drawing.weigh();
      const took = performance.now() - before;
      status.textContent = `Run again in this page: ${integrator.steps} steps in ${took.toFixed(0)} ms. `
        + 'The tables below are from the run of the command.'
        + (broken ? ` Attention: ${broken}; the motion after it may be wrong.` : '');
      status.className = broken ? 'alert' : '';
    } catch (reason) {
      status.textContent = `The run failed with these values: ${reason.message}. The previous run is shown.`;
      status.className = 'alert';
    }
    player.layOut();
    player.dirty = true;
  }

  /** Updates a curve that has points of its own, or empties it if the page cannot compute it. */
  refresh(curve, p, times, states) {
    if (!curve.times) return;
    const n = machine.coordinates.length;
    const u = this.inputs;
    const { live } = curve;
    const value = (k) => {
      const q = states.subarray(2 * n * k, 2 * n * k + n);
      const v = states.subarray(2 * n * k + n, 2 * n * (k + 1));
      const t = times[k];
      if (live?.state !== undefined) return v[this.motion.n + live.state];
      if (live?.output !== undefined) {
        const a = machine.accelerations(p, t, q, v, u);
        return machine.functions_of_outputs[live.output](p, t, q, v, u, a);
      }
      const kinetic = () => machine.kinetic_energy(p, t, q, v);
      const potential = () => machine.potential_energy(p, t, q, u);
      if (live?.energy === 'kinetic') return kinetic();
      if (live?.energy === 'potential') return potential();
      if (live?.energy === 'total') return kinetic() + potential();
      if (live?.multiplier !== undefined) return machine.multipliers(p, t, q, v, u)[live.multiplier];
      if (live?.input !== undefined) return u[live.input];
      return NaN;
    };
    curve.times = Float64Array.from(times);
    curve.values = Float64Array.from(times, (_, k) => value(k));
  }
}

const live = new Live(player, JSON.parse(byId('live-data').textContent));

// For scripts that control the page: by the names and numbers of the sliders, as in `canvas.live.set('l1', 2)`.
player.canvas.live = Object.freeze({
  set: (name, value) => {
    const label = [...document.querySelectorAll('#sliders label')].find((one) => one.dataset.name === name);
    const number = label.querySelector('input[type=number]');
    number.value = String(value);
    number.dispatchEvent(new Event('change'));
  },
  /** The stored states, in double precision: coordinates and rates, one instant after the other. */
  get states() { return player.motion.states; },
  get times() { return Array.from({ length: player.motion.count }, (_, k) => player.motion.time(k)); },
});
