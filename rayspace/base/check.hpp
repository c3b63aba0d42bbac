#pragma once
// RS_CHECK: aborts the program on a programming error, in every build type. Errors from outside (files, arguments,
// devices) are returned as Result<T>; see result.hpp.

#include <cstdio>
#include <cstdlib>

#define RS_CHECK(condition)                                                                    \
    do {                                                                                       \
        if (!(condition)) [[unlikely]] {                                                       \
            std::fprintf(stderr, "%s:%d: check failed: %s\n", __FILE__, __LINE__, #condition); \
            std::abort();                                                                      \
        }                                                                                      \
    } while (false)
