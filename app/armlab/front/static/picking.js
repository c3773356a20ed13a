// Pictures that a hand points into.
(() => {
  'use strict';

  // <div data-chan=ID data-cell=NAME data-pick>: where it is clicked, as parts of its box from the upper left corner.
  const within = (picked, event) => {
    const box = picked.getBoundingClientRect();
    return `${(event.clientX - box.left) / box.width},${(event.clientY - box.top) / box.height}`;
  };
  document.addEventListener('click', event => {
    const picked = event.target.closest?.('[data-pick=""]');
    if (picked) window.armlabSend(picked, within(picked, event));
  });

  // With data-pick=drag also where it is dragged, at most twenty times a second, and the number of the drag.
  let pulled = null, pulls = 0, pullTimer = 0, pulledTo = null;
  const sendPull = () => {
    pullTimer = 0;
    // The answer may have replaced the picture meanwhile.
    if (pulled && !pulled.isConnected) {
      const { chan, cell } = pulled.dataset;
      pulled = document.querySelector(`[data-chan="${CSS.escape(chan)}"][data-cell="${CSS.escape(cell)}"]`);
    }
    if (pulled && pulledTo) window.armlabSend(pulled, `${within(pulled, pulledTo)},${pulls}`);
    pulledTo = null;
  };
  const pull = event => {
    if (!pulled) return;
    pulledTo = event;
    pullTimer ||= setTimeout(sendPull, 50);
  };
  document.addEventListener('pointerdown', event => {
    pulled = event.button === 0 ? event.target.closest?.('[data-pick=drag]') ?? null : null;
    if (!pulled) return;
    pulls += 1;
    event.preventDefault();
    pull(event);
    sendPull();
  });
  addEventListener('pointermove', pull, true);
  for (const name of ['pointerup', 'pointercancel']) {
    addEventListener(name, event => {
      if (!pulled) return;
      if (name === 'pointerup') pulledTo = event;
      clearTimeout(pullTimer);
      sendPull();
      pulled = null;
    }, true);
  }
})();
