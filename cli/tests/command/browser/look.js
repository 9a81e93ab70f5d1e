// Shows a report at times from beginning to end, and writes the observations into the page.

const canvas = document.getElementById('scene');
const data = JSON.parse(document.getElementById('data').textContent);
const frame = () => new Promise((done) => requestAnimationFrame(done));
const coloured = [];
let finite = true;
for (const share of [0, 0.3, 0.7, 1]) {
  const t = data.from + share * (data.to - data.from);
  canvas.report.seek(t);
  await frame();
  await frame();
  finite &&= canvas.report.positions(t).flat().every(Number.isFinite);
  const { data: pixels } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  // Bodies have colours; grid, axes and lettering are grey.
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const [least, most] = [Math.min, Math.max].map((of) => of(pixels[i], pixels[i + 1], pixels[i + 2]));
    if (most - least > 60) count++;
  }
  coloured.push(count);
}
const verdict = document.createElement('pre');
verdict.id = 'verdict';
verdict.textContent = JSON.stringify({
  wrong: window.wrong,
  finite,
  coloured,
  curves: [...document.querySelectorAll('.plot .curve')].map((curve) => curve.getAttribute('d').length),
  formulas: document.querySelectorAll('math').length,
});
document.body.append(verdict);
