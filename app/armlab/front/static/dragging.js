// On a machine that draws by program the picture has no shadows while a hand drags: it follows the hand twice as fast.
(() => {
  'use strict';

  const FAR = 4; // px from where it was pressed: a click moves less
  const AFTER = 300; // ms from the end of a drag to the shadows: the arm may still be on its way
  let from = null, dragging = false, timer = 0;

  const begin = event => { from = event.isPrimary ? [event.clientX, event.clientY] : null; };
  const move = event => {
    if (!from || dragging || Math.hypot(event.clientX - from[0], event.clientY - from[1]) < FAR) return;
    dragging = true;
    clearTimeout(timer);
    window.armlabShadows('dragging', false);
  };
  const end = () => {
    from = null;
    if (!dragging) return;
    dragging = false;
    timer = setTimeout(() => window.armlabShadows('dragging', true), AFTER);
  };

  window.armlabSlowDragging = () => {
    addEventListener('pointerdown', begin, true);
    addEventListener('pointermove', move, true);
    for (const name of ['pointerup', 'pointercancel', 'blur']) addEventListener(name, end, true);
  };
})();
