// Runs before the page: records all errors for the verdict.
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
// Virtual time passes even if nothing is drawn, so frames are driven by a timer.
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
