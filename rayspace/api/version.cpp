#include "rayspace/api/version.hpp"

namespace rs::api {

Version version() {
    return {RAYSPACE_VERSION_MAJOR, RAYSPACE_VERSION_MINOR, RAYSPACE_VERSION_PATCH};
}

std::string version_text() {
    const auto [major, minor, patch] = version();
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace rs::api
