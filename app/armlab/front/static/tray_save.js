// A plot of the tray as a file: the SVG that is seen, with its title and legend; as PNG at twice the size or more.
(() => {
  'use strict';

  const { escape, looks } = window.armlabAxes;
  const TITLE = 26, ROW = 20, ENTRY = 36, LETTER = 7; // pixels

  const drawn = plot => {
    const { wide, tall } = plot.size, colours = looks();
    let x = 12, y = TITLE + tall + 14;
    const entries = [...plot.list.querySelectorAll('button[aria-pressed=true]')].map(button => {
      const name = button.dataset.curve, size = ENTRY + LETTER * name.length + 14;
      if (x > 12 && x + size > wide) [x, y] = [12, y + ROW];
      const found = `<g transform="translate(${x} ${y - 9})">${button.querySelector('svg').innerHTML}</g>`
        + `<text x="${x + ENTRY - 4}" y="${y}" fill="${colours.ink}">${escape(name)}</text>`;
      x += size;
      return found;
    });
    const height = y + 12;
    return {
      wide, height,
      text: `<svg xmlns="http://www.w3.org/2000/svg" width="${wide}" height="${height}" viewBox="0 0 ${wide} ${height}" `
        + `font-family="system-ui, sans-serif" font-size="11.5"><rect width="${wide}" height="${height}" fill="${colours.panel}"/>`
        + `<text x="12" y="18" font-size="14" font-weight="600" fill="${colours.ink}">${escape(plot.title)}</text>`
        + `<g transform="translate(0 ${TITLE})">${plot.svg.innerHTML}</g>${entries.join('')}</svg>`,
    };
  };

  const bring = (blob, name) => {
    const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 5000);
  };

  window.armlabSavePlot = (kind, plot, name) => {
    const { wide, height, text } = drawn(plot);
    const picture = new Blob([text], { type: 'image/svg+xml' });
    if (kind === 'svg') {
      bring(picture, `${name}.svg`);
      return;
    }
    const image = new Image(), scale = Math.max(2, devicePixelRatio);
    image.onload = () => {
      const canvas = Object.assign(document.createElement('canvas'), { width: wide * scale, height: height * scale });
      canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob(blob => bring(blob, `${name}.png`), 'image/png');
      URL.revokeObjectURL(image.src);
    };
    image.src = URL.createObjectURL(picture);
  };
})();
