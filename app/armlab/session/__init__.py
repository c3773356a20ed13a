"""One student: state, commands, undo, mailbox, worker, store. Knows nothing of the browser."""
