// Shadows are left out for a while where they cost too many pictures: as long as anybody asks for it.
(() => {
  'use strict';

  const without = new Set(); // who does
  const dim = new Set(); // lamps whose shadows are off

  // Called again and again while a picture is to have none: lamps may come.
  window.armlabShadows = (who, on) => {
    const scene = window.__viserMutable?.scene;
    if (!scene) return;
    if (on) without.delete(who);
    else without.add(who);
    if (without.size) {
      scene.traverse(object => {
        if (!object.isLight || !object.castShadow) return;
        object.castShadow = false;
        dim.add(object);
      });
    } else if (dim.size) {
      for (const lamp of dim) lamp.castShadow = true;
      dim.clear();
      window.__viserMutable.requestRender();
    }
  };
})();
