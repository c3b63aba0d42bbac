// Frame times of a showroom: nine objects of about 256x256 pixels in front of some 10,000 textured triangles with three
// lights, viewed from slightly above. Then the same with 91 more objects behind the viewer. Drawn without a window;
// times include reading back the image.
//
//     bench_frames vase.rso lamp.rso doll.rso
//
// "cpu" is the CPU time per frame, summed over all threads: divided by the number of cores, a lower bound of the frame
// time on an idle machine. Times of parts come from separate runs that wait for each part; their sum exceeds the
// frame time, since the engine and OpenGL normally draw in parallel.

#include "compositor/gl/context.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

namespace rs::bench {
namespace {

using compositor::GeometryNode;
using compositor::Material;
using compositor::Mesh;
using compositor::PlacedObject;
using compositor::Scene;
using compositor::Similarity;

constexpr int kVisible = 9;
constexpr int kHidden = 91;
constexpr double kObjectRadius = 0.272;  // images of 256x256 px on a screen of 1280x720

// Smooth procedural texture of a base colour, 512x512.
std::shared_ptr<const compositor::SceneTexture> stained(const glm::vec3& colour, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> phase(0, 6.28F);
    const float a = phase(random);
    const float b = phase(random);
    auto texture = std::make_shared<compositor::SceneTexture>();
    texture->image = Image<Rgba8>(512, 512);
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            const auto u = static_cast<float>(x) * 0.0123F;
            const auto v = static_cast<float>(y) * 0.0123F;
            const float stain = 0.85F + 0.15F * std::sin(3 * u + a + 2 * std::sin(2 * v)) * std::sin(5 * v + b);
            const auto byte = [&](float c) { return static_cast<std::uint8_t>(std::lround(c * stain * 255)); };
            texture->image(x, y) = {byte(colour.r), byte(colour.g), byte(colour.b), 255};
        }
    }
    return texture;
}

// Unit square in the plane z = 0, facing +Z.
std::shared_ptr<const Mesh> square() {
    auto mesh = std::make_shared<Mesh>();
    for (const glm::vec2 at : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        mesh->vertices.push_back({glm::vec3(at - 0.5F, 0), {0, 0, 1}, at * 4.0F});
    }
    mesh->indices = {0, 1, 2, 0, 2, 3};
    mesh->two_sided = false;
    return mesh;
}

// Unit sphere of 2 * columns * (rows - 1) triangles.
std::shared_ptr<const Mesh> ball(int columns, int rows) {
    auto mesh = std::make_shared<Mesh>();
    mesh->two_sided = false;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const double polar = kPi * j / rows;
            const double around = 2 * kPi * i / columns;
            const glm::vec3 p(std::sin(polar) * std::cos(around), std::cos(polar), -std::sin(polar) * std::sin(around));
            mesh->vertices.push_back({p, p, {static_cast<float>(i) / 8, static_cast<float>(rows - j) / 8}});
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            if (j > 0) mesh->indices.insert(mesh->indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j)});
            if (j + 1 < rows) mesh->indices.insert(mesh->indices.end(), {at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    }
    return mesh;
}

glm::dmat4 placed(const glm::dvec3& at, const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& back) {
    return {glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(at, 1)};
}

