// Axes of the plots in the tray: places of values, round numbers, and colours that can be told from the ground.
(() => {
  'use strict';

  const escape = text => String(text).replace(/[&<>"]/g, sign => `&#${sign.charCodeAt(0)};`);

  // Round values inside a range, at least `apart` pixels from each other on `size` pixels.
  const ticks = ([low, high], size, apart) => {
    const rough = (high - low) / Math.max(2, Math.floor(size / apart));
    if (!(rough > 0 && Number.isFinite(rough))) return { values: [], step: 1 };
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 2.5, 5, 10, 20].map(each => each * power).find(each => each >= rough * (1 - 1e-9));
    const values = [];
    if (Math.max(-low, high) / step > 2 ** 52) return { values, step }; // such numbers cannot be counted one by one
    for (let k = Math.ceil(low / step - 1e-9); k <= Math.floor(high / step + 1e-9); k++) values.push(k * step);
    return { values, step };
  };
  const powers = ([low, high], size, apart) => {
    const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    const each = Math.max(1, Math.ceil((last - first + 1) / Math.max(2, Math.floor(size / apart))));
    const values = [];
    for (let k = first; k <= last; k += each) values.push(10 ** k);
    return values;
  };

  // A number with the decimals that a step needs; what is very large or small with a power of ten.
  const text = (value, step) => {
    if (Math.abs(value) < step * 1e-6) return '0';
    const size = Math.max(Math.abs(value), step);
    if (size >= 1e6 || step < 1e-5) return value.toExponential(Math.max(0, Math.min(4, Math.round(Math.log10(size / step)))))
      .replace('e+', 'e').replaceAll('-', '−');
    const decimals = Math.max(0, Math.min(8, -Math.floor(Math.log10(step) + 1e-9)));
    const more = decimals < 8 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 ? 1 : 0;
    return value.toFixed(decimals + more).replace(/^-(?=[0.]*$)/, '').replace('-', '−');
  };

  // A value under the cursor: four digits of what is seen.
  const read = (value, [low, high]) => text(value, 10 ** (Math.floor(Math.log10(Math.max(high - low, 1e-12))) - 3));

  // Colours of the palette are made darker on a light ground, lighter on a dark one, until they stand out as 3 to 1.
  const light = rgb => rgb.map(c => (c <= 10.31475 ? c / 3294.6 : ((c / 255 + 0.055) / 1.055) ** 2.4))
    .reduce((sum, part, i) => sum + [0.2126, 0.7152, 0.0722][i] * part, 0);
  const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
  const legible = (rgb, ground) => {
    const towards = light(ground) > 0.4 ? 0 : 255;
    let found = rgb;
    for (let k = 1; k <= 12 && contrast(found, ground) < 3; k++) {
      found = rgb.map(part => Math.round(part + (towards - part) * k * 0.06));
    }
    return `rgb(${found})`;
  };

  // The colours of the page now, which a saved picture keeps.
  const looks = () => {
    const style = getComputedStyle(document.documentElement);
    const of = name => style.getPropertyValue(`--al-${name}`).trim();
    const dark = document.documentElement.dataset.mantineColorScheme === 'dark';
    const ground = dark ? [28, 34, 43] : [255, 255, 255];
    return { ink: of('ink'), dim: of('dim'), line: of('line'), panel: of('panel'), time: of('no'), brand: of('brand'), ground };
  };

  const axis = (range, from, to, log) => {
    const [low, high] = log ? range.map(Math.log) : range;
    const scale = (to - from) / (high - low || 1);
    return {
      range, log,
      at: value => from + ((log ? Math.log(value) : value) - low) * scale,
      value: pixel => (log ? Math.exp : Number)(low + (pixel - from) / scale),
      marks: apart => {
        const size = Math.abs(to - from);
        if (log && high - low > Math.LN10) return powers(range, size, apart).map(value => [value, value >= 1e4 || value < 1e-3
          ? `1e${Math.round(Math.log10(value))}`.replace('-', '−') : String(Number(value.toPrecision(3)))]);
        const { values, step } = ticks(range, size, apart);
        return values.filter(value => !log || value > 0).map(value => [value, text(value, step)]);
      },
    };
  };

  window.armlabAxes = { axis, escape, legible, looks, read };
})();
