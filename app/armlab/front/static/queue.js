// viser's page changes controls last when it works through the messages of a frame: one that is removed after its change
// in the same frame is missed then, which the console reports. A control that goes takes its waiting changes with it.
(() => {
  'use strict';
  const drop = (queue, uuid) => {
    for (let k = queue.length - 1; k >= 0; k--) {
      if (queue[k].type === 'GuiUpdateMessage' && queue[k].uuid === uuid) queue.splice(k, 1);
    }
  };
  const mend = queue => {
    const push = queue.push.bind(queue);
    queue.push = message => {
      if (message.type === 'GuiRemoveMessage') drop(queue, message.uuid);
      return push(message);
    };
  };
  let mutable;
  Object.defineProperty(Window.prototype, '__viserMutable', { // viser deletes its own one when it is mounted anew
    get: () => mutable,
    set(value) {
      if (value && value !== mutable) mend(value.messageQueue);
      mutable = value;
    },
  });
})();
