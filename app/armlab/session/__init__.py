"""The session of one student: state, commands, undo, mailbox, worker, store. It does not depend on the browser."""
