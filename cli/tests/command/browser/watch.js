// Runs before the page: whatever goes wrong in it is kept for the verdict.
window.wrong = [];
window.addEventListener('error', (event) => window.wrong.push(`error: ${event.message}`));
window.addEventListener('unhandledrejection', (event) => window.wrong.push(`rejection: ${event.reason}`));
document.addEventListener('securitypolicyviolation', (event) => window.wrong.push(`fetches ${event.blockedURI}`));
for (const level of ['error', 'warn']) {
  const said = console[level];
  console[level] = (...words) => {
    window.wrong.push(`console: ${words.join(' ')}`);
    said.apply(console, words);
  };
}
// Time is virtual and passes while nothing is drawn: frames come by the clock.
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
