'use strict';

// The motion: the data in the page, and the state of the machine at any instant.

/** Decodes 32-bit numbers from base64. They are little-endian, as is every computer that
 * runs a browser. */
function floats(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

class Motion {
  constructor(data) {
    this.from = data.from;
    this.to = data.to;
    this.interval = data.interval;
    this.count = data.count;
    this.n = data.coordinates;
    const stored = floats(data.states);
    // What varies little far from zero is stored relative to a base.
    const { bases } = data;
    this.states = bases ? Float64Array.from(stored, (x, i) => x + bases[i % bases.length]) : stored;
    this.parameters = Float64Array.from(data.parameters, (value) => value ?? NaN);
    this.q = new Float64Array(this.n);
    this.v = new Float64Array(this.n);
    this.x = new Float64Array(data.values);
  }

  /** Its duration, in s; negative for a run backward in time. */
  get duration() {
    return this.to - this.from;
  }

  /** The time of a stored state. All but the last are equally spaced. */
  time(index) {
    return index === this.count - 1 ? this.to : this.from + index * this.interval;
  }

  /** Coordinates and rates at time `t`, from the cubic through the neighbouring states. */
  state(t) {
    const { n, q, v, states } = this;
    const last = this.count - 2;
    if (last < 0) {
      for (let i = 0; i < n; i++) [q[i], v[i]] = [states[i], states[n + i]];
      return this;
    }
    const before = Math.floor((t - this.from) / this.interval);
    const index = Math.min(Math.max(before, 0), last);
    const start = this.time(index);
    const h = this.time(index + 1) - start;
    const s = Math.min(Math.max((t - start) / h, 0), 1);
    const a = index * 2 * n;
    const b = a + 2 * n;
    for (let i = 0; i < n; i++) {
      const rise = states[b + i] - states[a + i];
      const slope = h * states[a + n + i];
      const end = h * states[b + n + i];
      const two = 3 * rise - 2 * slope - end;
      const three = slope + end - 2 * rise;
      q[i] = states[a + i] + s * (slope + s * (two + s * three));
      v[i] = (slope + s * (2 * two + s * 3 * three)) / h;
    }
    return this;
  }

  /** The drawn values at time `t`; see `kinematics`, which is generated from
   * the spec's expressions. */
  values(t) {
    this.state(t);
    kinematics(t, this.q, this.parameters, this.x);
    return this.x;
  }
}

/** The largest number of the form 1, 2 or 5 times a power of ten that does not exceed `most`. */
function round125(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  const digit = most / power;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}

/** A number with this many digits, in decimal or exponential notation, with a true minus sign. */
function figure(x, digits = 5) {
  if (!Number.isFinite(x)) return '–';
  const size = Math.abs(x);
  const text = x === 0 ? '0'
    : size >= 1e-3 && size < 1e6 ? String(Number(x.toPrecision(digits)))
    : x.toExponential(Math.max(digits - 2, 1)).replace(/\.?0*e\+?/, 'e');
  return text.replaceAll('-', '−');
}
