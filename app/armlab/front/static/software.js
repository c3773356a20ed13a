// A machine without a graphics card draws every picture by program. Smooth edges cost such a machine a fifth of its
// pictures, so it does without them, and without shadows while a hand drags; all others keep both.
(() => {
  'use strict';

  const BY_PROGRAM = /swiftshader|llvmpipe|softpipe|software|basic render/i;
  const open = HTMLCanvasElement.prototype.getContext;

  const drawnByProgram = () => {
    const trial = open.call(document.createElement('canvas'), 'webgl2');
    const names = trial?.getExtension('WEBGL_debug_renderer_info');
    const name = names ? String(trial.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
    trial?.getExtension('WEBGL_lose_context')?.loseContext();
    return BY_PROGRAM.test(name);
  };

  HTMLCanvasElement.prototype.getContext = function (kind, wishes) {
    if (kind !== 'webgl2' || !wishes?.antialias || !drawnByProgram()) return open.call(this, kind, wishes);
    window.armlabSlowDragging();
    return open.call(this, kind, { ...wishes, antialias: false });
  };
})();
