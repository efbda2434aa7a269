/* Functions to optimize more than the rest, if the compiler can; clang cannot. */
#pragma once

#ifdef __clang__
#define OPTIMIZE(level)
#else
#define OPTIMIZE(level) __attribute__((optimize(level)))
#endif
