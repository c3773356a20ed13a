// The dialog of the search: <dialog id=al-search> with a field, a list of options and their markup from the lab.
// Ctrl+K, "/" where nothing is being typed, and every <button data-search> open it.
(() => {
  'use strict';
  const BRINGING = 5000; // ms in which the page of a file may open, and the file become ready
  const LATE = 80; // ms after which nothing typed is still to be sent

  const dialog = () => document.getElementById('al-search');
  const isOpen = () => dialog()?.open === true;
  const field = () => dialog().querySelector('input');
  const list = () => document.getElementById('al-hits');
  const options = () => [...list().querySelectorAll('[role=option]')];

  let active = 0; // the option that Enter takes
  let listed = ''; // the query of the list that is seen
  let waiting = false; // Enter was pressed before the list of what was typed had come

  const mark = index => {
    const found = options();
    active = Math.max(0, Math.min(index, found.length - 1));
    found.forEach((option, i) => option.setAttribute('aria-selected', i === active));
    if (found.length) field().setAttribute('aria-activedescendant', found[active].id);
    else field().removeAttribute('aria-activedescendant');
    if (active) found[active]?.scrollIntoView({ block: 'nearest' });
    else list().scrollTop = 0;
  };

  const isCurrent = () => list().dataset.query === field().value;
  const take = () => {
    waiting = !isCurrent();
    if (!waiting) options()[active]?.click();
  };

  const watcher = new MutationObserver(() => {
    if (!isOpen()) return;
    const query = list().dataset.query;
    mark(query === listed ? active : 0);
    listed = query;
    if (waiting && isCurrent()) take();
  });

  const ask = text => {
    const input = field();
    input.value = text;
    waiting = false;
    input.dispatchEvent(new Event('input', { bubbles: true }));
  };

  const open = () => {
    const found = dialog();
    // A question that waits for an answer is not covered.
    if (!found || found.open || document.querySelector('.mantine-Modal-root [role=dialog]')) return;
    delete field().dataset.unsent;
    listed = '';
    found.showModal();
    watcher.observe(found, { childList: true, subtree: true });
    field().focus();
    field().value = '';
    waiting = false;
    window.armlabSend(field(), '');
    mark(0);
  };

  const close = () => {
    const found = dialog();
    if (!found?.open) return;
    const { chan } = field().dataset;
    watcher.disconnect();
    waiting = false;
    field().value = field().defaultValue = '';
    found.close(); // gives the focus back
    if (found.contains(document.activeElement)) document.activeElement.blur(); // at once, where nothing had it
    // After what was typed last, which is on its way for a moment.
    setTimeout(() => { if (!isOpen()) window.armlabSend({ dataset: { chan, cell: 'search-closed' } }, ''); }, LATE);
  };

  const typing = target => target.closest?.('input, select, textarea, [contenteditable]');
  // Before viser, which has a palette of its own under the same keys.
  addEventListener('keydown', event => {
    const held = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    const palette = held && !event.altKey && (event.shiftKey ? key === 'p' : key === 'k' || event.code === 'KeyK');
    // On many keyboards the slash is on a digit, whose button may be there: Shift and 7 jogs joint 7.
    const digit = /^Digit[0-9]$/.test(event.code) && document.querySelector(`[data-jog^="${Number(event.code.slice(5)) - 1},"]`)?.getClientRects().length;
    if (palette || (event.key === '/' && !digit && !held && !event.altKey && !isOpen() && !typing(event.target))) {
      event.preventDefault();
      event.stopImmediatePropagation();
      if (event.repeat) return;
      if (isOpen()) close();
      else open();
      return;
    }
    if (!isOpen() || event.isComposing) return;
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: 5, PageUp: -5 };
    if (event.key in steps && !held) {
      const count = options().length;
      const by = steps[event.key];
      const next = active + by;
      if (count) mark(Math.abs(by) === 1 ? (next + count) % count : next);
    } else if (event.key === 'Enter') {
      if (!event.repeat) take();
    } else if (event.key === 'Escape') close();
    else return;
    event.preventDefault();
    event.stopImmediatePropagation();
  }, true);

  // The focus stays in the field, whatever is pressed.
  document.addEventListener('mousedown', event => {
    if (event.target.closest?.('#al-search') && event.target !== field()) event.preventDefault();
  });
  document.addEventListener('click', event => {
    const at = event.target;
    if (at.closest?.('[data-search]')) open();
    else if (isOpen() && (at === dialog() || at.closest('[data-shut]'))) close();
    else {
      const option = at.closest?.('#al-search [role=option]');
      if (!option) return;
      if (option.dataset.ask !== undefined) ask(option.dataset.ask);
      else if (option.dataset.cell !== undefined) {
        if (option.dataset.brings) bring();
        close(); // after the script that sends it
      }
    }
  });
  document.addEventListener('pointermove', event => {
    const option = isOpen() && event.target.closest?.('#al-search [role=option]');
    if (option && option.getAttribute('aria-selected') !== 'true') mark(options().indexOf(option));
  });
  document.addEventListener('cancel', event => {
    if (event.target !== dialog()) return;
    event.preventDefault(); // a way to close that is no key: back on a telephone
    close();
  }, true);

  // A file that was picked: its page is opened by the lab, which then says where its control is. That may have to wait
  // for the file to be ready; after a while it is shown as it is.
  const noted = () => document.getElementById('al-bring')?.dataset.bring ?? '';
  let bringing = 0;
  const bring = () => {
    const before = noted();
    const until = performance.now() + BRINGING;
    clearInterval(bringing);
    bringing = setInterval(() => {
      const late = performance.now() > until;
      const found = noted() !== before && control(JSON.parse(noted()));
      const ready = found && (late || !found.disabled);
      if (ready) show(found);
      if (ready || late) clearInterval(bringing);
    }, 60);
  };
  const shownIn = element => (element.closest('label') ?? element).getClientRects().length > 0 || folds(element).some(fold => !fold.open);
  // Those around an element: a fold holds what is inside, or the folder beside it.
  const folds = element => {
    const found = [];
    for (let at = element; at; at = at.parentElement) {
      if (at.matches('details')) found.push(at);
      const head = at.previousElementSibling?.querySelector(':scope > .al > details.kit-holds');
      if (head) found.push(head);
    }
    return found.filter(fold => fold.getClientRects().length || folds(fold.parentElement).length);
  };
  const control = ({ tab, at }) => {
    const mark = document.querySelector(`[data-tab="${CSS.escape(tab)}"]`);
    if (mark && !mark.parentElement.getClientRects().length) return null; // the tab is still being opened
    return [...document.querySelectorAll(at)].find(shownIn);
  };
  const show = element => {
    const shown = element.closest('label') ?? element;
    for (const fold of folds(shown)) fold.open = true;
    shown.scrollIntoView({ block: 'center' });
    element.focus({ preventScroll: true });
    shown.dataset.brought = '1';
    setTimeout(() => delete shown.dataset.brought, 2500);
  };
})();
