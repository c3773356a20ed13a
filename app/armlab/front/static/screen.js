// The screen and the room: projector mode, what the person's system asks for, and where the camera comes to rest.
(() => {
  'use strict';

  const root = document.documentElement;
  const asks = { dark: matchMedia('(prefers-color-scheme: dark)'), still: matchMedia('(prefers-reduced-motion: reduce)') };
  const wayBack = document.createElement('button');
  let told = '';

  // The lab shows a dark page until the person chooses, jumps where others glide, and makes the labels of the scene large.
  const tell = () => {
    const element = document.getElementById('al-notes');
    if (!element) return;
    const { chan } = JSON.parse(element.dataset.notes);
    const text = JSON.stringify({ dark: asks.dark.matches, still: asks.still.matches, large: root.hasAttribute('data-projector') });
    if (chan + text === told) return;
    told = chan + text;
    window.armlabSend({ dataset: { chan, cell: 'screen' } }, text);
  };

  // Projector mode: large text, no benches, a button that leads back. It is the page's own affair: the teacher's other
  // screen stays as it is.
  const project = on => {
    root.toggleAttribute('data-projector', on);
    wayBack.textContent = window.armlabSay('Back: V or Esc');
    if (on) document.body.append(wayBack);
    else wayBack.remove();
    dispatchEvent(new Event('resize')); // viser fits the picture to what is left
    tell();
  };
  Object.assign(wayBack, { type: 'button', className: 'al-back', onclick: () => project(false) });
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    if (event.target.closest?.('input, select, textarea, [contenteditable]')) return;
    const on = root.hasAttribute('data-projector');
    if (event.code === 'KeyV') project(!on);
    else if (event.code === 'Escape' && on) project(false);
  });

  // viser tells where the camera is while it moves, but not the last micrometres until it rests; the lab gives back the
  // view that a person had.
  let camera = null;
  const follow = () => {
    const controls = window.__viserMutable?.cameraControl;
    if (!controls || controls === camera) return;
    camera = controls;
    controls.addEventListener('sleep', () => window.__viserMutable.sendCamera?.());
  };

  window.armlabWatch(window.armlabInFrame(() => {
    tell();
    follow();
  }), { attributes: true, attributeFilter: ['data-notes'] });
  for (const query of Object.values(asks)) query.addEventListener('change', tell);
})();