// Room of 8 x 3 x 8 scene units with three lights, two shelves along the back wall and balls on them.
Scene room() {
    Scene scene;
    scene.lights = {
        {.colour = glm::vec3(0.6F), .ambient = glm::vec3(0.3F), .towards = glm::normalize(glm::dvec3(-1, -3, -2))},
        {.colour = glm::vec3(0.3F), .towards = glm::normalize(glm::dvec3(2, -1, -1))},
        {.kind = LightKind::kPoint, .colour = glm::vec3(0.5F), .location = {0, 2.6, 0.5}}};
    const auto add = [&](const std::shared_ptr<const Mesh>& mesh, const glm::dmat4& where, const Material& material) {
        scene.geometry.push_back({mesh, material, where, {}});
    };
    const auto face = square();
    const auto painted = [](const glm::vec3& colour, unsigned seed) {
        return Material{.specular = glm::vec3(0.05F), .ambient = 1, .texture = stained(colour, seed), .normals = {}};
    };
    const Material wall = painted({0.85F, 0.82F, 0.75F}, 1);
    add(face, placed({0, 1.5, -4}, {8, 0, 0}, {0, 3, 0}, {0, 0, 1}), wall);
    add(face, placed({-4, 1.5, 0}, {0, 0, -8}, {0, 3, 0}, {1, 0, 0}), wall);
    add(face, placed({4, 1.5, 0}, {0, 0, 8}, {0, 3, 0}, {-1, 0, 0}), wall);
    add(face, placed({0, 0, 0}, {8, 0, 0}, {0, 0, -8}, {0, 1, 0}), painted({0.5F, 0.35F, 0.25F}, 2));
    add(face, placed({0, 3, 0}, {8, 0, 0}, {0, 0, 8}, {0, -1, 0}), painted({0.9F, 0.9F, 0.9F}, 3));
    auto board = std::make_shared<Mesh>(compositor::box_mesh({6, 0.06, 0.9}));
    board->two_sided = false;
    const Material wood = painted({0.45F, 0.3F, 0.2F}, 4);
    for (const double height : {0.6, 1.6}) add(board, placed({0, height, -3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), wood);
    const auto bead = ball(24, 12);  // 528 triangles
    for (int n = 0; n < 19; ++n) {
        const glm::dvec3 at(-2.7 + 0.3 * n, n % 2 == 0 ? 1.72 : 0.72, -3.3);
        add(bead, placed(at, {0.09, 0, 0}, {0, 0.09, 0}, {0, 0, 0.09}), painted({0.3F, 0.5F, 0.6F}, 5));
    }
    return scene;
}

Similarity standing(double x, double y, double z, double turn_rad, double scale) {
    return compositor::world_from_node({{{x, y, z}, {0, 1, 0}, turn_rad, scale}});
}

std::vector<PlacedObject> placed_objects(const std::vector<std::shared_ptr<const compositor::ViewableObject>>& objects,
                                         int unseen) {
    std::vector<PlacedObject> placed;
    const auto next = [&] { return objects[placed.size() % objects.size()]; };
    for (int n = 0; n < kVisible; ++n) {
        const bool upper = n < 5;
        const double x = upper ? (n - 2) * 0.84 : (n - 6.5) * 0.84;
        placed.push_back({next(), standing(x, (upper ? 1.63 : 0.63) + kObjectRadius, -2.9, 0.7 * n, kObjectRadius)});
    }
    for (int n = 0; n < unseen; ++n) {
        placed.push_back({next(), standing(n % 10 - 4.5, 1, 6 + n / 10, 0.3 * n, kObjectRadius)});
    }
    return placed;
}

struct Options {
    std::vector<std::string> files;
    int frames = 60;
    std::string size = "1280x720";
    int width = 0;
    int height = 0;
    int object_samples = compositor::kDefaultSamplesAcross;
    bool direct = false;
};

struct Times {
    double frame_ms = 0;
    double cpu_ms = 0;
    double geometry_ms = 0;
    double engine_ms = 0;
    double upload_ms = 0;
    double composite_ms = 0;
    double side_px = 0;  // side of a square with the engine's mean pixel count per object
    int nodes = 0;
};

Result<Times> timed(const Scene& scene, const std::vector<PlacedObject>& objects, const Options& options, int samples,
                    bool parts) {
    auto frames = compositor::FrameCompositor::create(scene, objects,
                                                      {.width = options.width,
                                                       .height = options.height,
                                                       .samples = samples,
                                                       .object_samples = options.object_samples,
                                                       .upright_images = !options.direct,
                                                       .time_parts = parts});
    if (!frames) return frames.error();
    std::vector<double> frame, cpu, geometry, engine, upload, composite;
    Times times;
    for (int n = -3; n < options.frames; ++n) {  // three to warm up
        const double sway = 0.15 * std::sin(0.2 * n);
        const Camera camera =
            look_at_camera({sway, 1.75, 1.9}, {0.5 * sway, 1.5, -3}, radians(50), options.width, options.height);
        const Stopwatch watch;
        if (const Status status = frames->draw(camera); !status) return status.error();
        if (frames->image().empty()) return Error{"an empty image was read back"};
        if (n < 0) continue;
        frame.push_back(watch.wall_ms());
        cpu.push_back(watch.cpu_ms());
        const compositor::FrameStatistics& s = frames->statistics();
        geometry.push_back(1e3 * s.geometry_s);
        engine.push_back(1e3 * s.engine_s);
        upload.push_back(1e3 * s.upload_s);
        composite.push_back(1e3 * s.composite_s);
        times.nodes = s.nodes_rendered;
        times.side_px = std::sqrt(static_cast<double>(s.pixels_rendered) / std::max(s.nodes_rendered, 1));
    }
    times.frame_ms = median(frame);
    times.cpu_ms = median(cpu);
    times.geometry_ms = median(geometry);
    times.engine_ms = median(engine);
    times.upload_ms = median(upload);
    times.composite_ms = median(composite);
    return times;
}

Status run(Options options) {
    const Result<PixelSize> size = parse_size(options.size);
    if (!size) return size.error();
    options.width = size->width;
    options.height = size->height;
    auto context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    std::vector<std::shared_ptr<const compositor::ViewableObject>> objects;
    for (const std::string& file : options.files) {
        Result<RaySpaceObject> object = read_object(file);
        if (!object) return object.error();
        object->coded.reset();  // decoded already, as in the viewer
        auto viewable = compositor::make_viewable(std::move(*object));
        if (!viewable) return viewable.error();
        objects.push_back(std::make_shared<const compositor::ViewableObject>(std::move(*viewable)));
    }
    const Scene scene = room();
    std::size_t triangles = 0;
    for (const GeometryNode& node : scene.geometry) triangles += node.mesh->indices.size() / 3;
    std::printf("%s, %dx%d, %zu triangles, %d frames each, medians in ms\n", context->device_name().c_str(),
                options.width, options.height, triangles, options.frames);
    std::printf("samples objects  seen  image      frame     fps     cpu  | geometry  engine  upload  composite\n");
    for (const int samples : {1, 4}) {
        for (const int unseen : {0, kHidden}) {
            const std::vector<PlacedObject> placed = placed_objects(objects, unseen);
            const Result<Times> whole = timed(scene, placed, options, samples, false);
            if (!whole) return whole.error();
            const Result<Times> parts = timed(scene, placed, options, samples, true);
            if (!parts) return parts.error();
            std::printf("%7d %7zu %5d  %4.0f^2 %12.1f %7.1f %7.1f  | %8.1f %7.1f %7.1f %10.1f\n", samples,
                        placed.size(), whole->nodes, whole->side_px, whole->frame_ms, 1e3 / whole->frame_ms,
                        whole->cpu_ms, parts->geometry_ms, parts->engine_ms, parts->upload_ms, parts->composite_ms);
        }
    }
    return {};
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    rs::bench::Options options;
    CLI::App app("Frame times: nine objects in front of 10,000 triangles, then with 91 more behind the viewer.",
                 "bench_frames");
    app.add_option("OBJECT", options.files, ".rso files, used in turn")->required();
    app.add_option("--frames", options.frames, "frames per row of the table")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    app.add_option("--size", options.size, "frame size, WxH")->capture_default_str();
    app.add_option("--object-samples", options.object_samples, "maximum samples across a pixel for distant objects")
        ->capture_default_str()
        ->check(CLI::Range(1, rs::compositor::kMaxSamplesAcross));
    app.add_flag("--direct", options.direct, "render objects with tilted cameras");
    app.footer("Example:\n  bench_frames vase.rso lamp.rso doll.rso");
    std::function<rs::Status()> run = [&] { return rs::bench::run(options); };
    return rs::tool_main(app, argc, argv, run);
}
