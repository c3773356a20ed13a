// Files that are chosen or dropped on a page.
(() => {
  'use strict';

  const send = window.armlabSend;

  // Files are read here and arrive as text: the lab takes no uploads. A field may take more bytes with data-most.
  // What becomes too long for a message when it is written as JSON is no text; the lab says so of a zero character.
  const fits = text => new Blob([JSON.stringify(text)]).size < 2e6;
  // <input data-named>: the name comes first, on a line of its own, and an archive in base64.
  const packed = async part => {
    const bytes = new Uint8Array(await part.arrayBuffer());
    let text = '';
    for (let k = 0; k < bytes.length; k += 4096) text += String.fromCharCode(...bytes.subarray(k, k + 4096));
    return `zip:${btoa(text)}`;
  };
  let reading = Promise.resolve(); // one after the other, so that the last file chosen is the last one told
  document.addEventListener('change', event => {
    const file = event.target.matches?.('input[type=file][data-chan]') && event.target.files[0];
    if (!file) return;
    const field = event.target;
    const most = Number(field.dataset.most) || 50000; // one more is sent than the lab takes, so that it says so
    const part = file.slice(0, most + 1);
    const named = field.matches('[data-named]');
    const head = named ? `${file.name.replace(/\s+/g, ' ')}\n` : '';
    const told = text => send(field, head + (fits(text) ? text : '\0'));
    const read = () => (named && /\.zip$/i.test(file.name) ? packed(part) : part.text());
    reading = reading.then(read).then(told).catch(error => console.error(error));
    field.value = '';
  });

  // Files the lab would refuse anyway are not sent: viser has no limit of its own.
  document.addEventListener('change', event => {
    const file = event.target.files?.[0];
    if (file && file.size > 5e6 && !event.target.dataset.chan) {
      event.stopImmediatePropagation();
      event.target.value = '';
    }
  }, true);
})();
