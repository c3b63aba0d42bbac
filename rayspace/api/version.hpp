#pragma once
/// \file
/// Version of the library.

#include <string>

namespace rs::api {

/// Version numbers. Releases with the same major and minor number are binary compatible.
struct Version {
    int major = 0;  ///< changes of the concept
    int minor = 0;  ///< changes of the interface
    int patch = 0;  ///< corrections
};

/// Version of the library that the program is linked with. Thread-safe.
Version version();

/// The same as text, such as "1.2.3". Thread-safe.
std::string version_text();

}  // namespace rs::api
