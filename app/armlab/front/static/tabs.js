// The tabs of the dock: their names, the keys that go along them, and whether they stand at the edge of the window.
(() => {
  'use strict';
  const root = document.documentElement;

  // A tab says its name at once; viser's own hint would say it once more, a second later. The lab tells what is in it.
  let inside = null;
  const name = tab => {
    const said = tab.title || (tab.matches('.mantine-Tabs-tab') ? tab.textContent.trim() : ''); // viser's tabs on a telephone
    if (said) tab.dataset.name = said;
    tab.removeAttribute('title');
    inside ??= JSON.parse(document.getElementById('al-pages')?.dataset.pages ?? 'null');
    const pages = inside?.[tab.dataset.name];
    if (pages && tab.dataset.pages !== pages) tab.dataset.pages = pages;
  };

  // Tabs torn apart into several strips stand above their panels; one strip is the rail.
  const lay = () => {
    const strips = document.querySelectorAll('[data-dock-region=right] [data-dock-strip][role=tablist]');
    root.toggleAttribute('data-rail', strips.length === 1);
    for (const strip of strips) strip.ariaLabel ??= window.armlabSay('Topics');
  };

  // viser tears a tab off where the hand leaves its strip upwards or downwards. The rail is as high as the window and is
  // left sideways: then it is out of the window until viser has seen that the hand is no longer on it.
  const AWAY = 30; // px
  let held = null;
  let edge = 0;
  document.addEventListener('pointerdown', event => {
    held = event.target.closest?.('[data-dock-region] [data-dock-strip] > [data-dock-tab]') ?? null;
    edge = held ? held.parentElement.getBoundingClientRect().left - AWAY : 0;
  }, true);
  addEventListener('pointermove', event => {
    if (held && event.clientX < edge) root.setAttribute('data-torn', '');
  }, true);
  const letGo = () => {
    held = null;
    root.removeAttribute('data-torn');
  };
  for (const name of ['pointerup', 'pointercancel']) addEventListener(name, letGo, true);

  const see = records => {
    if (held && !held.isConnected) letGo();
    for (const tab of document.querySelectorAll('[data-dock-tab], .mantine-Tabs-tab')) name(tab);
    lay();
    for (const { type, target } of records) {
      // In a low window the open tab is brought into view.
      if (type !== 'attributes' || !target.matches('[data-dock-tab][aria-selected=true]')) continue;
      target.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    }
  };
  window.armlabWatch(see, { attributes: true, attributeFilter: ['title', 'aria-selected'] });

  // viser knows the keys of a lying strip, and opens with them also a tab that the lesson has taken away. The pages of a
  // tab are gone along by the same keys.
  const along = { ArrowUp: -1, ArrowLeft: -1, ArrowDown: 1, ArrowRight: 1 };
  document.addEventListener('keydown', event => {
    const tab = event.target.closest?.('[data-dock-strip] > [data-dock-tab], .pages > .page');
    if (!tab || !(event.code in along || ['Home', 'End'].includes(event.code)) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const tabs = [...tab.parentElement.children].filter(each => !each.hasAttribute('data-off'));
    const next = event.code in along ? tabs[tabs.indexOf(tab) + along[event.code]] : tabs.at(event.code === 'Home' ? 0 : -1);
    next?.focus();
    if (next?.matches('.page')) next.click();
    else next?.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
  }, true);
})();
