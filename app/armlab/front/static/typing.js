// What a person types is never touched while the field has the focus. The lab writes markup anew, fields included,
// whenever something in it changes, and over a slow network that comes in the middle of a word: the field stays the
// element it is, and the new markup is put around it.
(() => {
  'use strict';
  const { set } = Object.getOwnPropertyDescriptor(Element.prototype, 'innerHTML');
  const texts = 'input.field, textarea.field';
  const nameOf = ({ dataset }) => `${dataset.chan} ${dataset.cell}`;

  const touched = new WeakSet(); // fields in which something was typed since they were last sent
  const sent = new Map(); // by channel and cell: what was sent last, where, and its number; until the lab has answered
  let number = 0;

  // Messages of a page are numbered; the markup of the lab says up to which it has heard.
  window.armlabNumber = (element, value) => {
    number = Math.max(number + 1, Date.now());
    sent.set(nameOf(element), { number, value, of: window.armlabQuestion(element) });
    return number;
  };

  document.addEventListener('input', event => {
    if (event.target.matches?.(texts)) touched.add(event.target);
  }, true);
  document.addEventListener('change', event => touched.delete(event.target), true);
  document.addEventListener('focusout', event => {
    const field = event.target;
    if (!field.isConnected || !touched.delete(field)) return;
    field.value = field.defaultValue; // typed and taken back: what the lab says holds
  });

  // Taking an element out of the page looks like leaving it, and like an entry; it is neither.
  let replacing = false;
  for (const kind of ['change', 'focusout', 'blur']) {
    addEventListener(kind, event => { if (replacing) event.stopImmediatePropagation(); }, true);
  }

  const withoutGaps = made => {
    const heard = Number(made.querySelector('[data-heard]')?.dataset.heard ?? NaN);
    if (Number.isNaN(heard)) return;
    for (const field of made.querySelectorAll('[data-chan][data-cell]')) {
      const last = sent.get(nameOf(field));
      if (!last) continue;
      if (last.number <= heard) sent.delete(nameOf(field));
      else if (field.matches(texts) && last.of === window.armlabQuestion(field)) {
        field.defaultValue = last.value; // the answer to it is still to come
      }
    }
  };

  const chain = (element, top) => {
    const found = [];
    for (let each = element; each && each !== top; each = each.parentNode) found.unshift(each);
    return found;
  };
  const takeAttributes = (stays, comes) => {
    for (const { name } of [...stays.attributes]) {
      const byHand = name === 'open' || name === 'value' || name.startsWith('data-unsent');
      if (!byHand && !comes.hasAttribute(name)) stays.removeAttribute(name);
    }
    for (const { name, value } of comes.attributes) {
      if (name !== 'value' && stays.getAttribute(name) !== value) stays.setAttribute(name, value);
    }
  };
  const takeValue = (stays, comes) => {
    if (stays.matches('select')) {
      if (stays.innerHTML !== comes.innerHTML) stays.replaceChildren(...comes.childNodes);
      // What was chosen and refused says so no longer; what is still on its way stays.
      else if (!sent.has(nameOf(stays)) && stays.value !== comes.value) stays.value = comes.value;
    } else if (stays.matches('button')) {
      stays.replaceChildren(...comes.childNodes);
    } else if (stays.matches('[type=range]')) {
      if (!stays.matches(':active')) stays.value = comes.value;
    } else if (touched.has(stays)) {
      stays.defaultValue = comes.defaultValue; // shows nowhere: the field has a text of its own
    } else if (stays.value !== comes.value || stays.defaultValue !== comes.defaultValue) {
      const all = stays.selectionStart === 0 && stays.selectionEnd === stays.value.length;
      stays.defaultValue = comes.defaultValue;
      stays.value = comes.value;
      if (all) stays.select();
    }
  };

  // Put new markup around the element that has the focus; return whether its place in both is the same.
  const around = (top, focused, made) => {
    const { chan, cell } = focused.dataset;
    const twin = made.querySelector(`[data-chan="${CSS.escape(chan)}"][data-cell="${CSS.escape(cell)}"]`);
    if (!twin || twin.disabled || !window.armlabSame(focused, twin)) return false;
    const old = chain(focused, top);
    const fresh = chain(twin, made);
    if (old.length !== fresh.length || old.some((each, i) => each.localName !== fresh[i].localName)) return false;
    let [inside, source] = [top, made];
    old.forEach((stays, i) => {
      const comes = fresh[i];
      const nodes = [...source.childNodes];
      const at = nodes.indexOf(comes);
      for (const node of [...inside.childNodes]) if (node !== stays) node.remove();
      stays.before(...nodes.slice(0, at));
      stays.after(...nodes.slice(at + 1));
      takeAttributes(stays, comes);
      [inside, source] = [stays, comes];
    });
    takeValue(focused, twin);
    return true;
  };

  Object.defineProperty(Element.prototype, 'innerHTML', {
    ...Object.getOwnPropertyDescriptor(Element.prototype, 'innerHTML'),
    set(html) {
      if (this.localName === 'template' || !String(html).includes('data-chan')) {
        set.call(this, html);
        return;
      }
      const template = document.createElement('template');
      set.call(template, html);
      withoutGaps(template.content);
      const focused = document.activeElement;
      const ours = focused?.dataset?.chan && focused !== this && this.contains(focused);
      if (ours && around(this, focused, template.content)) return;
      replacing = true;
      try {
        this.replaceChildren(template.content);
      } finally {
        replacing = false;
      }
    },
  });
})();
