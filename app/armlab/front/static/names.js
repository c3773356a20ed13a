// Names of viser's own controls for who does not see them: its sliders have an empty one, and the fields beside them
// none. Both are called what the label of their line says.
(() => {
  'use strict';
  const call = (control, name) => {
    if (control && name && control.getAttribute('aria-label') !== name) control.setAttribute('aria-label', name);
  };
  const name = () => {
    for (const thumb of document.querySelectorAll('.mantine-Slider-thumb')) {
      const slider = thumb.closest('.mantine-Slider-root');
      const label = document.querySelector(`label[for="${CSS.escape(slider.id)}"]`)?.textContent.trim();
      call(thumb, label);
      call(slider.parentElement.querySelector('.mantine-NumberInput-input'), label);
    }
  };
  window.armlabWatch(window.armlabInFrame(name), { characterData: true });
})();
