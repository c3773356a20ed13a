// Numbers have a point in every browser, as the lab writes them and fields read them. Plots ask the browser for its
// own signs, which would be a comma in one plot and a point in the next.
(() => {
  'use strict';
  const Own = Intl.NumberFormat;
  const Pointed = function (_languages, options) { return new Own('en-US', { useGrouping: false, ...options }); };
  Pointed.prototype = Own.prototype;
  Pointed.supportedLocalesOf = Own.supportedLocalesOf;
  Intl.NumberFormat = Pointed;
})();
