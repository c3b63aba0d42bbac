#pragma once
// RS_CHECK: aborts on a programming error, in every build type. What can fail from outside (files, arguments, devices)
// returns a Result instead (result.hpp).

#include <cstdio>
#include <cstdlib>

/// Prints file, line and condition to stderr and aborts where the condition is false.
#define RS_CHECK(condition)                                                                    \
    do {                                                                                       \
        if (!(condition)) [[unlikely]] {                                                       \
            std::fprintf(stderr, "%s:%d: check failed: %s\n", __FILE__, __LINE__, #condition); \
            std::abort();                                                                      \
        }                                                                                      \
    } while (false)
