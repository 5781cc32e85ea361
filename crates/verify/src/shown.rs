//! Texts that others wrote, in one line: a program's words, a panic's message, a name in a file, a path. Printed as it is, such
//! a text could move the cursor, hide what stands beside it, begin a line that looks like one of ours, or break a file of
//! XML. Quotes and backslashes stay, so that a command can be copied, and a text that was made so before stays what it is.

pub(crate) use whole_file::{is_hidden as is_unseen, printable as shown};
