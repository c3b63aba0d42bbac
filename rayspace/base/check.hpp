#pragma once
// RS_CHECK: a programmer's error stops the program, in every build type. What can fail from outside (files, arguments,
// devices) returns Result<T> instead; see result.hpp.

#include <cstdio>
#include <cstdlib>

#define RS_CHECK(condition)                                                                    \
    do {                                                                                       \
        if (!(condition)) [[unlikely]] {                                                       \
            std::fprintf(stderr, "%s:%d: check failed: %s\n", __FILE__, __LINE__, #condition); \
            std::abort();                                                                      \
        }                                                                                      \
    } while (false)
