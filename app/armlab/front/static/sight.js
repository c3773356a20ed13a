// In a small window what is said of an answer, or why something is refused, may stand out of sight. It is brought into
// sight once, no farther than it must, in the window that asked, and not while a person types elsewhere.
(() => {
  'use strict';

  const answersLast = heard => heard > 0 && heard === window.armlabAsked;
  const heardBefore = said => Number(said?.closest('[data-heard]')?.dataset.heard ?? 0);
  const typesElsewhere = field => document.activeElement !== field
    && document.activeElement?.matches('input:not([type=range]), textarea, [contenteditable]');
  const show = element => element?.scrollIntoView({ block: 'nearest' });

  let verdict = { step: '', says: '' };
  const showVerdict = () => {
    const found = document.querySelector('.ask ~ .verdict');
    const step = ['.lesson-head select', '.lesson-text h2'].map(each => document.querySelector(each)).map(each => each?.value ?? each?.textContent).join();
    const says = found?.textContent ?? '';
    const isNew = says !== '' && says !== verdict.says && step === verdict.step;
    const heard = heardBefore(found);
    if (isNew && heard > 0 && heard < window.armlabAsked) return; // what was asked since may change it once more
    verdict = { step, says };
    if (isNew && answersLast(heard) && !typesElsewhere(null)) show(found);
  };

  const told = new Set();
  const showRefusals = () => {
    for (const said of document.querySelectorAll('[data-heard] > [role=alert]')) {
      const heard = heardBefore(said);
      const key = `${heard} ${said.textContent}`;
      if (!answersLast(heard) || told.has(key)) continue;
      told.add(key);
      const field = said.parentElement.querySelector('[aria-invalid=true]');
      if (typesElsewhere(field)) continue;
      show(field);
      show(said); // where there is no room for both, it tells more
    }
  };

  window.armlabWatch(window.armlabInFrame(() => {
    showVerdict();
    showRefusals();
  }));
})();
