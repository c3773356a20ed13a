// The tour: <section class="al-tour" data-at=WHAT> is put beside what it tells of, with a ring around that, and follows it.
(() => {
  'use strict';

  const LOOK = 200; // ms between two looks whether there is a tour
  const GAP = 18; // px between the ring and the card
  const AROUND = 8; // px of the ring around what it shows
  const HANDLE = 46; // px from the middle of the handle to the ring

  const shown = element => element?.getClientRects().length ? element.getBoundingClientRect() : null;
  const union = boxes => boxes.length && new DOMRect(
    Math.min(...boxes.map(b => b.left)), Math.min(...boxes.map(b => b.top)),
    Math.max(...boxes.map(b => b.right)) - Math.min(...boxes.map(b => b.left)),
    Math.max(...boxes.map(b => b.bottom)) - Math.min(...boxes.map(b => b.top)),
  );

  const handle = () => {
    const scene = window.__viserMutable;
    const node = scene?.nodeRefFromName['/target'];
    if (!node?.parent || !scene.camera || !scene.canvas) return null;
    const at = node.getWorldPosition(node.position.clone()).project(scene.camera);
    const box = scene.canvas.getBoundingClientRect();
    const [x, y] = [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height];
    return new DOMRect(x - HANDLE, y - HANDLE, 2 * HANDLE, 2 * HANDLE);
  };
  // Of what is out of sight, as on a phone whose panels are drawn in, the tab is shown, or all that is left of the tabs.
  const seen = box => box && box.right > 0 && box.bottom > 0 && box.left < innerWidth && box.top < innerHeight ? box : null;
  const tab = card => {
    const named = each => [each.title, each.getAttribute('aria-label'), each.textContent].some(t => t?.trim() === card.dataset.title);
    const found = [...document.querySelectorAll('[role=tab]')].find(named);
    return seen(shown(found)) ?? seen(shown(document.querySelector('[role=button][aria-expanded][aria-label^="Expand panel"]')));
  };
  const sliders = card => {
    const boxes = [...document.querySelectorAll('.mantine-Slider-root')].map(shown).filter(seen);
    return union(boxes) || tab(card);
  };
  const arm = () => shown(document.querySelector('.al-top .arm-name'));
  const places = { handle, sliders, arm, lessons: tab };

  const ring = document.createElement('div');
  ring.className = 'al-ring';
  ring.setAttribute('aria-hidden', 'true');

  // The card stands on the first side where it has room, and never over what it shows.
  const beside = (box, card) => {
    const [w, h] = [card.offsetWidth, card.offsetHeight];
    const [right, below] = [innerWidth - w - GAP, innerHeight - h - GAP];
    const clamp = (value, most) => Math.max(GAP, Math.min(value, most));
    const sides = [
      [box.left - w - GAP, clamp(box.top + box.height / 2 - h / 2, below), box.left - w - GAP >= GAP],
      [box.right + GAP, clamp(box.top + box.height / 2 - h / 2, below), box.right + GAP <= right],
      [clamp(box.left, right), box.bottom + GAP, box.bottom + GAP <= below],
      [clamp(box.left, right), box.top - h - GAP, box.top - h - GAP >= GAP],
    ];
    return sides.find(side => side[2]) ?? [clamp((innerWidth - w) / 2, right), below];
  };

  // Who goes with the keyboard goes on with it: the focus comes along to each stop, and back to where the tour began.
  let keys = false;
  let from = '';
  let stop = '';
  addEventListener('keydown', () => { keys = true; }, true);
  addEventListener('pointerdown', () => { keys = false; }, true);
  addEventListener('click', event => {
    from = event.target.closest?.('[data-cell$="-tour"]')?.dataset.cell ?? from;
  }, true);
  const goOn = (...places) => {
    if (!keys || document.activeElement !== document.body) return;
    places.flatMap(each => [...document.querySelectorAll(each)]).find(shown)?.focus({ preventScroll: true });
  };

  let running = false;
  let written = '';
  const place = () => {
    const card = document.querySelector('.al-tour');
    if (!card) {
      running = false;
      stop = '';
      ring.remove();
      goOn(`[data-cell="${from}"]`, '.al-top .arm-name');
      return;
    }
    requestAnimationFrame(place);
    if (card.dataset.at !== stop) {
      stop = card.dataset.at;
      goOn('.al-tour [data-cell=tour-on]');
    }
    const box = places[card.dataset.at]?.(card);
    const [x, y] = box ? beside(box, card) : [(innerWidth - card.offsetWidth) / 2, innerHeight - card.offsetHeight - 80];
    const text = [x, y, box && [box.left, box.top, box.width, box.height]].join();
    if (text === written && card.style.left && ring.isConnected === Boolean(box)) return;
    written = text;
    Object.assign(card.style, { left: `${x}px`, top: `${y}px` });
    if (!box) {
      ring.remove();
      return;
    }
    Object.assign(ring.style, {
      left: `${box.left - AROUND}px`, top: `${box.top - AROUND}px`,
      width: `${box.width + 2 * AROUND}px`, height: `${box.height + 2 * AROUND}px`,
      borderRadius: card.dataset.at === 'handle' ? '50%' : '10px',
    });
    if (!ring.isConnected) document.body.append(ring);
  };
  const look = () => {
    if (running || !document.querySelector('.al-tour')) return;
    running = true;
    place();
  };
  setInterval(look, LOOK);

  addEventListener('keydown', event => {
    if (event.key !== 'Escape' || document.querySelector('.al-dialog') || document.documentElement.hasAttribute('data-projector')) return;
    document.querySelector('.al-tour [data-cell=welcome-leave]')?.click();
  }, true); // before the projector ends by the same key
})();
