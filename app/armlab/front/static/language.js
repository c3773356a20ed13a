// The language of the page: what scripts say by themselves, and loading the page anew when another language is chosen.
// A text may have places for what the lab says, {NAME}; <i id=al-words lang=CODE data-words={ENGLISH: SAID}> is there in all languages but English.
(() => {
  'use strict';
  let words = null;
  window.armlabSay = (text, names = {}) => {
    const element = words ? null : document.getElementById('al-words');
    if (element) {
      words = JSON.parse(element.dataset.words);
      document.documentElement.lang = element.lang;
    }
    return (words?.[text] ?? text).replace(/\{(\w+)\}/g, (place, name) => names[name] ?? place);
  };
  window.armlabWatch(() => {
    window.armlabSay('');
    if (document.getElementById('al-anew')) location.reload();
  });
})();
