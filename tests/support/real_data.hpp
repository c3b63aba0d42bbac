#pragma once
// Test inputs that are not part of the project: $RAYSPACE_DATA, or shared/data beside the checkout.

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace rs::test {

inline std::optional<std::filesystem::path> real_data(const std::filesystem::path& relative) {
    const char* given = std::getenv("RAYSPACE_DATA");
    const std::filesystem::path root = given != nullptr
                                           ? std::filesystem::path(given)
                                           : std::filesystem::path(RAYSPACE_SOURCE_DIR) / ".." / "shared" / "data";
    const std::filesystem::path path = root / relative;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return std::nullopt;
    return path;
}

}  // namespace rs::test

/// Inside a TEST: `const auto path = RS_REAL_DATA_OR_SKIP("meshes/spot");`
#define RS_REAL_DATA_OR_SKIP(relative)                                                                     \
    ({                                                                                                     \
        auto found = ::rs::test::real_data(relative);                                                      \
        if (!found) GTEST_SKIP() << (relative) << " is not here; set RAYSPACE_DATA to have this test run"; \
        *found;                                                                                            \
    })
