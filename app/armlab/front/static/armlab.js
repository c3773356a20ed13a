// Runs before viser's own loader. Everything the lab needs of the page that viser does not offer is here.
(() => {
  'use strict';

  // The address bar keeps what the reader typed: without what could point viser elsewhere, and without a fragment,
  // with which viser cannot connect at all.
  const clean = url => {
    const address = new URL(url ?? '', location.href);
    address.searchParams.delete('websocket');
    address.searchParams.delete('playbackPath');
    address.hash = '';
    return address.pathname + address.search;
  };
  const replace = history.replaceState.bind(history);
  if (location.hash || /[?&](websocket|playbackPath)=/.test(location.search)) replace(null, '', clean(location.href));
  history.replaceState = (state, title, url) => replace(state, title, clean(url));
  addEventListener('hashchange', () => replace(null, '', clean(location.href)));

  // viser reconnects only in the focused tab; a class wants all of its tabs back.
  document.hasFocus = () => true;

  let last = null; // the field or button of ours that has the focus

  // Our own fields and buttons: <input data-chan=ID data-cell=NAME>, <button data-chan=ID data-cell=NAME>.
  const send = (element, value) => {
    const { chan, cell } = element.dataset;
    window.__viserMutable?.sendMessage({
      type: 'GuiUpdateMessage', uuid: chan, updates: { value: JSON.stringify([cell, value, Date.now()]) },
    });
  };
  document.addEventListener('change', event => {
    if (event.target.matches?.('input[data-chan]')) send(event.target, event.target.value);
  });
  document.addEventListener('keydown', event => {
    if (event.key === 'Enter' && event.target.matches?.('input[data-chan]')) {
      event.target.blur();
      last = null;
    }
  });
  document.addEventListener('click', event => {
    const button = event.target.closest?.('button[data-chan]');
    if (button && !button.disabled) send(button, '');
  });

  // The lab replaces the markup around a field; the cursor goes on in the field of the same name.
  document.addEventListener('focusin', event => {
    last = event.target.matches?.('[data-chan]') ? event.target : null;
  });
  // A field the person has left is not to be gone back to. (Its removal looks like leaving it, so focusout cannot tell.)
  document.addEventListener('pointerdown', event => {
    if (!event.target.closest?.('[data-chan]')) last = null;
  }, true);
  const keepFocus = () => {
    if (!last || last.isConnected || document.activeElement !== document.body) return;
    const { chan, cell } = last.dataset;
    const same = document.querySelector(`[data-chan="${chan}"][data-cell="${CSS.escape(cell)}"]`);
    last = same;
    same?.focus({ preventScroll: true });
    if (same?.select) same.select();
  };

  // Keys that move the camera must not do so while a slider, a tab or a list has the focus.
  const cameraKeys = new Set(['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight']);
  document.addEventListener('keydown', event => {
    const inPanel = event.target.closest?.('[role=slider],[role=tab],[role=listbox],[role=combobox],button,input,select');
    if (inPanel && cameraKeys.has(event.code)) event.stopImmediatePropagation();
  });

  // Files the lab would refuse anyway are not sent: viser has no limit of its own.
  document.addEventListener('change', event => {
    const file = event.target.files?.[0];
    if (file && file.size > 5e6) {
      event.stopImmediatePropagation();
      event.target.value = '';
    }
  }, true);

  // What the lab asks of the page: the address of the arm in use, and which tab to bring to the front.
  let asked = '';
  const obey = () => {
    const element = document.getElementById('al-notes');
    if (!element) return;
    const notes = JSON.parse(element.dataset.notes);
    if (location.pathname !== notes.path) replace(null, '', notes.path + location.search);
    if (notes.asked !== asked) {
      const tab = [...document.querySelectorAll('[role=tab]')].find(t => t.title === notes.tab);
      if (tab) {
        asked = notes.asked;
        // A tab answers to the keyboard and to a whole press, not to a bare click.
        tab.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
      }
    }
  };

  // The free part of the window between the docks, for what lies over the scene.
  const measure = () => {
    const canvas = document.querySelector('canvas');
    if (!canvas) return;
    const box = canvas.getBoundingClientRect();
    const style = document.documentElement.style;
    style.setProperty('--al-left', `${box.left}px`);
    style.setProperty('--al-right', `${innerWidth - box.right}px`);
    style.setProperty('--al-mid', `${(box.left + box.right) / 2}px`);
  };

  const watch = () => {
    let due = false;
    new MutationObserver(() => {
      if (due) return;
      due = true;
      requestAnimationFrame(() => {
        due = false;
        keepFocus();
        obey();
        measure();
      });
    }).observe(document.body, { childList: true, subtree: true, attributes: true, attributeFilter: ['data-notes', 'style'] });
    addEventListener('resize', measure);
  };
  if (document.body) watch();
  else addEventListener('DOMContentLoaded', watch);
})();
