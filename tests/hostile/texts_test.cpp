// Faulty sets, scenes, recipes, models and photos: read, or rejected with one line.

#include "capture/calibration/known/known_files.hpp"
#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/scene_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/traced/toon_file.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;

template <class T>
std::string one_line(const Result<T>& read) {
    if (read.ok() || read.error().message.find('\n') == std::string::npos) return "";
    return "an error of two lines: " + read.error().message;
}

struct Kind {
    std::string name;  // file name
    std::string text;
    std::function<std::string(const fs::path&)> read;
};

Result<capture::Scene> a_triangle(const std::string& name, const nlohmann::json& /*parameters*/,
                                  std::uint64_t /*seed*/) {
    if (name != "triangle") return Error{"no object is called " + name};
    capture::Scene scene;
    capture::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.materials.emplace_back();
    scene.meshes.push_back(mesh);
    return scene;
}

std::vector<Kind> kinds() {
    Rig rig = make_ring({.count = 4, .fl_px = 60, .width = 48, .height = 40});
    rig.object_radius = 0.9;
    const auto read_scene = [](const fs::path& path) { return one_line(compositor::read_scene(path)); };
    const auto read_mesh = [](const fs::path& path) { return one_line(capture::read_mesh_file(path)); };
    const std::string obj =
        "mtllib model.mtl\no a\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
        "f 1/1/1 2/2/1 3/3/1\nf 1//1 3//1 4//1\ng b\nusemtl blue\nf -1 -2 -3\nl 1 2\n";
    const std::string gltf =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"translation":[0,1,0]},{"camera":0,)"
        R"("rotation":[0,0,0,1],"extras":{"rayspace":{"file":"vase.rso"}}}],"cameras":[{"type":"perspective","perspective":{"yfov":0.7,)"
        R"("znear":0.1}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
        R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],)"
        R"("images":[{"uri":"texture.png"}],"buffers":[{"uri":"data:application/octet-stream;base64,)"
        R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA=","byteLength":44}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
        R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
    return {
        {"transforms.json", rig_to_json(rig), [](const fs::path& path) { return one_line(read_rig(path)); }},
        {"room.json",
         R"({"objects":[{"file":"vase.rso","position":[0,0,-2],"turn_deg":30,"scale":1.5,"standing":true}],"lights":[{"type":"point",)"
         R"("position":[0,3,0],"colour":[1,1,0.9],"intensity":0.8}],"viewpoints":[{"eye":[0,1.6,4],"at":[0,1,0],"fov_deg":50}],)"
         R"("path":[{"time_s":0,"eye":[0,1,4],"at":[0,1,0]},{"time_s":2,"eye":[3,1,4],"at":[0,1,0]}],"background":[0.5,0.6,0.7]})",
         read_scene},
        {"world.wrl",
         "#VRML V2.0 utf8\nDEF A Transform { translation 1 2 3 children [ Shape { appearance Appearance { material "
         "Material { "
         "diffuseColor 1 0 0 } texture ImageTexture { url \"texture.png\" } } geometry Box { size 1 2 3 } } Inline { "
         "url "
         "\"other.wrl\" } USE A ] }\nPointLight { location 0 1 0 }\nShape { geometry IndexedFaceSet { coord Coordinate "
         "{ point [ 0 0 "
         "0, 1 0 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 ] } }\n",
         read_scene},
        {"model.obj", obj, read_scene},
        {"model.obj", obj, read_mesh},
        {"model.mtl",
         "newmtl red\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 30\nillum 2\nmap_Kd texture.png\nnewmtl blue\nKd 0 0 1\nd "
         "0.5\nmap_d -s 2 2 2 "
         "texture.png\n",
         [read_mesh, read_scene, obj](const fs::path& path) {
             const fs::path model = path.parent_path() / "model.obj";
             if (!write_file(model, obj)) return std::string("the disk is full");
             return read_mesh(model) + read_scene(model);
         }},
        {"model.gltf", gltf, read_scene},
        {"model.gltf", gltf, read_mesh},
        {"recipe.json",
         R"({"object":"triangle","parameters":{"size":1.5,"colour":[1,0,0]},"camera":{"views":12,"elevation_deg":20,"distance":3.5},)"
         R"("lights":[{"type":"sun","direction":[0,-1,0],"colour":[1,1,1],"strength":2}],"seed":4})",
         [](const fs::path& path) { return one_line(capture::load_scene_file(path, a_triangle)); }},
        {"recipe.json",
         R"({"object":{"generator":"triangle"},"look":"toon","toon":{"thresholds":[0.9,0.4],"values":[1,0.6,0.2],)"
         R"("edge_radius":0.01,"edge_angle_deg":30,"shadow_rays":4},"camera":{"aperture_radii":0.1,"focus_radii":3}})",
         [](const fs::path& path) { return one_line(capture::load_scene_file(path, a_triangle)); }},
        {"style.json",
         R"({"thresholds":[0.9,0.4],"values":[1,0.6,0.2],"edge_depth":2,"edge_colour":[0.1,0,0],)"
         R"("steps":"colour","edge_test":"depth"})",
         [](const fs::path& path) { return one_line(compositor::read_toon_style(path)); }},
    };
}

TEST(HostileTexts, AreReadOrRefused) {
    const test::TemporaryFolder folder;
    const std::vector<Kind> all = kinds();
    const int trials = test::survive([&](std::uint64_t seed) -> std::string {
        test::Random random(seed);
        const Kind& kind = all[test::below(random, all.size())];
        const fs::path path = folder / kind.name;
        if (!write_file(path, test::mutate_text(kind.text, random))) return "the disk is full";
        const std::string wrong = kind.read(path);
        return wrong.empty() ? "" : kind.name + ": " + wrong;
    });
    EXPECT_GT(trials, 20);
}

TEST(HostilePhotographs, AreReadOrRefused) {
    const test::TemporaryFolder folder;
    Image<Rgba8> image(37, 23);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            image(x, y) = {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 11), 90, 255};
        }
    }
    std::vector<std::pair<std::string, std::vector<std::byte>>> sound;
    const int trials = test::survive([&](std::uint64_t seed) -> std::string {
        if (sound.empty()) {
            if (!write_png(folder / "a.png", image) || !write_jpeg(folder / "b.jpg", image, 90) ||
                !write_exr(folder / "c.exr", Image<RgbaF>(9, 7, {0.5F, 0.2F, 0.1F, 1}))) {
                return "no image can be written";
            }
            for (const char* const name : {"a.png", "b.jpg", "c.exr"}) {
                auto bytes = read_file(folder / name, 1 << 20);
                if (!bytes) return "no image can be read";
                sound.emplace_back(name, std::move(*bytes));
            }
        }
        test::Random random(seed);
        auto [name, bytes] = sound[test::below(random, sound.size())];
        for (std::size_t n = 1 + test::below(random, 3); n > 0; --n) test::mutate_bytes(bytes, random);
        const fs::path path = folder / ("faulty-" + name);
        {
            std::ofstream file(path, std::ios::binary);  // without write_file(), which syncs the disk
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
            if (!file) return "the disk is full";
        }
        return one_line(read_image_info(path)) + one_line(read_image(path)) + one_line(read_image_linear(path));
    });
    EXPECT_GT(trials, 20);
}

}  // namespace
}  // namespace rs
