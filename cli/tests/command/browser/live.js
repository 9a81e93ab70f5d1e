// Moves sliders of a page that computes, and writes the results into the page.

const canvas = document.getElementById('scene');
const frame = () => new Promise((done) => requestAnimationFrame(done));
const curve = () => document.querySelector('.plot .curve').getAttribute('d');
const asked = JSON.parse(document.getElementById('asked').textContent);
const before = curve();
const runs = [];
for (const changes of asked) {
  for (const [name, value] of Object.entries(changes)) canvas.live.set(name, value);
  for (let k = 0; k < 5; k++) await frame();
  runs.push({
    states: Array.from(canvas.live.states),
    times: canvas.live.times,
    changed: curve() !== before,
    status: document.getElementById('live-status').textContent,
  });
}
const slider = document.querySelector('#sliders input[type=range]');
const shape = curve();
slider.value = Number(slider.min) + 0.8 * (Number(slider.max) - Number(slider.min));
slider.dispatchEvent(new Event('input'));
for (let k = 0; k < 5; k++) await frame();
const moved = curve() !== shape;
document.getElementById('again').click();
for (let k = 0; k < 5; k++) await frame();
const verdict = document.createElement('pre');
verdict.id = 'verdict';
verdict.textContent = JSON.stringify({
  wrong: window.wrong,
  runs,
  moved,
  back: Array.from(canvas.live.states),
  sliders: document.querySelectorAll('#sliders label').length,
});
document.body.append(verdict);
