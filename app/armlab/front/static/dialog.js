// Dialogs over the scene: <div class="al-dialog" role="dialog" data-page=NAME>, with a button whose cell ends in -close.
// The focus goes in when one comes and returns when it goes; Escape and a press beside it close it; Tab stays inside.
(() => {
  'use strict';

  const dialog = () => document.querySelector('.al-dialog');
  const close = () => document.querySelector('.al-dialog [data-cell$="-close"]')?.click();
  const touch = matchMedia('(pointer: coarse)'); // a field with the focus would cover half of a phone with its keys
  let page = ''; // of the dialog that is there
  let from = null; // cell of the button that opened it
  let waiting = false; // Enter was pressed before the arms of what was typed had come

  document.addEventListener('click', event => {
    const button = event.target.closest?.('button[aria-haspopup=dialog]');
    if (button) from = button.dataset.cell;
    if (event.target.matches?.('.al-scrim')) close();
  }, true);

  const follow = () => {
    const there = dialog();
    const now = there?.dataset.page ?? '';
    if (waiting && there && isCurrent(there)) take(there);
    if (now === page) return;
    page = now;
    waiting = false;
    if (there) {
      const field = touch.matches ? null : there.querySelector('[data-first]');
      (field ?? there).focus({ preventScroll: true });
      there.querySelector('.scroll').scrollTop = 0;
    } else if (from && (document.activeElement === document.body || !document.activeElement)) {
      document.querySelector(`button[data-cell="${CSS.escape(from)}"]`)?.focus({ preventScroll: true });
    }
  };
  window.armlabWatch(follow);

  const reached = there => [...there.querySelectorAll('button, input, select, textarea, a[href]')]
    .filter(each => !each.disabled && each.getClientRects().length);

  const arms = there => reached(there).filter(each => each.matches('.arm'));
  const steps = list => { // how many stand beside each other
    const top = list[0]?.getBoundingClientRect().top;
    return Math.max(1, list.filter(each => each.parentElement === list[0].parentElement
      && each.getBoundingClientRect().top === top).length);
  };

  const isCurrent = there => there.dataset.query === there.querySelector('[data-first]')?.value;
  const take = there => {
    waiting = !isCurrent(there);
    if (!waiting) arms(there).find(each => each.dataset.cell !== 'arms-new')?.click();
  };

  // Down from the field come the arms; among them the arrows go on, and Enter in the field takes the first that is left.
  const arrows = (there, event) => {
    const list = arms(there);
    const at = list.indexOf(document.activeElement);
    const inField = event.target.matches('[data-first]');
    const enters = inField && event.key === 'Enter';
    if (inField && !enters) waiting = false;
    if (!enters && (!list.length || (at < 0 && !inField))) return;
    const by = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: steps(list), ArrowUp: -steps(list) }[event.key];
    if (enters) take(there);
    else if (inField && event.key === 'ArrowDown') list[0].focus();
    else if (!inField && by && list[at + by]) list[at + by].focus();
    else if (!inField && by < 0) there.querySelector('[data-first]')?.focus();
    else return;
    event.preventDefault();
  };

  addEventListener('keydown', event => {
    const there = dialog();
    // What lies over the dialog has the keys.
    if (!there || document.getElementById('al-search')?.open || document.querySelector('button[data-escape]')) return;
    if (event.key === 'Escape') {
      event.preventDefault();
      event.stopImmediatePropagation();
      close();
    } else if (event.key === 'Tab') {
      const all = reached(there);
      const at = all.indexOf(document.activeElement);
      const ends = event.shiftKey ? at <= 0 : at === all.length - 1;
      if (!there.contains(document.activeElement) || ends) {
        event.preventDefault();
        all[event.shiftKey ? all.length - 1 : 0]?.focus();
      }
    } else if (there.contains(event.target)) {
      arrows(there, event);
      // Keys of the scene rest meanwhile.
      if (!event.ctrlKey && !event.metaKey && !event.target.matches('input, textarea, select')
        && !['Enter', ' '].includes(event.key)) event.stopImmediatePropagation();
    } else if (event.target === document.body && !event.ctrlKey && !event.metaKey) { // after a press of the mouse
      event.stopImmediatePropagation();
    }
  }, true);

  // A table of several lines or columns that is pasted anywhere in the form of a new arm fills its rows.
  document.addEventListener('paste', event => {
    const area = dialog()?.querySelector('textarea.paste');
    const text = event.clipboardData?.getData('text') ?? '';
    if (!area || !(event.target === area || /[\n\t]/.test(text.trim()))) return;
    event.preventDefault();
    area.value = text;
    window.armlabSend(area, text);
  }, true);
})();
