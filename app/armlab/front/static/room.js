// How much of the window is free between the docks, for what lies over the scene.
(() => {
  'use strict';

  let measured = '';
  const measure = () => {
    const canvas = document.querySelector('canvas');
    if (!canvas) return;
    const box = canvas.getBoundingClientRect();
    const found = [box.left, innerWidth - box.right, box.width, (box.left + box.right) / 2].map(x => `${x}px`);
    if (found.join() === measured) return; // setting one, even to what it is, has the whole page styled anew
    measured = found.join();
    ['left', 'right', 'wide', 'mid'].forEach((name, i) => document.documentElement.style.setProperty(`--al-${name}`, found[i]));
  };

  window.armlabWatch(window.armlabInFrame(measure), { attributes: true, attributeFilter: ['style'] });
  addEventListener('resize', measure);
})();
