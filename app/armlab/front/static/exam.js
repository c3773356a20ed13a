// The clock of an assignment: the lab says when the time ends and what its own clock shows; here it runs on.
(() => {
  'use strict';

  const SOON = 300; // seconds before the end from which on the clock stands out
  let said = '', ahead = 0; // what the lab's clock showed last, and by how many ms it is ahead of this computer's

  const shown = seconds => {
    const hours = Math.floor(seconds / 3600), minutes = Math.floor(seconds / 60) % 60;
    const pair = n => String(n).padStart(2, '0');
    if (hours >= 24) return `${Math.floor(hours / 24)} d ${hours % 24} h`;
    return hours ? `${hours}:${pair(minutes)}:${pair(seconds % 60)}` : `${minutes}:${pair(seconds % 60)}`;
  };

  setInterval(() => {
    const clock = document.querySelector('.as-clock');
    if (!clock) return;
    if (clock.dataset.now !== said) {
      said = clock.dataset.now;
      ahead = Number(said) - Date.now();
    }
    const left = Math.max(0, Math.ceil((Number(clock.dataset.ends) - Date.now() - ahead) / 1000));
    const text = shown(left);
    if (clock.textContent !== text) clock.textContent = text;
    clock.classList.toggle('soon', left <= SOON);
  }, 250);
})();
