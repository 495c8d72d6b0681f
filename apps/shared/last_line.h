// The last line of a program that cannot continue: for lack of memory, or after an uncaught exception. It needs no
// memory. Both programs, bihive and bihive-view, end by it.
#pragma once

namespace bihive {

inline constexpr const char* kNoMemory = "not enough memory";

/// Prints "bihive: error: TEXT" without memory: every other way to print may need some. A progress line is cleared.
/// Threads that fail together print it once: all except the first wait for the end.
void say_without_memory(const char* text);

/// The same for lack of memory: kNoMemory, or the text of name_limit_of_memory().
void say_no_memory();

/// Sets the message for lack of memory, at most 199 bytes: it names the limit.
void name_limit_of_memory(const char* text);

/// Makes lack of memory and uncaught exceptions end the program with one line and exit code 1. Before that `before_end`
/// is called, on any thread: it may use no memory. Null: nothing is called. To be called before the shared libraries
/// make their variables, some of which need memory (.preinit_array).
void end_in_one_line(void (*before_end)());

}  // namespace bihive
