// Maps points of the machine to the screen: an orthographic view, so that the scale bar is valid everywhere.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const along = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** The range of points along a direction, including the margin of each. */
function rangeOf(points, direction) {
  let [low, high] = [Infinity, -Infinity];
  for (const [point, radius] of points) {
    const place = dot(point, direction);
    if (place - radius < low) low = place - radius;
    if (place + radius > high) high = place + radius;
  }
  return [low, high];
}

class View {
  /** `up` is the direction that is drawn upright in space. */
  constructor(dimension, up) {
    this.dimension = dimension;
    this.up = up;
    const other = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
    this.first = unit(along(other, -dot(other, up), up));
    this.second = cross(up, this.first);
    this.width = 1;
    this.height = 1;
    this.home = { center: [0, 0, 0], size: [1, 1] };
    this.reset([]);
  }

  /** Returns to the initial view, and shows these points with their margins. */
  reset(points = this.shown) {
    this.shown = points;
    this.azimuth = -1.05;
    this.elevation = 0.38;
    this.zoom = 1;
    this.shift = [0, 0];
    this.turn(0, 0);
    if (points.length === 0) return;
    const directions = [this.right, this.above, this.toward];
    const ranges = directions.map((direction) => rangeOf(points, direction));
    const center = ranges.reduce(
      (sum, [low, high], k) => along(sum, (low + high) / 2, directions[k]),
      [0, 0, 0],
    );
    const sizes = ranges.map(([low, high]) => high - low);
    // A motion along a line gets a minimum width across it, and a machine at rest a minimum size.
    const least = 0.02 * Math.max(...sizes) || 1;
    this.home = { center, size: [Math.max(sizes[0], least), Math.max(sizes[1], least)] };
  }

  /** Rotates the view about the upright direction and in elevation, by angles. */
  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.min(Math.max(this.elevation + elevation, -1.57), 1.57);
    if (this.dimension === 2) {
      [this.right, this.above, this.toward] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
      return;
    }
    const [sin, cos] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const level = along([0, 0, 0].map((_, k) => cos * this.first[k]), sin, this.second);
    const [rise, run] = [Math.sin(this.elevation), Math.cos(this.elevation)];
    this.toward = along(level.map((x) => run * x), rise, this.up);
    this.right = cross(this.up, level);
    this.above = cross(this.toward, this.right);
  }

  /** Pixels per metre. */
  get scale() {
    const [width, height] = this.home.size;
    const margin = Math.min(this.width, this.height) * 0.1 + 12;
    const across = Math.max(this.width - 2 * margin, 40) / width;
    const down = Math.max(this.height - 2 * margin, 40) / height;
    return this.zoom * Math.min(across, down);
  }

  /** Projects a point in metres to pixels; the third number grows towards the viewer. */
  project(point) {
    const d = along(point, -1, this.center ?? this.home.center);
    const scale = this.scale;
    return [
      this.width / 2 + this.shift[0] + scale * dot(d, this.right),
      this.height / 2 + this.shift[1] - scale * dot(d, this.above),
      dot(d, this.toward),
    ];
  }

  /** The same projection as coefficients, for drawing thousands of points: pixels are `x[0] + x[1] X + x[2] Y + x[3] Z`,
   * and likewise for `y`. */
  get map() {
    const [px, py] = this.project([0, 0, 0]);
    const scale = this.scale;
    return { x: [px, ...this.right.map((r) => scale * r)], y: [py, ...this.above.map((a) => -scale * a)] };
  }

  /** The point at these pixels, in the plane parallel to the screen through the centre of the view. */
  unproject(x, y) {
    const scale = this.scale;
    const center = this.center ?? this.home.center;
    const right = along(center, (x - this.width / 2 - this.shift[0]) / scale, this.right);
    return along(right, -(y - this.height / 2 - this.shift[1]) / scale, this.above);
  }

  /** Zooms; the point under the pointer keeps its place. */
  zoomAt(x, y, factor) {
    const zoom = Math.min(Math.max(this.zoom * factor, 1e-3), 1e5);
    const ratio = zoom / this.zoom;
    const [cx, cy] = [this.width / 2, this.height / 2];
    this.shift[0] += (1 - ratio) * (x - cx - this.shift[0]);
    this.shift[1] += (1 - ratio) * (y - cy - this.shift[1]);
    this.zoom = zoom;
  }

  pan(dx, dy) {
    this.shift[0] += dx;
    this.shift[1] += dy;
  }
}
