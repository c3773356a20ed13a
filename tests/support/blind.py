"""Pages that paint no scene: what a software renderer would do is most of the work of a page."""

from __future__ import annotations

BLIND = """(() => {
  const kind = WebGL2RenderingContext.prototype, open = HTMLCanvasElement.prototype.getContext, made = new WeakMap();
  const none = {}, names = { UNMASKED_VENDOR_WEBGL: 0x9245, UNMASKED_RENDERER_WEBGL: 0x9246 };
  const lose = { loseContext() {}, restoreContext() {} };
  const extensions = { WEBGL_debug_renderer_info: names, WEBGL_lose_context: lose };
  const known = {
    [kind.VERSION]: 'WebGL 2.0', [kind.SHADING_LANGUAGE_VERSION]: 'WebGL GLSL ES 3.00',
    [kind.SCISSOR_BOX]: new Int32Array(4), [kind.VIEWPORT]: new Int32Array(4),
    [names.UNMASKED_VENDOR_WEBGL]: 'nobody', [names.UNMASKED_RENDERER_WEBGL]: 'software that paints nothing',
  };
  const empty = [kind.ACTIVE_UNIFORMS, kind.ACTIVE_ATTRIBUTES];
  const answers = {
    getContextAttributes() { return made.get(this.canvas).attributes; },
    isContextLost: () => false,
    getSupportedExtensions: () => Object.keys(extensions),
    getExtension: name => extensions[name] ?? (/float/.test(name) ? none : null),
    getParameter: key => known[key] ?? 4096,
    getError: () => kind.NO_ERROR,
    checkFramebufferStatus: () => kind.FRAMEBUFFER_COMPLETE,
    getShaderPrecisionFormat: () => ({ rangeMin: 127, rangeMax: 127, precision: 23 }),
    getShaderParameter: () => true,
    getProgramParameter: (_, key) => (empty.includes(key) ? 0 : true),
    getShaderInfoLog: () => '',
    getProgramInfoLog: () => '',
    clientWaitSync: () => kind.ALREADY_SIGNALED,
    getSyncParameter: () => kind.SIGNALED,
  };
  for (const [name, { value }] of Object.entries(Object.getOwnPropertyDescriptors(kind))) {
    if (typeof value !== 'function' || name === 'constructor') continue;
    kind[name] = answers[name] ?? (/^(create|fence)/.test(name) ? () => ({}) : () => {});
  }
  const context = canvas => Object.create(kind, {
    canvas: { value: canvas },
    drawingBufferWidth: { get: () => canvas.width },
    drawingBufferHeight: { get: () => canvas.height },
    ...Object.fromEntries(['drawingBufferColorSpace', 'unpackColorSpace'].map(
      name => [name, { value: 'srgb', writable: true }])),
  });
  HTMLCanvasElement.prototype.getContext = function (name, wishes) {
    if (name !== 'webgl2') return open.call(this, name, wishes);
    if (!made.has(this)) made.set(this, { context: context(this), attributes: { antialias: true, ...wishes } });
    return made.get(this).context;
  };
})()"""
"""Lets a page do everything but paint its scene: its graphics card takes every order and does nothing.

What is in the scene, where, and what lies under the pointer does not depend on it.
"""
