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
  const typed = 'input[data-chan]:not([data-live]):not([type=file]), select[data-chan], textarea[data-chan]';
  document.addEventListener('change', event => {
    if (event.target.matches?.(typed)) send(event.target, event.target.value);
  });

  // Sliders of ours tell where they are while they move, at most twenty times a second, and where they end.
  let live = null;
  let liveTimer = 0;
  const sendLive = () => {
    liveTimer = 0;
    if (live) send(live, live.value);
    live = null;
  };
  document.addEventListener('input', event => {
    if (!event.target.matches?.('input[data-live]')) return;
    live = event.target;
    liveTimer ||= setTimeout(sendLive, 50);
    // Until the lab answers, the thumb stays where the hand has put it.
    if (live.dataset.cell === 'seek' && clock) clock = { ...clock, time: live.value * clock.end, at: performance.now() };
  });

  // Files are read here and arrive as text: the lab takes no uploads. A field may take more bytes with data-most.
  // What becomes too long for a message when it is written as JSON is no text; the lab says so of a zero character.
  const fits = text => new Blob([JSON.stringify(text)]).size < 2e6;
  document.addEventListener('change', event => {
    const file = event.target.matches?.('input[type=file][data-chan]') && event.target.files[0];
    if (!file) return;
    const field = event.target;
    const most = Number(field.dataset.most) || 50000; // one more is sent than the lab takes, so that it says so
    file.slice(0, most + 1).text().then(text => send(field, fits(text) ? text : '\0'));
    field.value = '';
  });

  // <button data-copy=TEXT>: where the page is not served securely there is no clipboard, but there is the old way.
  const copy = async text => {
    if (navigator.clipboard) return navigator.clipboard.writeText(text);
    const area = document.createElement('textarea');
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
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
    if (!(event.ctrlKey || event.metaKey) || event.code !== 'KeyZ' || !field.matches?.('input.field')) return;
    if (field.value !== field.defaultValue) return;
    event.preventDefault();
    document.querySelector(`.al-steps button[data-cell=${event.shiftKey ? 'redo' : 'undo'}]`)?.click();
  });

  // <button data-key=CODE> is pressed by that key when no control has the focus.
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const control = event.target.closest?.('input, select, textarea, button, [role=slider], [role=combobox], [contenteditable]');
    if (control && !control.matches('.al-time input')) return; // the thumb of the timeline needs none of these keys
    const button = document.querySelector(`button[data-key="${CSS.escape(event.code)}"]`);
    if (!button || button.disabled) return;
    event.preventDefault();
    button.click();
  });
  document.addEventListener('keydown', event => {
    if (event.key !== 'Enter' || !event.target.matches?.('input[data-chan]:not([data-live])')) return;
    // In a table Enter goes down the column, as in a spreadsheet; elsewhere it leaves the field.
    const below = event.target.dataset.below;
    const { chan } = event.target.dataset;
    const next = below && document.querySelector(`[data-chan="${chan}"][data-cell="${CSS.escape(below)}"]`);
    event.target.blur();
    last = null;
    if (next) {
      next.focus();
      next.select();
    }
  });
  document.addEventListener('click', event => {
    const button = event.target.closest?.('button[data-chan]');
    if (!button || button.disabled) return;
    send(button, '');
    if (event.detail) { // clicked by hand and done with: the space bar plays, and does not press it again
      button.blur();
      last = null;
    }
  });

  // <div data-chan=ID data-cell=NAME data-pick>: where it is clicked, as parts of its box from the upper left corner.
  document.addEventListener('click', event => {
    const picked = event.target.closest?.('[data-pick]');
    if (!picked) return;
    const box = picked.getBoundingClientRect();
    send(picked, `${(event.clientX - box.left) / box.width},${(event.clientY - box.top) / box.height}`);
  });

  // A field that is left is sent, and its answer may replace the button that is being pressed: the press counts.
  let down = null;
  document.addEventListener('pointerdown', event => { down = event.target.closest?.('button[data-chan]'); }, true);
  document.addEventListener('pointerup', event => {
    const button = event.target.closest?.('button[data-chan]');
    const same = down && !down.isConnected && button?.dataset.chan === down.dataset.chan && button.dataset.cell === down.dataset.cell;
    down = null;
    if (same) button.click();
  }, true);

  // What was opened and how far was read stays when a value in the text changes, as long as it is the same step.
  const opened = new Map();
  const met = new WeakSet();
  const nameOf = details => details.querySelector('summary')?.textContent;
  let read = { title: '', top: 0 };
  let text = null;
  document.addEventListener('toggle', event => {
    if (event.target.isConnected && event.target.matches('.al details')) opened.set(nameOf(event.target), event.target.open);
  }, true);
  document.addEventListener('scroll', event => {
    if (event.target === text) read.top = text.scrollTop;
  }, true);
  const keepReading = () => {
    for (const details of document.querySelectorAll('.al details')) {
      if (met.has(details)) continue;
      met.add(details);
      if (opened.get(nameOf(details))) details.open = true;
    }
    const found = document.querySelector('.lesson-text');
    if (!found || found === text) return;
    text = found;
    const title = document.querySelector('.lesson-head select')?.value + text.querySelector('h2')?.textContent;
    if (title === read.title) text.scrollTop = read.top;
    else {
      read = { title, top: 0 };
      opened.clear();
      const dock = text.closest('.mantine-ScrollArea-viewport'); // in a small window all of it scrolls
      if (dock) dock.scrollTop = 0;
    }
  };

  // The lab replaces the markup around a field; the cursor goes on in the field of the same name.
  document.addEventListener('focusin', event => {
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
    if (!event.target.closest?.('[data-chan]')) last = null;
  }, true);
  const keepFocus = () => {
    if (!last || last.isConnected || document.activeElement !== document.body) return;
    const { chan, cell } = last.dataset;
    const same = document.querySelector(`[data-chan="${chan}"][data-cell="${CSS.escape(cell)}"]`);
    // What was typed before the new markup came is not lost.
    const unsent = last.matches('input.field') && last.value !== last.defaultValue ? last.value : null;
    last = same;
    same?.focus({ preventScroll: true });
    if (unsent !== null && same) {
      same.value = unsent;
      same.dataset.unsent = '1'; // a value set here is no change to the page: it has to be sent when it is left
    } else if (same?.select) same.select();
  };

  // Projector mode: large text, no benches, and the keys of a clicker go through the lesson. It is the page's own
  // affair: the teacher's other screen stays as it is.
  const steps = { PageDown: 'lesson-next', PageUp: 'lesson-back' };
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    if (event.target.closest?.('input, select, textarea, [contenteditable]')) return;
    const root = document.documentElement;
    if (event.code === 'KeyV') {
      root.toggleAttribute('data-projector');
      dispatchEvent(new Event('resize')); // viser fits the picture to what is left
    } else if (event.code === 'Escape' && root.hasAttribute('data-projector')) {
      root.removeAttribute('data-projector');
      dispatchEvent(new Event('resize'));
    } else if (steps[event.code]) {
      const button = document.querySelector(`.lesson-foot button[data-cell=${steps[event.code]}]`);
      if (!button) return;
      event.preventDefault();
      button.click();
    }
  });

  // Keys that move the camera must not do so while a slider, a tab or a list has the focus.
  const cameraKeys = new Set(['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight']);
  document.addEventListener('keydown', event => {
    const inPanel = event.target.closest?.('[role=slider],[role=tab],[role=listbox],[role=combobox],button,input,select');
    if (inPanel && cameraKeys.has(event.code)) event.stopImmediatePropagation();
  });

  // Files the lab would refuse anyway are not sent: viser has no limit of its own.
  document.addEventListener('change', event => {
    const file = event.target.files?.[0];
    if (file && file.size > 5e6 && !event.target.dataset.chan) {
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
    for (const tab of document.querySelectorAll('[role=tab][title]')) {
      tab.toggleAttribute('data-off', notes.hidden.includes(tab.title));
    }
    if (notes.asked !== asked) {
      const tab = [...document.querySelectorAll('[role=tab]')].find(t => t.title === notes.tab);
      if (tab) {
        asked = notes.asked;
        // A tab answers to the keyboard and to a whole press, not to a bare click.
        tab.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
      }
    }
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
    if (!element) return;
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

  // While a clip plays on a machine that draws too few pictures, they are made simpler, step by step; at rest they are
  // whole again. How many are too few is counted here, so that no setting of the lab changes.
  const simpler = (() => {
    const STEPS = [[1, false], [1, true], [0.75, true], [0.5, true]]; // part of the screen's pixels each way; rough bodies or not
    const LAST = STEPS.length - 1;
    const ENOUGH = 50, PERIOD = 500; // pictures a second, and the ms over which they are counted
    const GAIN = 1.15; // what all steps must bring; if not, the screen shows no more, and pictures stay whole
    let playing = false, step = 0, useful = true, whole = 0, easy = true;
    let began = 0, count = 0, settling = true; // of the present period, which does not count while things change
    let rest = 0, ours = 0; // pixel ratio at rest, and the one set here
    const dim = new Set(); // lamps whose shadows are off
    const indices = new WeakMap(); // of a geometry: the whole index and the rough one

    const show = rough => {
      const scene = window.__viserMutable?.scene;
      const state = scene?.__r3f?.root?.getState();
      if (!state?.viewport || !state.setDpr) return true;
      if (state.viewport.dpr !== ours) rest = state.viewport.dpr; // set by viser
      ours = playing ? Math.min(rest, STEPS[step][0] * devicePixelRatio) : rest;
      if (state.viewport.dpr !== ours) state.setDpr(ours);
      const patience = performance.now() + 30; // ms: bodies are made rough over several pictures
      let done = true;
      scene.traverse(object => {
        if (rough && object.isLight && object.castShadow) {
          object.castShadow = false;
          dim.add(object);
        }
        const geometry = object.isMesh && object.material?.isMeshStandardMaterial && object.geometry;
        if (!geometry || !geometry.index || !geometry.attributes.normal) return;
        if (rough && !indices.has(geometry)) {
          if (performance.now() < patience) indices.set(geometry, [geometry.index, fewer(geometry)]);
          else done = false;
        }
        const index = indices.get(geometry)?.[Number(rough)];
        if (index && geometry.index !== index) geometry.setIndex(index);
      });
      if (!rough) {
        for (const lamp of dim) lamp.castShadow = true;
        dim.clear();
      }
      return done;
    };

    const tick = now => {
      if (!playing) return;
      requestAnimationFrame(tick);
      count += 1;
      if (!show(STEPS[step][1])) settling = true;
      began ||= now;
      const spent = now - began;
      if (spent < PERIOD) return;
      if (!settling && spent < 4 * PERIOD) judge((1000 * count) / spent);
      else settling = false;
      began = now;
      count = 0;
    };

    const judge = rate => {
      if (rate < ENOUGH) easy = false;
      if (!useful || rate >= ENOUGH) return;
      if (step === LAST) {
        if (rate >= GAIN * whole) return;
        useful = false;
        step = 0;
      } else {
        if (step === 0) whole = rate;
        step = Math.min(LAST, step + (rate < ENOUGH / 4 ? 3 : rate < ENOUGH / 2 ? 2 : 1));
      }
      settling = true; // shaders are made for it
    };

    return on => {
      if (on === playing) return;
      playing = on;
      if (!on) {
        show(false);
        window.__viserMutable?.requestRender();
        return;
      }
      if (easy && step > 0) step -= 1; // the machine has more time than it had
      easy = settling = true;
      began = count = 0;
      requestAnimationFrame(tick);
    };
  })();

  // The index of a body with fewer triangles on the same vertices: edges are collapsed where the surface bends least
  // (Garland and Heckbert 1997, without new vertices). A corner takes the normal nearest to its own, so creases stay.
  const fewer = geometry => {
    const LEFT = 0.28, LEAST = 150; // part of the triangles that is left; a body with fewer stays as it is
    const { index, attributes: { position, normal } } = geometry;
    const at = position.array, n = normal.array;
    if (index.count < 3 * LEAST || at?.length !== 3 * position.count || n?.length !== at.length) return index;
    const names = new Map(), place = [], corners = []; // vertices in one place are one point with several corners
    const of = new Int32Array(at.length / 3);
    for (let i = 0; i < of.length; i++) {
      const name = `${at[3 * i]},${at[3 * i + 1]},${at[3 * i + 2]}`;
      const point = names.get(name) ?? place.length;
      if (point === place.length) {
        names.set(name, point);
        place.push(3 * i);
        corners.push([]);
      }
      corners[point].push(i);
      of[i] = point;
    }
    const normalOf = (a, b, c) => {
      const x = at[b] - at[a], y = at[b + 1] - at[a + 1], z = at[b + 2] - at[a + 2];
      const u = at[c] - at[a], v = at[c + 1] - at[a + 1], w = at[c + 2] - at[a + 2];
      return [y * w - z * v, z * u - x * w, x * v - y * u];
    };
    const bends = new Float64Array(10 * place.length); // of a point: the sum of squared distances from its planes
    let faces = Array.from(index.array);
    for (let f = 0; f < faces.length; f += 3) {
      const a = place[of[faces[f]]];
      const m = normalOf(a, place[of[faces[f + 1]]], place[of[faces[f + 2]]]);
      const area = Math.hypot(...m) || 1;
      const plane = [m[0], m[1], m[2], -(m[0] * at[a] + m[1] * at[a + 1] + m[2] * at[a + 2])];
      for (let k = f; k < f + 3; k++) {
        let q = 10 * of[faces[k]];
        for (let i = 0; i < 4; i++) for (let j = i; j < 4; j++) bends[q++] += plane[i] * plane[j] / area;
      }
    }
    const cost = (from, to) => {
      const q = 10 * from, x = at[place[to]], y = at[place[to] + 1], z = at[place[to] + 2];
      return x * (bends[q] * x + 2 * (bends[q + 1] * y + bends[q + 2] * z + bends[q + 3])) + y * (bends[q + 4] * y
        + 2 * (bends[q + 5] * z + bends[q + 6])) + z * (bends[q + 7] * z + 2 * bends[q + 8]) + bends[q + 9];
    };
    const turns = (ring, from, to) => ring.some(f => { // whether a triangle would turn by more than 60 degrees
      const p = [of[faces[f]], of[faces[f + 1]], of[faces[f + 2]]];
      if (p.includes(to)) return false;
      const was = normalOf(...p.map(i => place[i])), is = normalOf(...p.map(i => place[i === from ? to : i]));
      return was[0] * is[0] + was[1] * is[1] + was[2] * is[2] < 0.5 * Math.hypot(...was) * Math.hypot(...is);
    });
    const nearest = (i, to) => {
      const like = k => n[3 * i] * n[3 * k] + n[3 * i + 1] * n[3 * k + 1] + n[3 * i + 2] * n[3 * k + 2];
      return corners[to].reduce((best, k) => (like(k) > like(best) ? k : best));
    };
    const wanted = LEFT * faces.length;
    for (let pass = 0; pass < 20 && faces.length > wanted; pass++) {
      const rings = place.map(() => []), best = new Int32Array(place.length).fill(-1);
      const least = new Float64Array(place.length).fill(Infinity);
      for (let i = 0; i < faces.length; i++) {
        const from = of[faces[i]], to = of[faces[i % 3 === 2 ? i - 2 : i + 1]], price = cost(from, to);
        rings[from].push(i - i % 3);
        if (price < least[from]) [least[from], best[from]] = [price, to];
      }
      const queue = [...best.keys()].filter(point => best[point] >= 0).sort((a, b) => least[a] - least[b]);
      const held = new Uint8Array(place.length), moved = new Map();
      for (const from of queue) {
        if (faces.length - 6 * moved.size <= wanted) break;
        const ring = rings[from], round = ring.flatMap(f => [of[faces[f]], of[faces[f + 1]], of[faces[f + 2]]]);
        if (round.some(point => held[point]) || turns(ring, from, best[from])) continue;
        for (const point of round) held[point] = 1;
        moved.set(from, best[from]);
        for (let k = 0; k < 10; k++) bends[10 * best[from] + k] += bends[10 * from + k];
      }
      if (!moved.size) break;
      const left = [];
      for (let f = 0; f < faces.length; f += 3) {
        const [a, b, c] = faces.slice(f, f + 3).map(i => (moved.has(of[i]) ? nearest(i, moved.get(of[i])) : i));
        if (of[a] !== of[b] && of[b] !== of[c] && of[c] !== of[a]) left.push(a, b, c);
      }
      faces = left;
    }
    return new index.constructor(index.array.constructor.from(faces), 1);
  };

  // The timeline: between two marks of the lab its thumb and the cursors of plots follow the page's own clock.
  let clock = null;
  let clockText = '';
  const readClock = () => {
    const text = document.getElementById('al-clock')?.dataset.clock ?? '';
    if (text !== clockText) {
      clockText = text;
      clock = text ? { ...JSON.parse(text), at: performance.now() } : null;
      if (clock) requestAnimationFrame(showClock);
      simpler(clock !== null && clock.rate > 0);
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
    if (label && label.textContent !== text) label.textContent = text;
    placeCursors(part);
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

  // The free part of the window between the docks, for what lies over the scene.
  const measure = () => {
    const canvas = document.querySelector('canvas');
    if (!canvas) return;
    const box = canvas.getBoundingClientRect();
    const found = [box.left, innerWidth - box.right, box.width, (box.left + box.right) / 2].map(x => `${x}px`);
    if (found.join() === measured) return; // setting one, even to what it is, has the whole page styled anew
    measured = found.join();
    ['left', 'right', 'wide', 'mid'].forEach((name, i) => document.documentElement.style.setProperty(`--al-${name}`, found[i]));
  };
  let measured = '';

  const watch = () => {
    let due = false;
    new MutationObserver(() => {
      keepFocus(); // at once: in the next frame the person may have gone on to another field already
      if (due) return;
      due = true;
      requestAnimationFrame(() => {
        due = false;
        keepReading();
        obey();
        toTop();
        tellTabs();
        readClock();
        placeCursors(clock && clock.end > 0 ? clock.time / clock.end : NaN);
        measure();
      });
    }).observe(document.body, { childList: true, subtree: true, attributes: true, attributeFilter: ['data-notes', 'data-clock', 'data-cursor', 'style'] });
    addEventListener('resize', measure);
  };
  if (document.body) watch();
  else addEventListener('DOMContentLoaded', watch);
})();
