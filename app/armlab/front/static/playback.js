// While a clip plays on a machine that draws too few pictures, they are made simpler, step by step: without shadows, then
// with fewer pixels. At rest they are whole again. How many are too few is counted here, so that no setting of the lab
// changes.
(() => {
  'use strict';

  const STEPS = [1, 0.75, 0.5]; // part of the screen's pixels each way; all of them without shadows
  const LAST = STEPS.length - 1;
  const ENOUGH = 50, PERIOD = 500; // pictures a second, and the ms over which they are counted
  const GAIN = 1.15; // what all steps must bring; if not, the screen shows no more, and pictures stay whole
  let playing = false, useful = true, whole = 0, easy = true;
  let step = -1; // -1: the whole picture
  let began = 0, count = 0, settling = true; // of the present period, which does not count while things change
  let rest = 0, ours = 0; // pixel ratio at rest, and the one set here

  const show = simple => {
    const scene = window.__viserMutable?.scene;
    const state = scene?.__r3f?.root?.getState();
    if (!state?.viewport || !state.setDpr) return;
    if (state.viewport.dpr !== ours) rest = state.viewport.dpr; // set by viser
    ours = simple ? Math.min(rest, STEPS[step] * devicePixelRatio) : rest;
    if (state.viewport.dpr !== ours) state.setDpr(ours);
    window.armlabShadows('playback', !simple);
  };

  const judge = rate => {
    if (rate < ENOUGH) easy = false;
    if (!useful || rate >= ENOUGH) return;
    if (step === LAST) {
      if (rate >= GAIN * whole) return;
      useful = false;
      step = -1;
    } else {
      if (step === -1) whole = rate;
      step = Math.min(LAST, step + (rate < ENOUGH / 3 ? 2 : 1));
    }
    settling = true; // shaders are made for it
  };

  const tick = now => {
    if (!playing) return;
    requestAnimationFrame(tick);
    count += 1;
    show(step >= 0);
    began ||= now;
    const spent = now - began;
    if (spent < PERIOD) return;
    if (settling) settling = false;
    else judge((1000 * count) / spent);
    began = now;
    count = 0;
  };

  // While another page covers this one no pictures are drawn, which says nothing of the machine.
  document.addEventListener('visibilitychange', () => {
    settling = true;
    began = count = 0;
  });

  // Called with whether a clip plays.
  window.armlabPlaying = on => {
    if (on === playing) return;
    playing = on;
    if (!on) {
      show(false);
      window.__viserMutable?.requestRender();
      return;
    }
    if (easy && step >= 0) step -= 1; // the machine has more time than it had
    easy = settling = true;
    began = count = 0;
    requestAnimationFrame(tick);
  };
})();
