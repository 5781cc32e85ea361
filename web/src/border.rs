//! The functions that JavaScript calls. A text is written to the address that `question` gives, `ask` answers it, and the
//! answer is read from the address that `answer` gives. No address outlives the next call.
//!
//! There is one page, because WebAssembly without threads has one thread.
#![expect(unsafe_code, reason = "exporting a function by its name is an unsafe attribute; nothing else here is unsafe")]

use std::cell::RefCell;

use crate::page::Page;

#[derive(Default)]
struct Border {
    page: Page,
    question: Vec<u8>,
    answer: String,
}

thread_local! {
    static BORDER: RefCell<Border> = RefCell::default();
}

fn at_border<T>(act: impl FnOnce(&mut Border) -> T) -> T {
    BORDER.with_borrow_mut(act)
}

/// Room for a question of so many bytes.
#[unsafe(no_mangle)]
extern "C" fn question(bytes: usize) -> *mut u8 {
    at_border(|border| {
        border.question.clear();
        border.question.resize(bytes, 0);
        border.question.as_mut_ptr()
    })
}

/// Answers the question, and returns the number of bytes of the answer.
#[unsafe(no_mangle)]
extern "C" fn ask() -> usize {
    at_border(|border| {
        border.answer = border.page.ask(&String::from_utf8_lossy(&border.question));
        border.answer.len()
    })
}

/// The answer, as UTF-8.
#[unsafe(no_mangle)]
extern "C" fn answer() -> *const u8 {
    at_border(|border| border.answer.as_ptr())
}

/// The frame at a time (s); see [`Page::frame`].
#[unsafe(no_mangle)]
extern "C" fn frame(time: f64) -> *const f64 {
    at_border(|border| border.page.frame(time).as_ptr())
}

/// The trace; see [`Page::numbers`].
#[unsafe(no_mangle)]
extern "C" fn numbers() -> *const f64 {
    at_border(|border| border.page.numbers().as_ptr())
}

/// The cells of the map; see [`Page::cells`].
#[unsafe(no_mangle)]
extern "C" fn cells() -> *const u8 {
    at_border(|border| border.page.cells().as_ptr())
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::*;

    /// What the page does: it writes the question's bytes to their address, and reads the answer from its own.
    fn asked(text: &[u8]) -> String {
        let address = question(text.len());
        // SAFETY: `question` has made room for as many bytes, and nothing else is called before they are written.
        unsafe { address.copy_from_nonoverlapping(text.as_ptr(), text.len()) };
        let bytes = ask();
        // SAFETY: `answer` is the address of so many bytes, which live until the next call.
        String::from_utf8(unsafe { slice::from_raw_parts(answer(), bytes) }.to_vec()).unwrap()
    }

    #[test]
    fn a_question_is_answered_through_addresses_alone() {
        let long = format!("{{\"{}\":1}}", "x".repeat(10_000));
        for refused in [&b""[..], b"{\"ask\":\"magic\"}", b"\xff\xfe", long.as_bytes()] {
            assert!(asked(refused).starts_with("{\"error\":{\"kind\":\"input\""), "{refused:?}");
        }
        let scene = "\"scene\":{\"rate\":[\"1\",\"1\",\"2.5\"],\"speed\":\"3\"}";
        let fly = format!("{{\"ask\":\"fly\",{scene},\"points\":3}}");
        assert!(!asked(fly.as_bytes()).contains("error"), "{}", asked(fly.as_bytes()));
        // SAFETY: a frame has so many numbers, and lives until the next call.
        let frame = unsafe { slice::from_raw_parts(frame(0.0), crate::flight::FRAME) };
        assert_eq!(frame[..7], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        assert!(!numbers().is_null() && !cells().is_null());
    }
}
