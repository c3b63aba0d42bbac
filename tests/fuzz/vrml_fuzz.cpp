#include "compositor/scene/reader/vrml_file.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/fuzz/scene_checks.hpp"

#include <string>

namespace rs::fuzz {
namespace {

int read_world(std::string_view text) {
    const auto scene = compositor::scene_from_vrml(text, "input.wrl");
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

std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

int fuzz_vrml(const std::uint8_t* data, std::size_t size) {
    return read_world(text_of(data, size));
}

int fuzz_vrml1(const std::uint8_t* data, std::size_t size) {
    return read_world("#VRML V1.0 ascii\n" + std::string(text_of(data, size)));
}

int fuzz_x3d(const std::uint8_t* data, std::size_t size) {
    // All bytes after the first "<" are fuzzer input.
    const std::string_view text = text_of(data, size);
    return read_world("<" + std::string(text.substr(text.starts_with("<") ? 1 : 0)));
}

}  // namespace rs::fuzz
