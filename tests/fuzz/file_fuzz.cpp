// Entries of parsers that take file names: the bytes are written to a folder of the process.
#include "capture/tracer/scene/mesh_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/video_reader.hpp"
#include "tests/fuzz/entries.hpp"
#include "tests/fuzz/scene_checks.hpp"
#include "tests/support/temporary_folder.hpp"

#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

namespace rs::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kModel =
    "mtllib model.mtl\no a\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
    "f 1/1/1 2/2/1 3/3/1\nusemtl blue\nf 1//1 3//1 4//1\n";
constexpr std::string_view kMaterials = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";

fs::path put(const char* name, std::string_view bytes) {
    static const test::TemporaryFolder folder;
    const fs::path path = folder / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string_view text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

template <class T>
bool accepted(const Result<T>& read) {
    RS_CHECK(read.ok() || read.error().message.find('\n') == std::string::npos);
    return read.ok();
}

void read_object(const fs::path& path) {
    const auto object = capture::read_mesh_file(path);
    if (!accepted(object)) return;
    for (const capture::Mesh& mesh : object->meshes) {
        for (const glm::vec3& p : mesh.positions)
            RS_CHECK(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        for (const glm::uvec3& corner : mesh.triangles) {
            RS_CHECK(corner.x < mesh.positions.size() && corner.y < mesh.positions.size() &&
                     corner.z < mesh.positions.size());
        }
    }
}

// Reads a model as a room, and as an object to be captured.
void read_model(const fs::path& path) {
    if (const auto scene = compositor::read_scene(path); accepted(scene)) check_scene(*scene);
    read_object(path);
}

}  // namespace

int fuzz_ply(const std::uint8_t* data, std::size_t size) {
    read_model(put("object.ply", text(data, size)));
    return 0;
}

int fuzz_gltf(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes = text(data, size);
    read_model(put(bytes.starts_with("glTF") ? "model.glb" : "model.gltf", bytes));
    return 0;
}

int fuzz_obj(const std::uint8_t* data, std::size_t size) {
    put("model.mtl", kMaterials);
    read_model(put("model.obj", text(data, size)));
    return 0;
}

int fuzz_mtl(const std::uint8_t* data, std::size_t size) {
    put("model.mtl", text(data, size));
    read_model(put("model.obj", kModel));
    return 0;
}

int fuzz_image(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes = text(data, size);
    const fs::path path = put(bytes.starts_with("\xFF\xD8") ? "picture.jpg" : "picture.png", bytes);
    const auto info = read_image_info(path);
    const auto image = read_image(path);
    const bool known = accepted(info);
    if (accepted(image)) RS_CHECK(known && image->width() == info->width && image->height() == info->height);
    return 0;
}

int fuzz_film(const std::uint8_t* data, std::size_t size) {
    const fs::path path = put("film.mp4", text(data, size));
    Result<VideoReader> reader = VideoReader::open(path);
    if (!accepted(reader)) return 0;
    const VideoInfo info = reader->info();
    RS_CHECK(info.width >= 1 && info.width <= kMaxImageSide_px && info.height >= 1);
    RS_CHECK(info.height <= kMaxImageSide_px && info.orientation >= 1 && info.orientation <= 8);
    constexpr std::int64_t kMostPixels = 1 << 20;  // limits an input to one second and 100 MB
    if (std::int64_t{info.width} * info.height > kMostPixels) return 0;
    Image<Rgba8> frame;
    for (int i = 0; i < 16; ++i) {
        const Result<bool> has_frame = reader->read(frame);
        if (!accepted(has_frame) || !*has_frame) break;
        RS_CHECK(frame.width() == info.width && frame.height() == info.height);
    }
    return 0;
}

}  // namespace rs::fuzz
