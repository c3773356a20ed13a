// A word in the scene's place until the arm stands there: from the first moment of the page, and whenever the figure of
// another arm takes long.
(() => {
  'use strict';

  const LOOK = 150; // ms between two looks
  const LONG = 400; // ms after which another figure counts as taking long
  const SILENT = 30000; // ms after which a lab that has said nothing has probably refused the page
  const MOST = 5000; // ms for which the page may take to put up what the lab has sent

  const word = document.createElement('p');
  word.className = 'al-coming';
  word.setAttribute('role', 'status');
  const show = text => { if (word.textContent !== text) word.textContent = text; };
  show('The lab is starting …'); // before the language is known

  const stands = () => Object.keys(window.__viserMutable?.nodeRefFromName ?? {}).some(name => name.endsWith('/body'));
  let known = null; // when the lab was heard of first
  let first = true; // whether no arm has stood here yet
  let since = null; // since when a figure is being made
  let text = ''; // of the notes, read last
  let notes = { arm: '', coming: true };

  const look = () => {
    const said = document.getElementById('al-notes')?.dataset.notes;
    if (!said && performance.now() > SILENT) show(window.armlabSay('The lab does not answer. If it is open in many windows, close some and load this page again.'));
    if (!said) return;
    if (said !== text) notes = JSON.parse(text = said);
    const now = performance.now();
    known ??= now;
    since = notes.coming ? since ?? now : null;
    first &&= notes.coming || (notes.handle && !stands() && now - known < MOST); // a question may hide arm and handle
    show(first || (since !== null && now - since > LONG) ? window.armlabSay('{arm} is on its way …', { arm: notes.arm }) : '');
  };
  setInterval(look, LOOK);

  const put = () => document.body.append(word);
  if (document.body) put();
  else addEventListener('DOMContentLoaded', put);
})();
