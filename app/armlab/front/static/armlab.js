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

  // Calls when something in the page has changed, as soon as there is a page.
  window.armlabWatch = (call, more = {}) => {
    const watch = () => new MutationObserver(call).observe(document.body, { childList: true, subtree: true, ...more });
    if (document.body) watch();
    else addEventListener('DOMContentLoaded', watch);
  };
  // Returns a function that calls once in the next frame, however often it is called before.
  window.armlabInFrame = call => {
    let due = false;
    return () => {
      if (due) return;
      due = true;
      requestAnimationFrame(() => {
        due = false;
        call();
      });
    };
  };

  let last = null; // the field or button of ours that has the focus

  // Our own fields and buttons: <input data-chan=ID data-cell=NAME>, <button data-chan=ID data-cell=NAME>.
  // What is asked with them stands around them as data-of; the lab is told, as it may ask something else meanwhile.
  const questionOf = element => element.closest?.('[data-of]')?.dataset.of;
  const send = (element, value) => {
    const { chan, cell } = element.dataset;
    const number = window.armlabNumber(element, value), said = [cell, value, number, questionOf(element)];
    if (element.isConnected) window.armlabAsked = number; // by a person: what scripts tell is of no element
    window.__viserMutable?.sendMessage({ type: 'GuiUpdateMessage', uuid: chan, updates: { value: JSON.stringify(said) } });
  };
  window.armlabSend = send;
  window.armlabQuestion = questionOf;
  // Of two fields or buttons of one name, in markup of two moments: whether both are of the same question.
  window.armlabSame = (one, other) => questionOf(one) === questionOf(other);
  const typed = 'input[data-chan]:not([data-live]):not([type=file]), select[data-chan], textarea[data-chan]';
  document.addEventListener('change', event => {
    if (event.target.matches?.(typed)) send(event.target, event.target.value);
  });

  // Sliders of ours tell where they are while they move, at most twenty times a second, and where they end.
  let live = null;
  let liveValue = ''; // as the hand has left it: the page's clock may have moved the thumb since
  let liveTimer = 0;
  const sendLive = () => {
    liveTimer = 0;
    if (live) send(live, liveValue);
    live = null;
  };
  document.addEventListener('input', event => {
    if (!event.target.matches?.('input[data-live]')) return;
    live = event.target;
    liveValue = live.value;
    liveTimer ||= setTimeout(sendLive, 50);
    // Until the lab answers, the thumb stays where the hand has put it.
    if (live.dataset.cell === 'seek' && clock) clock = { ...clock, time: live.value * clock.end, at: performance.now() };
  });

  // <button data-copy=TEXT>: where the page is not served securely there is no clipboard, but there is the old way.
  const copy = async text => {
    if (navigator.clipboard) return navigator.clipboard.writeText(text);
    const area = document.createElement('textarea');
    const focused = document.activeElement;
    area.value = text;
    (document.querySelector('dialog[open]') ?? document.body).append(area); // what lies behind a dialog gets no focus
    area.select();
    const copied = document.execCommand('copy');
    area.remove();
    focused?.focus?.({ preventScroll: true });
    if (!copied) throw new Error('nothing was copied');
  };
  document.addEventListener('click', event => {
    const button = event.target.closest?.('button[data-copy]');
    if (!button) return;
    copy(button.dataset.copy).then(() => {
      button.dataset.done = '1';
      setTimeout(() => delete button.dataset.done, 1200);
    }, () => { button.dataset.done = '0'; });
  });

  // In a field where nothing has been typed Ctrl+Z is the lab's, not the field's.
  document.addEventListener('keydown', event => {
    const field = event.target;
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z' || !field.matches?.('input.field:not([data-live])')) return;
    if (field.value !== field.defaultValue) return;
    event.preventDefault();
    document.querySelector(`.al-steps button[data-cell=${event.shiftKey ? 'redo' : 'undo'}]`)?.click();
  });

  // <button data-key=CODE> is pressed by that key when no control has the focus.
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const control = event.target.closest?.('input, select, textarea, button, summary, [role=slider], [role=combobox], [contenteditable]');
    if (control && !control.matches('.al-time input')) return; // the thumb of the timeline needs none of these keys
    if (event.target.closest?.('[role=tab]:not([aria-selected=true])')) return; // it is opened by them
    const seen = button => !button.disabled && button.getClientRects().length > 0;
    const buttons = [...document.querySelectorAll(`button[data-key="${CSS.escape(event.code)}"]`)].filter(seen);
    // The page that is open comes before the timeline, on which something else may be.
    const button = buttons.find(each => !each.closest('.al-time')) ?? buttons[0];
    if (!button) return;
    event.preventDefault();
    event.stopPropagation(); // an open tab that has the focus would take them to be dragged
    button.click();
  }, true);
  document.addEventListener('keydown', event => {
    if (event.key !== 'Enter' || !event.target.matches?.('input[data-chan]:not([data-live]):not([type=file])')) return;
    // In a table Enter goes down the column, as in a spreadsheet; in a matrix it goes on, and at its end presses the
    // button that hands it in; elsewhere it leaves the field.
    const below = event.target.dataset.below;
    const { chan } = event.target.dataset;
    const next = below && document.querySelector(`[data-chan="${chan}"][data-cell="${CSS.escape(below)}"]`);
    leave(event.target);
    if (next?.matches('button')) next.click();
    else if (next) {
      next.focus();
      next.select();
    }
  });
  document.addEventListener('click', event => {
    if (event.detail) event.target.closest?.('summary')?.blur(); // so that the space bar plays after a press of the mouse
    const button = event.target.closest?.('button[data-chan]');
    if (!button || button.disabled) return;
    send(button, '');
    if (event.detail && !button.matches('[data-rove]')) { // done with: the space bar plays, and does not press it again
      leave(button);
    }
  });

  // A field that is left is sent, and its answer may replace the button that is being pressed: the press counts.
  let down = null;
  document.addEventListener('pointerdown', event => { down = event.target.closest?.('button[data-chan]:not([data-jog])'); }, true);
  document.addEventListener('pointerup', event => {
    const button = event.target.closest?.('button[data-chan]');
    const same = down && !down.isConnected && button?.dataset.chan === down.dataset.chan && button.dataset.cell === down.dataset.cell
      && window.armlabSame(button, down);
    down = null;
    if (same) button.click();
  }, true);

  // What was opened and how far was read stays when a value in the text changes, as long as it is the same step.
  const opened = new Map();
  const met = new WeakSet();
  const isOfText = details => details.closest('.lesson-text') !== null;
  const nameOf = details => `${isOfText(details)} ${details.dataset.fold ?? details.querySelector('summary')?.textContent}`;
  let read = { title: '', top: 0 };
  let text = null;
  document.addEventListener('toggle', event => {
    if (event.target.isConnected && event.target.matches('.al details')) opened.set(nameOf(event.target), event.target.open);
  }, true);
  document.addEventListener('scroll', event => {
    if (event.target === text) read.top = text.scrollTop;
  }, true);
  const keepReading = () => {
    const found = document.querySelector('.lesson-text');
    const isNew = found !== null && found !== text;
    if (isNew) text = found;
    const title = isNew && document.querySelector('.lesson-head select')?.value + text.querySelector('h2')?.textContent;
    const isOther = isNew && title !== read.title;
    if (isOther) for (const name of [...opened.keys()]) if (name.startsWith('true ')) opened.delete(name); // folds of panels stay
    for (const details of document.querySelectorAll('.al details')) {
      if (met.has(details)) continue;
      met.add(details);
      details.open = opened.get(nameOf(details)) ?? details.open;
    }
    if (isOther) {
      read = { title, top: 0 };
      const dock = text.closest('.mantine-ScrollArea-viewport'); // in a small window all of it scrolls
      if (dock) dock.scrollTop = 0;
    } else if (isNew) text.scrollTop = read.top;
  };

  // Where the lab has to replace a field as well, the cursor goes on in the field of the same name.
  document.addEventListener('focusin', event => {
    place = null;
    last = event.target.matches?.('[data-chan]') ? event.target : null;
  });
  document.addEventListener('focusout', event => {
    const field = event.target;
    if (!field.dataset?.unsent || !field.isConnected) return;
    delete field.dataset.unsent;
    send(field, field.value);
  });
  document.addEventListener('change', event => delete event.target.dataset?.unsent, true);
  // A field the person has left is not to be gone back to. (Its removal looks like leaving it, so focusout cannot tell.)
  document.addEventListener('pointerdown', event => {
    if (!event.target.closest?.('[data-chan]')) last = place = null;
  }, true);
  const twinOf = control => {
    const { chan, cell } = control.dataset;
    const found = document.querySelector(`[data-chan="${chan}"][data-cell="${CSS.escape(cell)}"]`);
    return found && window.armlabSame(found, control) ? found : null;
  };
  const keepFocus = () => {
    if (!last || last.isConnected || document.activeElement !== document.body) return;
    const same = twinOf(last);
    // What was typed before the new markup came is not lost.
    const unsent = last.matches('input.field') && last.value !== last.defaultValue ? last.value : null;
    last = same;
    same?.focus({ preventScroll: true });
    if (unsent !== null && same) {
      same.value = unsent;
      same.dataset.unsent = '1'; // a value set here is no change to the page: it has to be sent when it is left
    } else if (same?.select) same.select();
  };

  // A control that Enter or the mouse is done with gives up the focus, so that the keys of the page count again. The Tab
  // key goes on from its place, also in the markup of the answer.
  let place = null;
  const leave = control => {
    control.blur();
    last = null;
    place = control;
  };
  addEventListener('keydown', event => {
    if (event.key !== 'Tab' || !place || document.activeElement !== document.body) return;
    (place.isConnected ? place : twinOf(place))?.focus({ preventScroll: true }); // the browser itself goes on from there
  }, true);

  // Keys that move the camera must not do so while a slider, a tab or a list has the focus.
  const cameraKeys = new Set(['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight']);
  document.addEventListener('keydown', event => {
    const inPanel = event.target.closest?.('[role=slider],[role=tab],[role=listbox],[role=combobox],button,input,select');
    if (inPanel && cameraKeys.has(event.code)) event.stopImmediatePropagation();
  });

  // What the lab asks of the page: the address of the arm in use, and which tab to bring to the front.
  let asked = '';
  let question = null; // before an assignment begins: its address, and the channel of the notes while it stood
  let wanted = '';
  const tabCalled = name => document.querySelector(`:is([data-dock-tab], .mantine-Tabs-tab)[data-name="${CSS.escape(name)}"]`);
  // A page begins with the first tab, which nobody has asked for. Until the one the lab wants is open, or time is over,
  // the lab hears of none, or it would build the first one, and read all lessons for it.
  const OPENING = 3000; // ms
  let opening = '';
  const isOpening = () => {
    if (opening && tabCalled(opening)?.getAttribute('aria-selected') === 'true') opening = '';
    return opening !== '';
  };
  let presses = 0;
  let again = 0;
  const bringForward = () => {
    const tab = wanted && tabCalled(wanted);
    if (!tab) return;
    clearTimeout(again);
    if (!presses-- || tab.getAttribute('aria-selected') === 'true') return void (wanted = '');
    // A tab of the dock answers to the keyboard and to a whole press, not to a bare click.
    if (tab.matches('button')) tab.click();
    else tab.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
    again = setTimeout(bringForward, 100); // at first it may take no press
  };
  const obey = () => {
    const element = document.getElementById('al-notes');
    if (!element) return;
    const notes = JSON.parse(element.dataset.notes);
    const asks = document.getElementById('al-asks')?.dataset.path;
    // A question goes with the connection; the address that asked it asks again.
    if (!asks && question && question.chan !== notes.chan) location.replace(question.path + location.search);
    question = asks ? { path: asks, chan: notes.chan } : null;
    const path = asks ?? notes.path;
    if (location.pathname !== path) replace(null, '', path + location.search);
    for (const tab of document.querySelectorAll(':is([data-dock-tab], .mantine-Tabs-tab)[data-name]')) {
      tab.toggleAttribute('data-off', notes.hidden.includes(tab.dataset.name));
    }
    if (notes.asked !== asked) {
      asked = notes.asked;
      wanted = opening = notes.tab;
      presses = 30;
      setTimeout(() => { opening = ''; tellTabs(); }, OPENING);
    }
    bringForward();
  };

  // Another step of a lesson begins at its top.
  let step = '';
  const toTop = () => {
    const text = document.querySelector('.lesson-text');
    const title = text?.querySelector('h2')?.textContent ?? '';
    if (title === step) return;
    step = title;
    for (let area = text; area; area = area.parentElement) {
      if (area.scrollTop) area.scrollTop = 0;
    }
  };

  // Which tabs are seen: the lab shows nothing in those that are not.
  let seen = '["joints"]';
  const tellTabs = () => {
    const element = document.getElementById('al-notes');
    if (!element || isOpening()) return;
    // A tab that has been seen stays in the page and is only not displayed.
    const marks = [...document.querySelectorAll('[data-tab]')].filter(mark => mark.parentElement.getClientRects().length);
    const keys = [...new Set(marks.map(mark => mark.dataset.tab))].sort();
    const text = JSON.stringify(keys);
    const { chan } = JSON.parse(element.dataset.notes);
    if (text === seen && chan === toldTo) return;
    seen = text;
    toldTo = chan;
    send({ dataset: { chan, cell: 'tabs' } }, text);
  };
  let toldTo = '';

  // The timeline: between two marks of the lab its thumb and the cursors of plots follow the page's own clock.
  let clock = null;
  let clockText = '';
  const readClock = () => {
    const text = document.getElementById('al-clock')?.dataset.clock ?? '';
    if (text !== clockText) {
      clockText = text;
      clock = text ? { ...JSON.parse(text), at: performance.now() } : null;
      if (clock) requestAnimationFrame(showClock);
      window.armlabPlaying(clock !== null && clock.rate > 0);
    }
    drawClock(performance.now()); // the bar may have been made anew, without its time
  };
  const drawClock = now => {
    if (!clock) return 0;
    const time = Math.min(clock.time + clock.rate * Math.max(0, now - clock.at) / 1000, clock.end);
    const part = clock.end > 0 ? time / clock.end : 0;
    const thumb = document.querySelector('.al-time input[type=range]');
    if (thumb && !thumb.matches(':active')) thumb.value = part;
    const label = document.querySelector('.al-time .now');
    const text = `${time.toFixed(1)} / ${clock.end.toFixed(1)} s`;
    if (thumb && thumb.ariaValueText !== text) thumb.ariaValueText = text;
    if (label && label.textContent !== text) label.textContent = text;
    placeCursors(part);
    window.armlabTray.time(time);
    return time;
  };
  const CLOCK_INTERVAL = 45; // ms: each move of the thumb is a layout of the page, and takes time from the picture
  let clockDrawn = 0;
  const showClock = now => {
    if (!clock || now === clockDrawn) return;
    const going = clock.rate > 0 && clock.time + clock.rate * (now - clock.at) / 1000 < clock.end;
    if (!going || now - clockDrawn >= CLOCK_INTERVAL) {
      clockDrawn = now;
      drawClock(now);
    }
    if (going) requestAnimationFrame(showClock);
  };

  // <i data-cursor=PART> after a plot: a line at that part of its width; PART "time" follows the timeline.
  const placeCursors = part => {
    for (const mark of document.querySelectorAll('[data-cursor]')) {
      const over = mark.closest('[data-tabpanel], [role=tabpanel], body').querySelectorAll('.u-over');
      const plot = [...over].filter(o => o.compareDocumentPosition(mark) & Node.DOCUMENT_POSITION_FOLLOWING).pop();
      if (!plot) continue;
      let line = plot.querySelector('.al-cursor');
      if (!line) {
        line = document.createElement('div');
        line.className = 'al-cursor';
        plot.append(line);
      }
      const at = mark.dataset.cursor === 'time' ? part : Number(mark.dataset.cursor);
      const shown = Number.isFinite(at) && mark.dataset.cursor !== '';
      line.style.display = shown ? '' : 'none';
      if (shown) line.style.left = `${100 * at}%`;
    }
  };

  const WATCHED = { attributes: true, attributeFilter: ['data-notes', 'data-clock', 'data-cursor', 'style'] };
  // At once: in the next frame the person may have gone on to another field already.
  window.armlabWatch(keepFocus, WATCHED);
  window.armlabWatch(window.armlabInFrame(() => {
    keepReading();
    obey();
    toTop();
    tellTabs();
    readClock();
    placeCursors(clock && clock.end > 0 ? clock.time / clock.end : NaN);
  }), WATCHED);
})();
