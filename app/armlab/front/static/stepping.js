// <div data-roves>: of the buttons with data-rove in it an arrow key presses the next one, and the focus goes with it.
(() => {
  'use strict';

  const EACH = 500; // ms between two of them while the key is held: as long as the arm takes to the next
  const by = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1, Home: -Infinity, End: Infinity };
  let pressed = 0;
  // Before the camera's keys, which these are elsewhere.
  document.addEventListener('keydown', event => {
    const here = event.target.closest?.('[data-roves] [data-rove]');
    if (!here || !(event.key in by) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.repeat && performance.now() - pressed < EACH) return;
    const all = [...here.closest('[data-roves]').querySelectorAll('[data-rove]')];
    const next = all[Math.min(Math.max(all.indexOf(here) + by[event.key], 0), all.length - 1)];
    if (next === here) return;
    pressed = performance.now();
    next.focus();
    next.click();
  }, true);
})();

// A question closes with the Escape key, by its way back. Until it is answered the keys of the page rest; the Tab key goes
// round in it, and its buttons are pressed by the browser itself.
addEventListener('keydown', event => {
  const back = document.querySelector('button[data-escape]');
  if (!back || event.key === 'Tab' || !event.isTrusted) return; // scripts open tabs by keys of their own
  event.stopImmediatePropagation();
  if (event.key !== 'Escape') return;
  event.preventDefault();
  back.click();
}, true);

// The keys of a clicker go through the lesson.
(() => {
  'use strict';

  const BY_CLICKER = { PageDown: 'lesson-next', PageUp: 'lesson-back' };
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    if (event.target.closest?.('input, select, textarea, [contenteditable]')) return;
    const cell = BY_CLICKER[event.code];
    const button = cell && document.querySelector(`.lesson-foot button[data-cell=${cell}]`);
    if (!button) return;
    event.preventDefault();
    button.click();
  });
})();
