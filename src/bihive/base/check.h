// Programmer's errors: a failed check prints both values and the source line, then aborts.
//
// Bad input is never a CHECK: it is a returned Error (base/result.h).
#pragma once

#include <string>

namespace bihive::detail {

[[noreturn]] void check_failed(const char* file, int line, const std::string& what);

// Not by streams: they bring every locale into the page's module.
template <class A, class B>
[[noreturn]] void check_failed(const char* file, int line, const char* expression, const A& a, const B& b) {
  check_failed(file, line, expression + (" (" + std::to_string(a) + " against " + std::to_string(b)) + ")");
}

}  // namespace bihive::detail

// A file's name without its folders, which are specific to the machine that built the program.
#ifdef __FILE_NAME__
#define BIHIVE_FILE_NAME_ __FILE_NAME__
#else
#define BIHIVE_FILE_NAME_ __FILE__
#endif

#define BIHIVE_CHECK(condition) \
  ((condition) ? void(0) : ::bihive::detail::check_failed(BIHIVE_FILE_NAME_, __LINE__, #condition))
#define BIHIVE_CHECK_OP_(a, op, b)                                                                        \
  do {                                                                                                    \
    const auto& check_a_ = (a);                                                                           \
    const auto& check_b_ = (b);                                                                           \
    if (!(check_a_ op check_b_))                                                                          \
      ::bihive::detail::check_failed(BIHIVE_FILE_NAME_, __LINE__, #a " " #op " " #b, check_a_, check_b_); \
  } while (false)
#define BIHIVE_CHECK_EQ(a, b) BIHIVE_CHECK_OP_(a, ==, b)
#define BIHIVE_CHECK_LE(a, b) BIHIVE_CHECK_OP_(a, <=, b)
#define BIHIVE_CHECK_GE(a, b) BIHIVE_CHECK_OP_(a, >=, b)
