// Jogging: <div data-jogs=COUNT data-chan=ID data-cell=NAME> with <button data-jog="COORDINATE,±1"> in it. A press is one
// step; held it goes on, and ends with the release. So with keys, and with the sticks of a gamepad, as far as they are
// pushed. What is sent is the number of the jog and a part of a step for each coordinate.
(() => {
  'use strict';

  const HOLD = 400; // ms until a button that is held goes on
  const EVERY = 100; // ms between steps
  const typing = 'input:not([type=range]), select, textarea, [role=combobox], [contenteditable]';
  const place = () => [...document.querySelectorAll('[data-jogs]')].find(each => each.getClientRects().length);
  const signOf = text => (text.startsWith('+') ? 1 : -1);

  let number = 0;
  const another = () => { number = Math.max(number + 1, Date.now()); };
  // Send a step; return whether there is a way on.
  const step = parts => {
    const at = place();
    if (!at || parts.length !== Number(at.dataset.jogs) || at.dataset.ended === String(number)) return false;
    window.armlabSend(at, `${number}:${parts.map(part => Math.round(part * 1e3) / 1e3).join()}`);
    return true;
  };

  // -- a button or a key that is held ---------------------------------------------------------------------------
  let held = ''; // data-jog of what is held
  let timer = 0, repeating = 0;
  const buttonOf = name => place()?.querySelector(`[data-jog="${CSS.escape(name)}"]`);
  const end = () => {
    held = '';
    clearTimeout(timer);
    clearInterval(repeating);
  };
  const once = () => {
    const button = buttonOf(held);
    if (!button || button.disabled) return false;
    const parts = new Array(Number(place().dataset.jogs)).fill(0);
    const [coordinate, sign] = held.split(',');
    parts[Number(coordinate)] = signOf(sign);
    return step(parts);
  };
  const begin = name => {
    end();
    held = name;
    another();
    if (!once()) { end(); return; }
    timer = setTimeout(() => { repeating = setInterval(() => { if (!once()) end(); }, EVERY); }, HOLD);
  };

  const under = event => document.elementFromPoint(event.clientX, event.clientY)?.closest('[data-jog]')?.dataset.jog;
  document.addEventListener('pointerdown', event => {
    const button = event.button === 0 && event.isPrimary && event.target.closest?.('button[data-jog]');
    if (!button || button.disabled) return;
    begin(button.dataset.jog);
  });
  addEventListener('pointermove', event => { if (held && !key && under(event) !== held) end(); }, true);
  for (const name of ['pointerup', 'pointercancel']) addEventListener(name, () => { if (!key) end(); }, true);
  addEventListener('blur', () => { key = ''; end(); });
  document.addEventListener('visibilitychange', () => { key = ''; end(); });
  document.addEventListener('contextmenu', event => { if (event.target.closest?.('[data-jog]')) event.preventDefault(); });
  let clicked = 0;
  // The press has been heard; only one by the keyboard, which has no pointer, is a step here.
  document.addEventListener('click', event => {
    const button = event.target.closest?.('button[data-jog]');
    if (!button) return;
    event.stopImmediatePropagation();
    if (event.detail) button.blur();
    else if (performance.now() - clicked > EVERY) {
      clicked = performance.now();
      begin(button.dataset.jog);
      end();
    }
  }, true);

  let key = '';
  document.addEventListener('keydown', event => {
    const digit = /^Digit([1-9])$/.exec(event.code);
    if (!digit || event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.(typing)) return;
    const name = `${digit[1] - 1},${event.shiftKey ? '−' : '+'}1`;
    if (!buttonOf(name)) return;
    event.preventDefault();
    if (event.repeat || key === event.code) return;
    begin(name);
    key = event.code;
  });
  document.addEventListener('keyup', event => {
    if (event.code !== key) return;
    key = '';
    end();
  });

  // -- a gamepad ------------------------------------------------------------------------------------------------
  const DEAD = 0.15; // part of a stick's way that counts as none
  const NEXT = 0, BEFORE = 4, AFTER = 5, UP = 12, DOWN = 13, LEFT = 14, RIGHT = 15; // buttons, as browsers number them
  const live = value => (Math.abs(value) < DEAD ? 0 : (Math.sign(value) * Math.min(Math.abs(value) - DEAD, 1 - DEAD)) / (1 - DEAD));
  let polling = 0, joint = 0, down = [], moving = '', stopped = '';

  const pads = () => [...(navigator.getGamepads?.() ?? [])].filter(each => each?.connected);
  const pushed = (pad, count, joints) => {
    const [x, y, turn, z] = [0, 1, 2, 3].map(k => live(pad.axes[k] ?? 0));
    const on = k => (pad.buttons[k]?.pressed ? 1 : 0);
    const parts = new Array(count).fill(0);
    if (joints) parts[joint] = x;
    else [x, -y, -z, on(RIGHT) - on(LEFT), on(UP) - on(DOWN), -turn].forEach((part, k) => { parts[k] = part; });
    return parts;
  };
  const press = pad => {
    const now = pad.buttons.map(button => button.pressed);
    const went = k => now[k] && !down[k];
    if (went(NEXT)) {
      const modes = [...document.querySelectorAll('button[data-jog-mode]')].filter(each => each.getClientRects().length);
      const at = modes.findIndex(each => each.getAttribute('aria-pressed') === 'true');
      modes[(at + 1) % modes.length]?.click();
    }
    if (went(BEFORE)) joint -= 1;
    if (went(AFTER)) joint += 1;
    down = now;
  };
  const look = () => {
    const [pad] = pads();
    if (!pad) { clearInterval(polling); polling = 0; }
    if (!pad || document.hidden) { moving = ''; return; }
    press(pad);
    const at = place();
    if (!at) return;
    const count = Number(at.dataset.jogs);
    const joints = at.matches('.joints');
    joint = ((joint % count) + count) % count;
    [...at.children].forEach((each, k) => each.toggleAttribute('data-pad', joints && k === joint));
    const parts = pushed(pad, count, joints);
    const way = parts.some(part => part) ? parts.map(Math.sign).join() : '';
    if (!way) stopped = '';
    if (way && !moving) another();
    moving = way;
    if (!way || way === stopped) return;
    if (stopped) { stopped = ''; another(); } // pushed another way than the one on which it could not go on
    if (!step(parts)) stopped = way;
  };
  const poll = () => { polling ||= setInterval(look, EVERY); };
  addEventListener('gamepadconnected', poll);
  if (pads().length) poll();
})();
