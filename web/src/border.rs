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
