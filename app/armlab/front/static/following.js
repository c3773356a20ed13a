// <div data-follows="name">: a list that scrolls by itself stays where it was when its markup is replaced, and another
// entry with aria-current comes into sight.
(() => {
  'use strict';

  const HEAD = 24; // px of a heading that stays at the top of the list
  const left = new Map(); // by name: how far each list was scrolled, and the cell of what was chosen in it
  const known = new WeakSet();
  document.addEventListener('scroll', event => {
    const name = event.target.dataset?.follows;
    if (name) left.set(name, { ...left.get(name), top: event.target.scrollTop });
  }, true);

  const follow = () => {
    for (const list of document.querySelectorAll('[data-follows]')) {
      if (known.has(list) || !list.clientHeight) continue;
      known.add(list);
      const was = left.get(list.dataset.follows);
      const entry = list.querySelector('[aria-current=true]');
      list.scrollTop = was?.top ?? 0;
      if (entry && entry.dataset.cell !== was?.cell) {
        const below = entry.offsetTop + entry.offsetHeight - list.scrollTop > list.clientHeight;
        const above = entry.offsetTop - list.scrollTop < HEAD;
        if (below || above) list.scrollTop = entry.offsetTop - (list.clientHeight - entry.offsetHeight) / 2;
      }
      left.set(list.dataset.follows, { top: list.scrollTop, cell: entry?.dataset.cell });
    }
  };
  window.armlabWatch(window.armlabInFrame(follow), { attributes: true, attributeFilter: ['style'] });
})();
