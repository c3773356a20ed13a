// The tray below the scene: the plots of the open page, large. The lab says which plots there are (#al-tray), and sends
// those that are asked for (data-tray-plot); which these are, how high the tray is and what is zoomed is the page's own
// affair. The picture of the scene gets smaller, and is not covered.
(() => {
  'use strict';

  const root = document.documentElement;
  const LEAST = 170, SHARE = 0.4; // px, and the largest part of the window's height
  const NARROW = 440, WIDE = 900; // px: a plot is at least as wide, and not cut in two when the tray is narrower
  const LOW = 190; // px: the least height of a plot among others below each other
  const POINTS = 1.5; // of a curve for each pixel of the screen
  const SENT = 50; // ms between two places of the timeline
  const PATIENCE = 3000; // ms in which a clip opens

  let head = null, headText = '';
  let asked = 0; // number of the wish of the lab that was followed
  let chosen = []; // keys of the plots that are shown
  const plots = new Map();
  let height = 0, full = false, time = null, scrubbed = false, last = '';
  let tray, chips, body, grip;

  const send = (cell, value = '') => window.armlabSend({ dataset: { chan: head.chan, cell } }, value);
  const most = () => Math.round(SHARE * innerHeight);
  const bounded = px => Math.round(Math.min(Math.max(px, Math.min(LEAST, most())), most()));

  // -- what the plots ask for ----------------------------------------------------------------------------------------
  const clock = () => {
    const text = document.getElementById('al-clock')?.dataset.clock;
    return text ? JSON.parse(text) : null;
  };
  const clipOf = key => head?.plots.find(each => each.key === key)?.clip ?? '';
  const thumb = () => document.querySelector('.al-time input[type=range]');
  let waiting = null, timer = 0, place = null, since = 0;
  const forget = () => {
    clearTimeout(timer);
    [timer, place, scrubbed] = [0, null, false];
  };
  const move = () => {
    timer = 0;
    const now = clock();
    if (place === null) return;
    if (!now || now.clip !== waiting || !thumb()) {
      if (performance.now() - since > PATIENCE) forget(); // what was asked for has come to nothing
      else timer = setTimeout(move, SENT);
      return;
    }
    const range = thumb();
    range.value = Math.min(Math.max(now.end > 0 ? place / now.end : 0, 0), 1);
    place = null;
    range.dispatchEvent(new Event('input', { bubbles: true }));
  };
  const asks = {
    // What a hand points at is read in all plots with the same abscissa.
    point: (plot, at) => {
      for (const each of plots.values()) if (each === plot || each.picture?.x === plot.picture.x) each.point(at);
    },
    canScrub: plot => clipOf(plot.key) !== '',
    scrub: (plot, at, done) => {
      if (plots.get(plot.key) !== plot) return; // it was closed in the hand
      scrubbed = !done;
      [place, waiting] = [at, clipOf(plot.key)];
      since = performance.now();
      if (clock()?.clip !== waiting) send('clip', JSON.stringify({ key: plot.key, time: at }));
      timer ||= setTimeout(move, 0);
      for (const each of plots.values()) if (clipOf(each.key) === waiting) each.at(at);
    },
    save: (kind, plot) => {
      if (kind === 'csv') send('csv', plot.key);
      else window.armlabSavePlot(kind, plot, head.plots.find(each => each.key === plot.key)?.file ?? 'plot');
    },
  };

  // -- the tray itself -----------------------------------------------------------------------------------------------
  const make = () => {
    const say = window.armlabSay;
    tray = document.createElement('section');
    tray.className = 'al-tray';
    tray.ariaLabel = say('Plots');
    tray.innerHTML = `<div class="tray-grip" role="separator" tabindex="0" aria-orientation="horizontal" aria-label="${say('Height of the plots')}"></div>`
      + `<div class="tray-bar"><div class="tray-chips" role="group" aria-label="${say('Plots shown')}"></div>`
      + `<span class="tray-hint"></span><button type="button" data-tray="full" title="${say('The plots in place of the scene')}">${say('⤢ Full view')}</button>`
      + `<button type="button" data-tray="close" aria-label="${say('Close the plots')}" title="${say('Close (X or Esc)')}">✕</button></div>`
      + '<div class="tray-plots"></div>';
    [grip, chips, body] = ['.tray-grip', '.tray-chips', '.tray-plots'].map(each => tray.querySelector(each));
    tray.addEventListener('click', event => {
      const button = event.target.closest('button[data-tray], button[data-plot]');
      if (!button) return;
      if (button.dataset.tray === 'close') close();
      else if (button.dataset.tray === 'full') setFull(!full);
      else choose(button.dataset.plot);
    });
    grip.addEventListener('pointerdown', event => {
      if (event.button !== 0) return;
      grip.setPointerCapture(event.pointerId);
      const from = event.clientY + height;
      grip.onpointermove = moved => setHeight(from - moved.clientY);
      grip.onpointerup = grip.onpointercancel = () => { grip.onpointermove = null; };
    });
    grip.addEventListener('keydown', event => {
      const to = { ArrowUp: height + 24, ArrowDown: height - 24, Home: LEAST, End: most() }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      setHeight(to);
    });
    new ResizeObserver(() => { lay(); look(); }).observe(body);
  };

  const setHeight = px => {
    height = bounded(px);
    root.style.setProperty('--al-tray', `${height}px`);
    Object.assign(grip, { ariaValueNow: height, ariaValueMin: Math.min(LEAST, most()), ariaValueMax: most() });
  };
  const setFull = on => {
    full = on;
    root.setAttribute('data-tray', full ? 'full' : 'low');
    tray.querySelector('[data-tray=full]').ariaPressed = String(full);
    lay();
  };
  const open = () => {
    if (!tray) make();
    if (!tray.isConnected) document.body.append(tray);
    full = false;
    setFull(false);
    setHeight(height || most());
  };
  const close = () => {
    const hadFocus = tray?.contains(document.activeElement);
    if (head) send('close');
    head = null;
    forget();
    last = ''; // what is asked for is kept: until the lab has answered, the page still says it
    plots.clear();
    body?.replaceChildren();
    tray?.remove();
    root.removeAttribute('data-tray');
    const openers = [...document.querySelectorAll('button[data-cell=large], button[data-cell^=large-]')];
    if (hadFocus) openers.find(each => each.getClientRects().length)?.focus({ preventScroll: true });
  };

  // -- which plots ---------------------------------------------------------------------------------------------------
  const fits = () => Math.max(1, Math.min(3, Math.floor(body.clientWidth / NARROW)));
  const begin = key => {
    const keys = head.plots.map(each => each.key);
    const at = Math.max(0, Math.min(keys.indexOf(key), keys.length - fits()));
    chosen = keys.slice(at, at + fits());
  };
  const choose = key => {
    const kept = chosen.filter(each => each !== key);
    if (kept.length === chosen.length) kept.push(key);
    if (kept.length) chosen = kept;
    arrange();
  };

  // The chosen plots that are there, in the order of the page; others when all have gone.
  const arrange = () => {
    const keys = head.plots.map(each => each.key);
    if (!chosen.some(each => keys.includes(each)) && keys.length) begin(keys[0]);
    const shown = keys.filter(each => chosen.includes(each));
    const listed = JSON.stringify([head.plots, shown]);
    if (listed !== chips.dataset.listed) {
      chips.dataset.listed = listed;
      const focused = chips.contains(document.activeElement) && document.activeElement.dataset.plot;
      chips.replaceChildren(...head.plots.length < 2 ? [] : head.plots.map(({ key, title }) => Object.assign(document.createElement('button'), {
        type: 'button', className: 'chip', textContent: title, ariaPressed: String(shown.includes(key)),
      })));
      [...chips.children].forEach((chip, i) => { chip.dataset.plot = head.plots[i].key; });
      if (focused) chips.querySelector(`[data-plot="${CSS.escape(focused)}"]`)?.focus();
    }
    for (const key of plots.keys()) if (!shown.includes(key)) plots.delete(key);
    for (const key of shown) if (!plots.has(key)) plots.set(key, new window.armlabTrayPlot(key, asks));
    const boxes = shown.map(key => plots.get(key).box);
    if (boxes.length !== body.children.length || boxes.some((box, i) => box !== body.children[i])) {
      body.replaceChildren(...boxes);
      read(); // what has come already
    }
    const timed = shown.some(key => clipOf(key) !== '');
    tray.querySelector('.tray-hint').textContent = window.armlabSay(timed ? 'Drag: move the arm. Shift + drag, wheel: zoom' : 'Drag, wheel: zoom');
    if (!keys.length) body.textContent = window.armlabSay('There is nothing to plot at present.');
    lay();
    look();
  };

  const lay = () => {
    const count = plots.size;
    if (!tray?.isConnected || !count) return;
    const abreast = Math.max(1, Math.min(count, Math.floor(body.clientWidth / NARROW)));
    const rows = Math.ceil(count / abreast);
    body.style.gridTemplateColumns = `repeat(${Math.ceil(count / rows)}, minmax(0, 1fr))`;
    body.style.gridAutoRows = `max(${LOW}px, calc((100% - ${6 * (rows - 1)}px) / ${rows}))`;
    body.classList.toggle('slim', body.clientWidth / Math.ceil(count / rows) < NARROW);
    for (const plot of plots.values()) plot.draw();
  };

  // Tell the lab what is shown, and how many points the screen has room for.
  const look = () => {
    if (!head || !plots.size || !body.clientWidth) return;
    const wide = Math.max(...[...plots.values()].map(plot => plot.field.clientWidth));
    const points = 300 * Math.ceil(Math.max(wide, 200) * devicePixelRatio * POINTS / 300);
    const text = JSON.stringify({ keys: [...plots.keys()], points });
    if (head.chan + text === last) return;
    last = head.chan + text;
    send('look', text);
  };

  // -- what the lab says ---------------------------------------------------------------------------------------------
  const come = new WeakSet();
  const read = () => {
    for (const mark of document.querySelectorAll('[data-tray-plot]')) {
      const plot = plots.get(mark.dataset.trayPlot);
      if (!plot || come.has(mark) && plot.from === mark) continue;
      come.add(mark);
      plot.from = mark;
      plot.set(JSON.parse(mark.dataset.picture), mark.dataset.numbers);
    }
    const at = JSON.parse(document.querySelector('[data-tray-at]')?.dataset.trayAt ?? '{}');
    for (const [key, plot] of plots) if (clipOf(key) === '') plot.at(at[key] ?? null);
  };
  const follow = () => {
    const text = document.getElementById('al-tray')?.dataset.tray ?? '';
    if (text === '' && head) {
      head = null;
      close();
    }
    if (text === '') {
      headText = '';
      return;
    }
    if (text !== headText) {
      headText = text;
      head = JSON.parse(text);
      const [key, number] = head.asked;
      if (number !== asked || !tray?.isConnected) {
        if (!tray?.isConnected) open();
        asked = number;
        begin(key);
      }
      arrange();
    }
    read();
    const now = clock();
    if (!scrubbed && place === null) {
      for (const [key, plot] of plots) {
        if (clipOf(key) !== '') plot.at(now?.clip === clipOf(key) ? (time ?? now.time) : null);
      }
    }
  };

  // Called by the page's clock with the present time of the timeline.
  window.armlabTray = {
    time: at => {
      time = at;
      if (!plots.size || scrubbed || place !== null) return;
      const clip = clock()?.clip;
      for (const [key, plot] of plots) if (clip && clipOf(key) === clip) plot.at(at);
    },
  };

  // Before the page's own keys.
  addEventListener('keydown', event => {
    if (!head || !tray?.isConnected || event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    if (document.querySelector('.al-dialog, button[data-escape]') || event.target.closest?.('input:not([type=range]), select, textarea, [contenteditable]')) return;
    if (event.key === 'Escape' && full) setFull(false);
    else if (event.key === 'Escape' && !root.hasAttribute('data-projector')) close();
    else if (event.code === 'KeyX') close();
    else return;
    event.preventDefault();
    event.stopImmediatePropagation();
  }, true);

  const watch = () => {
    let due = false;
    new MutationObserver(records => {
      if (due || tray && records.every(({ target }) => tray.contains(target))) return;
      due = true;
      requestAnimationFrame(() => {
        due = false;
        follow();
      });
    }).observe(document.body, { childList: true, subtree: true });
    new MutationObserver(() => { for (const plot of plots.values()) { plot.makeLegend(); plot.draw(); } })
      .observe(root, { attributes: true, attributeFilter: ['data-mantine-color-scheme'] });
    addEventListener('resize', () => { if (tray?.isConnected) setHeight(height); });
  };
  if (document.body) watch();
  else addEventListener('DOMContentLoaded', watch);
})();
