'use strict';
// A map in a canvas: a heat map, or panels of curves or dots, with axes, a readout, and parts shown larger.
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const read = document.getElementById('read');
  const map = document.getElementById('map');

  const numbers = (text) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Float64Array(bytes.buffer);
  };
  const short = (x) => (Number.isFinite(x) ? String(Number(x.toPrecision(7))) : 'no number');

  // From the least number to the greatest.
  const extent = (arrays) => {
    let low = Infinity;
    let high = -Infinity;
    for (const array of arrays) {
      for (const x of array) {
        if (x < low) low = x;
        if (x > high) high = x;
      }
    }
    if (low > high) return [0, 1];
    if (low === high) return [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
    return [low, high];
  };
  const wider = ([low, high]) => [low - 0.03 * (high - low), high + 0.03 * (high - low)];

  // Round numbers of an axis.
  const ticks = ([low, high], most) => {
    const rough = (high - low) / most;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((k) => k * power).find((size) => size >= rough);
    const found = [];
    for (let k = Math.ceil(low / step); k * step <= high; k += 1) found.push(k * step);
    return found;
  };

  const MARGIN = { left: 76, right: 14, top: 14, bottom: 44 };

  // One canvas: what is drawn in it, the whole of it, and the part that is shown.
  const panel = (names, whole, draw, tell, beside) => {
    const canvas = document.createElement('canvas');
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `${names[1]} over ${names[0]}`);
    map.append(canvas);
    const paper = canvas.getContext('2d');
    let part = whole.map((range) => [...range]);
    let drag = null;
    let box = null;
    const margin = { ...MARGIN, right: MARGIN.right + beside };

    const paint = () => {
      const ratio = window.devicePixelRatio || 1;
      const [width, height] = [canvas.clientWidth, canvas.clientHeight];
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      paper.setTransform(ratio, 0, 0, ratio, 0, 0);
      paper.clearRect(0, 0, width, height);
      box = { x: margin.left, y: margin.top, w: width - margin.left - margin.right, h: height - margin.top - margin.bottom };
      const across = (x) => box.x + ((x - part[0][0]) / (part[0][1] - part[0][0])) * box.w;
      const down = (y) => box.y + (1 - (y - part[1][0]) / (part[1][1] - part[1][0])) * box.h;
      paper.font = '12px system-ui, sans-serif';
      paper.fillStyle = '#222';
      paper.strokeStyle = '#e3e3e3';
      paper.lineWidth = 1;
      paper.textAlign = 'center';
      paper.textBaseline = 'top';
      for (const x of ticks(part[0], Math.max(2, box.w / 90))) {
        paper.beginPath();
        paper.moveTo(across(x), box.y);
        paper.lineTo(across(x), box.y + box.h);
        paper.stroke();
        paper.fillText(short(x), across(x), box.y + box.h + 6);
      }
      paper.textAlign = 'right';
      paper.textBaseline = 'middle';
      for (const y of ticks(part[1], Math.max(2, box.h / 45))) {
        paper.beginPath();
        paper.moveTo(box.x, down(y));
        paper.lineTo(box.x + box.w, down(y));
        paper.stroke();
        paper.fillText(short(y), box.x - 6, down(y));
      }
      paper.save();
      paper.beginPath();
      paper.rect(box.x, box.y, box.w, box.h);
      paper.clip();
      draw(paper, across, down, part);
      paper.restore();
      paper.strokeStyle = '#222';
      paper.strokeRect(box.x, box.y, box.w, box.h);
      paper.fillStyle = '#222';
      paper.textAlign = 'center';
      paper.textBaseline = 'alphabetic';
      paper.fillText(names[0], box.x + box.w / 2, height - 8);
      paper.save();
      paper.translate(14, box.y + box.h / 2);
      paper.rotate(-Math.PI / 2);
      paper.fillText(names[1], 0, 0);
      paper.restore();
      if (beside) scaleBeside(paper, box);
      if (drag && drag.to) {
        paper.fillStyle = 'rgba(0, 90, 170, 0.15)';
        paper.fillRect(drag.from[0], drag.from[1], drag.to[0] - drag.from[0], drag.to[1] - drag.from[1]);
      }
    };

    const place = (event) => {
      const edge = canvas.getBoundingClientRect();
      return [event.clientX - edge.left, event.clientY - edge.top];
    };
    const value = ([px, py]) => [
      part[0][0] + ((px - box.x) / box.w) * (part[0][1] - part[0][0]),
      part[1][0] + (1 - (py - box.y) / box.h) * (part[1][1] - part[1][0]),
    ];
    canvas.addEventListener('pointerdown', (event) => {
      drag = { from: place(event), to: null };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      const here = place(event);
      const perPixel = [(part[0][1] - part[0][0]) / box.w, (part[1][1] - part[1][0]) / box.h];
      read.textContent = tell(value(here), perPixel);
      if (drag) {
        drag.to = here;
        paint();
      }
    });
    canvas.addEventListener('pointerup', () => {
      const done = drag;
      drag = null;
      if (done && done.to && Math.abs(done.to[0] - done.from[0]) > 5 && Math.abs(done.to[1] - done.from[1]) > 5) {
        const [a, b] = [value(done.from), value(done.to)];
        part = [0, 1].map((k) => [Math.min(a[k], b[k]), Math.max(a[k], b[k])]);
      }
      paint();
    });
    const all = () => {
      part = whole.map((range) => [...range]);
      paint();
    };
    canvas.addEventListener('dblclick', all);
    document.getElementById('whole').addEventListener('click', all);
    new ResizeObserver(paint).observe(canvas);
    paint();
  };

  // The colour of a share from 0 to 1.
  const colour = (share) => {
    const places = data.colours.length - 1;
    const at = Math.min(Math.max(share, 0), 1) * places;
    const before = Math.min(Math.floor(at), places - 1);
    return [0, 1, 2].map((k) => {
      const [from, to] = [data.colours[before][k], data.colours[before + 1][k]];
      return Math.round(from + (at - before) * (to - from));
    });
  };
  const share = (x) => {
    const [low, high] = data.scale;
    return high > low ? (x - low) / (high - low) : 0.5;
  };

  const scaleBeside = (paper, box) => {
    const x = box.x + box.w + 16;
    for (let k = 0; k < 64; k += 1) {
      paper.fillStyle = `rgb(${colour((k + 0.5) / 64).join(',')})`;
      paper.fillRect(x, box.y + (box.h * (63 - k)) / 64, 16, box.h / 64 + 1);
    }
    paper.fillStyle = '#222';
    paper.textAlign = 'left';
    paper.textBaseline = 'middle';
    for (let k = 0; k <= 4; k += 1) {
      const value = data.scale[0] + ((data.scale[1] - data.scale[0]) * k) / 4;
      paper.fillText(short(value), x + 21, box.y + box.h * (1 - k / 4));
    }
  };

  const heat = () => {
    const [columns, lines, cells] = [numbers(data.columns), numbers(data.lines), numbers(data.cells)];
    const edges = data.edges.map(numbers);
    const image = document.createElement('canvas');
    [image.width, image.height] = [columns.length, lines.length];
    const pixels = new ImageData(columns.length, lines.length);
    cells.forEach((value, cell) => {
      const [column, line] = [cell % columns.length, Math.floor(cell / columns.length)];
      const at = 4 * ((lines.length - 1 - line) * columns.length + column);
      pixels.data.set([...(Number.isFinite(value) ? colour(share(value)) : [190, 190, 190]), 255], at);
    });
    image.getContext('2d').putImageData(pixels, 0, 0);
    const ends = (of) => [of[0], of[of.length - 1]];
    // The cell of a value: the last edge that is not above it.
    const cell = (of, value) => {
      if (!(value >= of[0] && value <= of[of.length - 1])) return -1;
      let [low, high] = [0, of.length - 1];
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (of[middle] <= value) low = middle;
        else high = middle;
      }
      return low;
    };
    const even = edges.every((of) => {
      const width = (of[of.length - 1] - of[0]) / (of.length - 1);
      return of.every((edge, k) => Math.abs(edge - of[0] - k * width) < 0.01 * width);
    });
    const draw = (paper, across, down, part) => {
      paper.imageSmoothingEnabled = false;
      if (even) {
        const [x0, x1] = ends(edges[0]).map(across);
        const [y0, y1] = ends(edges[1]).map(down);
        paper.drawImage(image, x0, y1, x1 - x0, y0 - y1);
        return;
      }
      lines.forEach((_, line) => {
        const [y0, y1] = [down(edges[1][line]), down(edges[1][line + 1])];
        if (edges[1][line + 1] < part[1][0] || edges[1][line] > part[1][1]) return;
        columns.forEach((_, column) => {
          const [x0, x1] = [across(edges[0][column]), across(edges[0][column + 1])];
          paper.drawImage(image, column, lines.length - 1 - line, 1, 1, x0, y1, x1 - x0 + 0.5, y0 - y1 + 0.5);
        });
      });
    };
    const tell = ([x, y]) => {
      const [column, line] = [cell(edges[0], x), cell(edges[1], y)];
      if (column < 0 || line < 0) return '';
      const value = cells[line * columns.length + column];
      const where = `${data.names[0]} = ${short(columns[column])}, ${data.names[1]} = ${short(lines[line])}`;
      return `${where}: ${data.name} = ${Number.isFinite(value) ? short(value) : 'no value, the run failed'}`;
    };
    panel(data.names, edges.map(ends), draw, tell, 96);
  };

  const curves = () => {
    map.classList.toggle('several', data.panels.length > 1);
    for (const { name, sets } of data.panels) {
      for (const set of sets) [set.xs, set.ys] = [numbers(set.x), numbers(set.y)];
      const whole = [extent(sets.map((set) => set.xs)), extent(sets.map((set) => set.ys))].map(wider);
      const draw = (paper, across, down) => {
        for (const { xs, ys, colour: own } of sets) {
          [paper.strokeStyle, paper.fillStyle] = [own, own];
          if (data.kind === 'curves') {
            paper.beginPath();
            // A curve has a gap where a run failed: neither of these does anything for what is not a number.
            let pen = false;
            xs.forEach((x, k) => {
              paper[pen ? 'lineTo' : 'moveTo'](across(x), down(ys[k]));
              pen = Number.isFinite(ys[k]);
            });
            paper.stroke();
          }
          const size = data.kind === 'curves' ? 4 : 1.2;
          xs.forEach((x, k) => paper.fillRect(across(x) - size / 2, down(ys[k]) - size / 2, size, size));
        }
      };
      const tell = ([x, y], perPixel) => {
        let [best, said] = [15 * 15, ''];
        for (const { xs, ys, legend } of sets) {
          xs.forEach((own, k) => {
            const off = ((own - x) / perPixel[0]) ** 2 + ((ys[k] - y) / perPixel[1]) ** 2;
            if (off < best) {
              best = off;
              said = `${data.x} = ${short(own)}${legend && `, ${legend}`}: ${name} = ${short(ys[k])}`;
            }
          });
        }
        return said;
      };
      panel([data.x, name], whole, draw, tell, 0);
    }
  };

  if (data.kind === 'heat') heat();
  else curves();
})();
