// The last line of a program that cannot go on: for lack of memory, or after an exception that nobody catches. It needs
// no memory. Both programs, bihive and bihive-view, end by it.
#pragma once

namespace bihive {

inline constexpr const char* kNoMemory = "not enough memory";

/// Prints "bihive: error: TEXT" without memory: every other way to print may need some. A progress line is cleared.
/// Threads that fail together say it once: all but the first wait for the end.
void say_without_memory(const char* text);

/// The same for lack of memory: kNoMemory, or the text that name_limit_of_memory() gave.
void say_no_memory();

/// What is said when there is no memory, at most 199 bytes: it names the limit.
void name_limit_of_memory(const char* text);

/// From now on, lack of memory and exceptions that nobody catches end the program with one line and exit code 1. Before
/// that `before_end` is called, on any thread: it may use no memory. Null: nothing is called. To be called before the
/// shared libraries make their variables, some of which need memory (.preinit_array).
void end_in_one_line(void (*before_end)());

}  // namespace bihive
