"""Which texts of a page look like none that axe-core has passed: only these must be judged for their contrast.

What axe measures follows from the colours, size and weight of a text, from what lets it shine through, and from what is
painted under and over it. Texts alike in all of this are as good to read, on whichever page they are.
"""

LOOKS = r"""(() => {
  const pictures = ['IMG', 'CANVAS', 'VIDEO', 'OBJECT', 'EMBED', 'IFRAME', 'svg'];
  const paints = (each, { backgroundColor, backgroundImage }) =>
    !/^(transparent|.*, 0\))$/.test(backgroundColor) || backgroundImage !== 'none' || pictures.includes(each.tagName);

  const painted = () => {
    const found = [];
    for (const each of document.querySelectorAll('html, body *')) {
      const style = getComputedStyle(each);
      if (!paints(each, style)) continue;
      const box = each.getBoundingClientRect();
      const { backgroundColor, backgroundImage, zIndex, position } = style;
      const beside = `${each.tagName} ${each.getAttribute('class')} ${zIndex} ${position}`;
      const what = `${pictures.includes(each.tagName)} ${backgroundColor} ${backgroundImage}`;
      found.push({ each, box, what, beside });
    }
    return found;
  };

  const shine = (each, known) => {
    if (!each) return '';
    if (!known.has(each)) {
      const { opacity, filter, mixBlendMode } = getComputedStyle(each), own = `${opacity} ${filter} ${mixBlendMode}`;
      known.set(each, shine(each.parentElement, known) + (own === '1 none normal' ? '' : ` / ${own}`));
    }
    return known.get(each);
  };

  const boxOf = (each, texts) => {
    const range = document.createRange(), boxes = [each.getBoundingClientRect()];
    for (const text of texts) {
      range.selectNode(text);
      boxes.push(...range.getClientRects());
    }
    return {
      left: Math.min(...boxes.map(box => box.left)), right: Math.max(...boxes.map(box => box.right)),
      top: Math.min(...boxes.map(box => box.top)), bottom: Math.max(...boxes.map(box => box.bottom)),
    };
  };

  const around = (own, each, all, dim) => {
    let found = [];
    for (const { each: other, box, what, beside } of all) {
      const within = other.contains(each);
      const apart = box.left >= own.right || box.right <= own.left || box.top >= own.bottom || box.bottom <= own.top;
      if (apart && !within) continue;
      const whole = box.left <= own.left + 1 && box.right >= own.right - 1
        && box.top <= own.top + 1 && box.bottom >= own.bottom - 1;
      // What holds the text and is opaque covers all that holds it in turn.
      if (within && whole && !dim && /^false rgb\(/.test(what)) found = found.filter(([, place]) => place);
      found.push([`${what} ${whole}`, within ? '' : beside]);
    }
    return found.map(each => each.join(' '));
  };

  const letters = ({ fontSize, fontWeight, textShadow, webkitTextStrokeWidth, webkitTextStrokeColor }) => {
    const plain = textShadow === 'none' && webkitTextStrokeWidth === '0px';
    // Size and weight count from 14 points on; before, all are small.
    if (plain && parseFloat(fontSize) < 18) return 'small';
    return [fontSize, fontWeight, textShadow, webkitTextStrokeWidth, webkitTextStrokeColor].join(' ');
  };

  return place => {
    const all = painted(), known = new Map(), looks = new Map();
    for (const each of place.querySelectorAll('*')) {
      const texts = [...each.childNodes].filter(node => node.nodeType === Node.TEXT_NODE && node.data.trim());
      const typed = /^(INPUT|SELECT|TEXTAREA)$/.test(each.tagName);
      if ((!texts.length && !typed) || !each.checkVisibility({ visibilityProperty: true })) continue;
      const text = texts.map(node => node.data).join('').trim(), style = getComputedStyle(each);
      const dim = shine(each, known), own = [text.length === 1, style.color, letters(style), dim];
      looks.set(each, [...own, ...around(boxOf(each, texts), each, all, dim)].join(' | '));
    }
    return looks;
  };
})()"""
"""Returns how each element of a place that holds text looks, in words that are equal for equal looks."""
