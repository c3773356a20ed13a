// Pictures in the text of a lesson: a press shows one as large as the window allows, Esc or another press ends it.
(() => {
  'use strict';

  const PICTURES = '.lesson-text img';
  const dialog = document.createElement('dialog');
  const large = document.createElement('img');
  const shut = Object.assign(document.createElement('button'), { type: 'button', className: 'chip', textContent: '✕' });
  dialog.className = 'al-picture';
  dialog.append(large, shut);
  dialog.addEventListener('click', () => dialog.close());

  let last = null; // the picture that has the focus, or had it before the dialog
  // The text comes anew whenever a value in it changes, and its pictures with it.
  const now = () => last?.isConnected ? last : [...document.querySelectorAll(PICTURES)].find(each => each.src === last?.src);
  const back = () => now()?.focus({ preventScroll: true });

  const show = picture => {
    last = picture;
    [large.src, large.alt] = [picture.src, picture.alt];
    shut.ariaLabel = window.armlabSay('Close');
    dialog.ariaLabel = picture.alt || window.armlabSay('Picture');
    document.body.append(dialog);
    dialog.showModal();
  };
  dialog.addEventListener('close', () => {
    dialog.remove();
    back();
  });

  window.armlabWatch(() => {
    for (const picture of document.querySelectorAll(`${PICTURES}:not([role])`)) {
      if (picture.closest('button')) continue; // that of an answer is pressed to choose it
      const said = { role: 'button', tabindex: '0', 'aria-haspopup': 'dialog', title: window.armlabSay('Show large') };
      for (const [name, value] of Object.entries(said)) picture.setAttribute(name, value);
    }
    if (dialog.open && !now()) dialog.close(); // its step has gone
    else if (last && !last.isConnected && document.activeElement === document.body) back();
  });

  const pressed = event => event.target.closest?.(`${PICTURES}[role=button]`);
  document.addEventListener('focusin', event => { if (!dialog.open) last = pressed(event) ?? null; });
  document.addEventListener('pointerdown', () => { if (!dialog.open) last = null; }, true); // left without another focus
  document.addEventListener('click', event => { if (pressed(event)) show(pressed(event)); });
  // Before the keys of the page, which rest while a picture is large.
  addEventListener('keydown', event => {
    if (dialog.open) {
      event.stopImmediatePropagation();
      if (event.key !== 'Escape') return;
      event.preventDefault();
      dialog.close();
    } else if (['Enter', ' '].includes(event.key) && pressed(event)) {
      event.preventDefault();
      event.stopImmediatePropagation();
      if (!event.repeat) show(event.target);
    }
  }, true);
})();
