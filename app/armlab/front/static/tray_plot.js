// One large plot of the tray: its curves as an SVG at the screen's resolution, a cursor that reads them, a legend whose
// entries hide and show them, and zoom. It is drawn of what the lab sends; see ui/tray_picture.py.
(() => {
  'use strict';

  const { axis, escape, legible, looks, read } = window.armlabAxes;
  const DASHES = [[], [9, 4], [2, 3], [9, 3, 2, 3], [14, 4], [5, 2], [2, 2, 2, 6]];
  const TOP = 20, RIGHT = 14, BOTTOM = 36, LETTER = 6.4; // pixels
  const ROOM = 0.06; // above and below curves, of their extent
  const FINEST = 1e-6; // of a value: the curves come in single precision
  const LEAST = 6; // pixels of a drag that is more than a press
  let made = 0;

  const numbersOf = (code, picture) => {
    const bytes = Uint8Array.from(atob(code), sign => sign.charCodeAt(0));
    const all = new Float32Array(bytes.buffer);
    let from = 0;
    const lines = picture.curves.filter(each => !each.dots && !each.dash && each.width < 5);
    const colours = [...new Set(lines.map(each => String(each.colour)))];
    return picture.curves.map(curve => {
      const x = all.subarray(from, from + curve.count), y = all.subarray(from + curve.count, from + 2 * curve.count);
      from += 2 * curve.count;
      const own = curve.dots || curve.width >= 5 ? [] : DASHES[Math.max(0, colours.indexOf(String(curve.colour))) % DASHES.length];
      return { ...curve, x, y, dash: curve.dash ?? own, label: curve.name.split(', ')[0], unit: curve.name.split(', ').slice(1).join(', ') };
    });
  };

  // The dots of a formula stand behind their letter in its text; as combining signs they stand over it.
  const combined = text => text.replaceAll('\u02d9', '\u0307').replaceAll('\u00a8', '\u0308');

  const reach = (lists, room) => {
    let low = Infinity, high = -Infinity;
    for (const list of lists) for (const value of list) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (!(high >= low)) return [0, 1];
    const extent = high - low > 1e-9 * Math.max(1, Math.abs(high)) ? high - low : 1 / Math.max(room, 0.1);
    return [low - room * extent, high + room * extent];
  };

  // The value of a curve at x, where its points rise; not a number in a gap and beyond its ends.
  const valueAt = ({ x, y, dots }, at) => {
    let low = 0, high = x.length - 1;
    if (high < 0) return NaN;
    const rounding = FINEST * Math.max(Math.abs(x[0]), Math.abs(x[high]));
    if (!(at >= x[0] - rounding && at <= x[high] + rounding)) return NaN;
    at = Math.min(Math.max(at, x[0]), x[high]);
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (x[middle] <= at) low = middle; else high = middle;
    }
    if (dots) return y[at - x[low] < x[high] - at ? low : high];
    const part = x[high] > x[low] ? (at - x[low]) / (x[high] - x[low]) : 0;
    return part === 0 ? y[low] : part === 1 ? y[high] : y[low] + part * (y[high] - y[low]);
  };

  const pathOf = (curve, X, Y) => {
    const { x, y, dots } = curve;
    const parts = [];
    let pen = 'M';
    for (let i = 0; i < x.length; i++) {
      const px = X.at(x[i]), py = Y.at(y[i]);
      if (!Number.isFinite(px) || !Number.isFinite(py)) { pen = 'M'; continue; }
      parts.push(`${pen}${px.toFixed(2)} ${Math.max(-9999, Math.min(9999, py)).toFixed(2)}`);
      if (dots) parts.push('h0'); else pen = 'L';
    }
    return parts.join('');
  };

  const strokeOf = (curve, colours) => `stroke="${legible(curve.colour, colours.ground)}" stroke-width="${curve.width}"`
    + `${curve.dots ? ' stroke-linecap="round"' : curve.dash.length ? ` stroke-dasharray="${curve.dash.join(' ')}"` : ''}`
    + `${curve.opacity ? ` opacity="${curve.opacity}"` : ''}`;
  const sample = (curve, colours) => `<svg width="26" height="10" aria-hidden="true"><path fill="none" ${strokeOf(curve, colours)} `
    + `d="${curve.dots ? 'M13 5h0' : 'M1 5H25'}"/></svg>`;

  class Plot {
    // `asked` has: point(plot, x), canScrub(plot), scrub(plot, time, done), save(kind, plot).
    constructor(key, asked) {
      Object.assign(this, { key, asked, hidden: new Set(), zoom: null, pointer: null, mark: null, clip: `al-tray-clip-${made++}` });
      const box = this.box = document.createElement('div');
      box.className = 'tray-plot';
      box.innerHTML = '<div class="tray-head"><h3></h3><span class="tray-acts">'
        + `<button type="button" data-act="reset" title="${window.armlabSay('Whole curves again (double click)')}">${window.armlabSay('Reset zoom')}</button>`
        + '<button type="button" data-act="png">PNG</button><button type="button" data-act="svg">SVG</button>'
        + '<button type="button" data-act="csv">CSV</button></span></div>'
        + `<div class="tray-body"><div class="tray-field" role="slider" tabindex="0" aria-label="${window.armlabSay('Cursor')}" aria-valuenow="0" aria-orientation="horizontal">`
        + '<svg class="tray-svg" role="presentation"></svg><svg class="tray-over" role="presentation"></svg></div>'
        + '<div class="tray-legend"><output aria-live="off"></output><ul></ul></div></div>';
      this.field = box.querySelector('.tray-field');
      this.svg = box.querySelector('.tray-svg');
      this.over = box.querySelector('.tray-over');
      this.list = box.querySelector('ul');
      box.addEventListener('click', event => this.act(event.target.closest('button')));
      this.listen();
    }

    act(button) {
      if (!button) return;
      const { act, curve } = button.dataset;
      if (act === 'reset') this.setZoom(null);
      else if (act) this.asked.save(act, this);
      else if (curve !== undefined) {
        if (!this.hidden.delete(curve)) this.hidden.add(curve);
        this.draw();
      }
    }

    set(picture, code) {
      const quantities = JSON.stringify([picture.title, picture.x]); // with their units: a zoom is in these
      if (this.quantities !== quantities) {
        this.quantities = quantities;
        this.zoom = null;
        this.hidden.clear();
      }
      this.picture = picture;
      this.curves = numbersOf(code, picture);
      this.box.querySelector('h3').innerHTML = picture.title;
      this.title = combined(this.box.querySelector('h3').textContent);
      for (const act of ['png', 'svg', 'csv']) {
        this.box.querySelector(`[data-act=${act}]`).ariaLabel = window.armlabSay('Save {title} as {kind}', { title: this.title, kind: act.toUpperCase() });
      }
      this.makeLegend();
      this.draw();
    }

    get seen() { return this.curves.filter(each => !this.hidden.has(each.name)); }

    makeLegend() {
      const paler = each => (each.opacity ? 1 : 0); // what others are compared with comes after them
      const names = [...new Set(this.curves.toSorted((a, b) => paler(a) - paler(b)).map(each => each.name))];
      const drawn = JSON.stringify([names, this.curves.map(each => [each.colour, each.dash, each.width]), looks().ground]);
      if (drawn === this.listed) return;
      this.listed = drawn;
      const focused = document.activeElement?.closest?.('.tray-legend') === this.list.parentElement && document.activeElement.dataset.curve;
      this.list.innerHTML = names.map(name => {
        const curve = this.curves.findLast(each => each.name === name);
        return `<li><button type="button" data-curve="${escape(name)}" title="${escape(name)}">${sample(curve, looks())}`
          + `<span>${escape(curve.label)}</span><b></b></button></li>`;
      }).join('');
      this.box.classList.toggle('flat', names.length < 5);
      if (focused) this.list.querySelector(`[data-curve="${CSS.escape(focused)}"]`)?.focus();
    }

    ranges() {
      const { across, up, square } = this.picture;
      if (this.zoom) return this.zoom;
      const seen = this.seen.length ? this.seen : this.curves;
      const x = across ?? reach(seen.map(each => each.x), square ? ROOM : 0);
      return { x, y: up && !this.hidden.size ? up : reach(seen.map(each => each.y), ROOM) };
    }

    draw() {
      const wide = this.field.clientWidth, tall = this.field.clientHeight;
      if (!this.picture || wide < 40 || tall < 60) return;
      const colours = looks(), { picture, clip } = this;
      let { x, y } = this.ranges();
      const rough = axis(y, tall - BOTTOM, TOP, false).marks(26);
      const left = 14 + LETTER * Math.max(2, ...rough.map(([, text]) => text.length));
      const right = wide - RIGHT, bottom = tall - BOTTOM;
      if (picture.square) [x, y] = sameScale(x, y, right - left, bottom - TOP);
      const X = this.X = axis(x, left, right, picture.log), Y = this.Y = axis(y, bottom, TOP, false);
      const part = [`<clipPath id="${clip}"><rect x="${left}" y="${TOP}" width="${right - left}" height="${bottom - TOP}"/></clipPath>`];
      const line = (d, colour, more = '') => part.push(`<path d="${d}" fill="none" stroke="${colour}" ${more}/>`);
      const word = (px, py, text, anchor, colour = colours.dim) => part.push(
        `<text x="${px.toFixed(1)}" y="${py.toFixed(1)}" text-anchor="${anchor}" fill="${colour}" stroke="${colours.panel}" stroke-width="3" paint-order="stroke">${escape(text)}</text>`);
      for (const [value, text] of X.marks(54)) {
        line(`M${X.at(value).toFixed(1)} ${TOP}V${bottom}`, colours.line);
        word(X.at(value), bottom + 14, text, 'middle');
      }
      for (const [value, text] of Y.marks(26)) {
        line(`M${left} ${Y.at(value).toFixed(1)}H${right}`, colours.line, value === 0 ? 'stroke-width="2"' : '');
        word(left - 5, Y.at(value) + 4, text, 'end');
      }
      word(right, bottom + 30, picture.x, 'end', colours.ink);
      word(4, 12, this.unit, 'start', colours.ink);
      part.push(`<g clip-path="url(#${clip})">`);
      const named = [];
      for (const { name, value } of picture.marks) {
        const px = X.at(value), before = px + 10 + LETTER * name.length > right; // a name keeps within the plot
        line(`M${px.toFixed(1)} ${TOP}V${bottom}`, colours.dim, 'opacity=".5"');
        word(px + (before ? -5 : 5), bottom - 6, name, before ? 'end' : 'start');
      }
      for (const level of picture.levels) {
        const at = Y.at(level.value), colour = legible(level.colour, colours.ground);
        if (at < TOP - 1 || at > bottom + 1) continue;
        line(`M${left} ${at.toFixed(1)}H${right}`, colour, 'stroke-dasharray="7 4"');
        const py = at < TOP + 14 ? at + 12 : at - 4; // names that would cover each other stand side by side
        const px = named.reduce((place, other) => (Math.abs(other.py - py) < 12 ? Math.min(place, other.start - 10) : place), right - 4);
        named.push({ py, start: px - LETTER * level.name.length });
        word(px, py, level.name, 'end', colour);
      }
      for (const curve of this.seen) part.push(`<path class="curve" fill="none" ${strokeOf(curve, colours)} d="${pathOf(curve, X, Y)}"/>`);
      part.push('</g>');
      this.svg.innerHTML = part.join('');
      this.size = { wide, tall, left, right, bottom };
      for (const button of this.list.querySelectorAll('button')) button.ariaPressed = String(!this.hidden.has(button.dataset.curve));
      this.box.querySelector('[data-act=reset]').disabled = !this.zoom;
      this.show();
    }

    // The unit of all curves; of several units each curve says its own.
    get common() {
      const units = [...new Set(this.curves.map(each => each.unit))];
      return units.length === 1 ? units[0] || this.title.split(', ').slice(1).join(', ') : '';
    }
    get unit() { return this.picture.y || (this.curves.length === 1 && (this.curves[0].unit || !this.common) ? this.curves[0].name : this.common); }

    // -- the cursor ----------------------------------------------------------------------------------------------

    // Where the lab, or the timeline, marks a value; null for nowhere.
    at(value) {
      if (value === this.mark) return;
      this.mark = value;
      this.show();
    }

    // Where a hand points; null for nowhere.
    point(value) {
      this.pointer = value;
      this.show();
    }

    get read() { return this.pointer ?? this.mark; }

    show() {
      if (!this.size || !this.picture) return;
      const { left, right, bottom } = this.size, colours = looks(), at = this.read;
      const parts = [];
      const upright = (value, colour) => {
        const px = this.X.at(value);
        if (px >= left - 0.5 && px <= right + 0.5) parts.push(`<path d="M${px.toFixed(1)} ${TOP}V${bottom}" stroke="${colour}" stroke-width="1.5"/>`);
      };
      if (this.mark !== null) upright(this.mark, colours.time);
      if (this.pointer !== null) upright(this.pointer, colours.dim);
      const values = new Map(), { common } = this;
      if (at !== null && !this.picture.square) for (const curve of this.seen) {
        const value = valueAt(curve, at), py = this.Y.at(value), px = this.X.at(at);
        if (!Number.isFinite(value)) continue;
        values.set(curve.name, `${read(value, this.Y.range)}${curve.unit && !common ? ` ${curve.unit}` : ''}`);
        if (px >= left && px <= right && py >= TOP && py <= bottom) {
          parts.push(`<circle cx="${px.toFixed(1)}" cy="${py.toFixed(1)}" r="3.5" fill="${legible(curve.colour, colours.ground)}" stroke="${colours.panel}"/>`);
        }
      }
      if (this.drawn) {
        const [a, b, c, d] = this.drawn;
        parts.push(`<rect x="${Math.min(a, c)}" y="${Math.min(b, d)}" width="${Math.abs(c - a)}" height="${Math.abs(d - b)}" fill="${colours.brand}" opacity=".2"/>`);
      }
      this.over.innerHTML = parts.join('');
      const [name, unit = ''] = this.picture.x.split(', ');
      const beside = this.picture.square && this.pointer !== null ? `, ${this.picture.y} = ${read(this.height, this.Y.range)}` : '';
      const said = at === null ? '' : `${name} = ${read(at, this.X.range)} ${unit}`.trim() + beside;
      const output = this.box.querySelector('output'), over = said && common ? `${said};  in ${common}` : said;
      if (output.textContent !== over) output.textContent = over;
      for (const button of this.list.querySelectorAll('button')) {
        const place = button.lastChild, text = values.get(button.dataset.curve) ?? '';
        if (place.textContent !== text) place.textContent = text;
      }
      const [low, high] = this.X.range;
      const told = [...values].map(([curve, text]) => `${curve.split(', ')[0]} ${text} ${common}`.trim()).join('; ');
      Object.assign(this.field, { ariaLabel: window.armlabSay('Cursor of {title}', { title: this.title }), ariaValueMin: low, ariaValueMax: high, ariaValueNow: at ?? low,
        ariaValueText: said ? `${said}: ${told}` : window.armlabSay('not in the plot') });
    }

    // -- the hand ------------------------------------------------------------------------------------------------

    // No zoom goes farther than numbers of the curves can be told from each other.
    setZoom(zoom) {
      const told = ([low, high]) => high - low > FINEST * Math.max(Math.abs(low), Math.abs(high)) && Number.isFinite(high - low);
      if (zoom && !(told(zoom.x) && told(zoom.y))) return;
      this.zoom = zoom;
      this.draw();
    }

    // Stretch a range about a value.
    zoomed(shown, about, by) {
      const inside = value => (shown.log ? Math.log(value) : value), back = shown.log ? Math.exp : Number;
      return shown.range.map(end => back(inside(about) + (inside(end) - inside(about)) * by));
    }

    listen() {
      const { field } = this;
      const place = event => {
        const box = field.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
      };
      const inside = px => Math.min(Math.max(px, this.size.left), this.size.right);
      let from = null, scrubs = false;
      field.addEventListener('pointerdown', event => {
        if (event.button !== 0 || !this.size) return;
        field.setPointerCapture(event.pointerId);
        from = place(event);
        scrubs = !event.shiftKey && this.asked.canScrub(this);
        if (scrubs) this.asked.scrub(this, this.X.value(inside(from[0])), false);
      });
      field.addEventListener('pointermove', event => {
        if (!this.size) return;
        const [px, py] = place(event);
        this.height = this.Y.value(py);
        this.asked.point(this, px >= this.size.left && px <= this.size.right ? this.X.value(px) : null);
        if (from && scrubs) {
          this.mark = this.X.value(inside(px));
          this.asked.scrub(this, this.mark, false);
        } else if (from && Math.abs(px - from[0]) > LEAST) {
          const flat = Math.abs(py - from[1]) < 4 * LEAST; // a drag along the axis
          this.drawn = [inside(from[0]), flat ? TOP : from[1], inside(px), flat ? this.size.bottom : py];
        }
        this.show();
      });
      const end = event => {
        if (from && scrubs) this.asked.scrub(this, this.X.value(inside(place(event)[0])), true);
        const box = this.drawn;
        from = this.drawn = null;
        if (box && event.type === 'pointerup') {
          const sorted = (a, b) => (a < b ? [a, b] : [b, a]);
          this.setZoom({ x: sorted(this.X.value(box[0]), this.X.value(box[2])), y: sorted(this.Y.value(box[1]), this.Y.value(box[3])) });
        } else this.show();
      };
      field.addEventListener('pointerup', end);
      field.addEventListener('pointercancel', end);
      field.addEventListener('lostpointercapture', event => { if (from) end(event); }); // the tray was closed meanwhile
      field.addEventListener('pointerleave', () => this.asked.point(this, null));
      field.addEventListener('dblclick', () => this.setZoom(null));
      field.addEventListener('wheel', event => {
        if (!this.size) return;
        event.preventDefault();
        const turn = event.deltaY || (event.shiftKey ? event.deltaX : 0); // a Mac turns the wheel sideways with Shift
        if (!turn) return;
        const [px, py] = place(event), by = Math.exp(Math.max(-1, Math.min(1, turn / 250))), { square } = this.picture;
        const beside = px < this.size.left && !square; // over the numbers of the ordinate
        const x = beside ? this.X.range : this.zoomed(this.X, this.X.value(inside(px)), by);
        this.setZoom({ x, y: beside || square || event.shiftKey ? this.zoomed(this.Y, this.Y.value(py), by) : this.Y.range });
      }, { passive: false });
      field.addEventListener('keydown', event => this.press(event));
      field.addEventListener('blur', () => this.asked.point(this, null));
    }

    press(event) {
      if (event.ctrlKey || event.metaKey || event.altKey || !this.size) return;
      const [low, high] = this.X.range, now = this.read ?? low;
      const step = (high - low) / (event.shiftKey ? 20 : 200);
      const to = { ArrowRight: now + step, ArrowLeft: now - step, Home: low, End: high }[event.key];
      if (to !== undefined) {
        const held = Math.min(Math.max(to, low), high);
        if (this.asked.canScrub(this)) {
          this.asked.point(this, null);
          this.asked.scrub(this, held, true);
        } else this.asked.point(this, held);
      } else if (event.key === '+' || event.key === '-') {
        const by = event.key === '+' ? 0.7 : 1 / 0.7, [bottom, top] = this.Y.range;
        const x = this.zoomed(this.X, this.read ?? (low + high) / 2, by);
        this.setZoom({ x, y: this.picture.square ? this.zoomed(this.Y, (bottom + top) / 2, by) : this.Y.range });
      } else if (event.key === '0') this.setZoom(null);
      else return;
      event.preventDefault();
      event.stopPropagation();
    }
  }

  const sameScale = (x, y, wide, tall) => {
    const unit = Math.max((x[1] - x[0]) / wide, (y[1] - y[0]) / tall) / 2;
    const [cx, cy] = [x, y].map(([low, high]) => (low + high) / 2);
    return [[cx - unit * wide, cx + unit * wide], [cy - unit * tall, cy + unit * tall]];
  };

  window.armlabTrayPlot = Plot;
})();
