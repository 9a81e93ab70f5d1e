// Where a point of the machine is on the screen: an orthographic view, so that the scale bar is true everywhere.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const along = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

class View {
  /** `up` is the direction that stays upright in space. */
  constructor(dimension, up) {
    this.dimension = dimension;
    this.up = up;
    const other = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
    this.first = unit(along(other, -dot(other, up), up));
    this.second = cross(up, this.first);
    this.width = 1;
    this.height = 1;
    this.home = { center: [0, 0, 0], size: [1, 1] };
    this.reset();
  }

  /** Shows everything that `home` holds. */
  reset() {
    this.azimuth = -1.05;
    this.elevation = 0.38;
    this.zoom = 1;
    this.shift = [0, 0];
    this.turn(0, 0);
  }

  /** Turns the view about the upright direction, and up or down, by angles. */
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

  /** Pixels in a metre. */
  get scale() {
    const [width, height] = this.home.size;
    const margin = Math.min(this.width, this.height) * 0.1 + 12;
    const across = Math.max(this.width - 2 * margin, 40) / width;
    const down = Math.max(this.height - 2 * margin, 40) / height;
    return this.zoom * Math.min(across, down);
  }

  /** A point in metres as pixels, and how near it is to the viewer. */
  project(point) {
    const d = along(point, -1, this.center ?? this.home.center);
    const scale = this.scale;
    return [
      this.width / 2 + this.shift[0] + scale * dot(d, this.right),
      this.height / 2 + this.shift[1] - scale * dot(d, this.above),
      dot(d, this.toward),
    ];
  }

  /** The point in the plane of the screen, through the centre of the view, that is shown at these pixels. */
  unproject(x, y) {
    const scale = this.scale;
    const center = this.center ?? this.home.center;
    const right = along(center, (x - this.width / 2 - this.shift[0]) / scale, this.right);
    return along(right, -(y - this.height / 2 - this.shift[1]) / scale, this.above);
  }

  /** Zooms and keeps the point under the pointer where it is. */
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
