#pragma once
// Test files of mesh formats.

#include "capture/tracer/scene/mesh_file.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace rs::capture::test {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// 2x2: red at the top left, everything else blue.
inline void write_texture(const std::filesystem::path& path) {
    Image<Rgba8> image(2, 2, {0, 0, 255, 255});
    image(0, 0) = {255, 0, 0, 255};
    const Status written = write_png(path, image.view());
    ASSERT_TRUE(written) << written.error().message;
}

inline std::string error_of(const std::filesystem::path& path) {
    const Result<Scene> scene = read_mesh_file(path);
    if (scene) return "read without an error";
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << "errors are one line";
    return scene.error().message;
}

}  // namespace rs::capture::test
