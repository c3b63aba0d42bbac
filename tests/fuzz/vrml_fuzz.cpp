#include "compositor/scene/vrml_file.hpp"
#include "rayspace/base/check.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/fuzz/scene_checks.hpp"

namespace rs::fuzz {
int fuzz_vrml(const std::uint8_t* data, std::size_t size) {
    const auto scene = compositor::scene_from_vrml({reinterpret_cast<const char*>(data), size}, "input.wrl");
    if (!scene) {
        const std::string& message = scene.error().message;
        RS_CHECK(message.find('\n') == std::string::npos);
        RS_CHECK(message.rfind("input.wrl: ", 0) == 0);
        return 0;
    }
    check_scene(*scene);
    RS_CHECK(!scene->background.sky.empty());
    return 0;
}

}  // namespace rs::fuzz
