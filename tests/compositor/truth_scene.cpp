#include "tests/compositor/truth_scene.hpp"

#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/session/capture_set.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "datasets-synthetic/objects.hpp"
#include "encode/build.hpp"
#include "encode/encode_images.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

namespace rs::test {
namespace {

constexpr double kFieldOfView_rad = radians(60);

// Lengths in metres; the visitor enters from +Z. Lights of every kind, and emissive surfaces.
constexpr const char* kRoom = R"(#VRML V2.0 utf8
NavigationInfo { headlight FALSE }
Background { skyColor 0.75 0.78 0.82 }
DirectionalLight { direction -0.4 -0.8 -0.5 intensity 0.55 ambientIntensity 0.5 color 1 0.97 0.92 }
PointLight { location 1.6 2.4 1.2 intensity 0.5 color 0.9 0.95 1 attenuation 1 0.1 0.05 radius 20 }
SpotLight { location -1.3 2.9 0.4 direction 0 -1 -0.25 intensity 0.6 beamWidth 0.35 cutOffAngle 0.6 radius 20 }

DEF Stone Shape {
  appearance Appearance {
    material Material { ambientIntensity 0.6 }
    texture ImageTexture { url "floor.png" }
    textureTransform TextureTransform { scale 6 6 }
  }
  geometry IndexedFaceSet {
    coord Coordinate { point [ -4 0 4, 4 0 4, 4 0 -3, -4 0 -3 ] }
    texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] }
    coordIndex [ 0 1 2 3 -1 ]
  }
}
Transform { translation 0 1.5 -2.05 children Shape {
  appearance Appearance {
    material Material { ambientIntensity 0.6 }
    texture ImageTexture { url "wall.png" }
    textureTransform TextureTransform { scale 4 1.5 }
  }
  geometry Box { size 8 3 0.1 }
} }
DEF Plaster Transform { translation -3 1.5 0.5 children Shape {
  appearance Appearance { material Material { diffuseColor 0.72 0.7 0.66 ambientIntensity 0.6 } }
  geometry Box { size 0.1 3 7 }
} }

# table
Transform { translation -1.3 0.87 -0.4 children DEF Board Shape {
  appearance DEF Wood Appearance {
    material Material { ambientIntensity 0.6 specularColor 0.2 0.2 0.2 shininess 0.3 }
    texture ImageTexture { url "wood.png" }
  }
  geometry Box { size 1 0.06 0.7 }
} }
Transform { translation -1.7 0.42 -0.15 children DEF Leg Shape {
  appearance DEF Dark Appearance { material Material { diffuseColor 0.3 0.2 0.14 ambientIntensity 0.6 } }
  geometry Box { size 0.06 0.84 0.06 }
} }
Transform { translation -0.9 0.42 -0.15 children USE Leg }
Transform { translation -1.7 0.42 -0.65 children USE Leg }
Transform { translation -0.9 0.42 -0.65 children USE Leg }

# shelf
Transform { translation 0.4 0.98 -1.45 children DEF Shelf Shape {
  appearance USE Wood
  geometry Box { size 1.4 0.04 0.5 }
} }
Transform { translation 0.4 1.72 -1.45 children USE Shelf }
Transform { translation -0.32 1 -1.45 children DEF Side Shape { appearance USE Wood geometry Box { size 0.04 2 0.5 } } }
Transform { translation 0.42 0.85 -1.22 children Shape { appearance USE Dark geometry Box { size 0.03 1.74 0.03 } } }
Transform { translation 1.12 1 -1.45 children USE Side }

# plinth and the screen before it
Transform { translation 1.75 0.5 -0.2 children Shape {
  appearance Appearance { material Material { diffuseColor 0.85 0.85 0.83 ambientIntensity 0.6 } }
  geometry Box { size 0.45 1 0.45 }
} }
Transform { translation 1.55 0.6 0.5 children Shape {
  appearance Appearance {
    material Material { diffuseColor 0.25 0.4 0.5 emissiveColor 0.03 0.05 0.06 ambientIntensity 0.6 }
  }
  geometry Box { size 0.8 1.2 0.04 }
} }

# pillars
Transform { translation -0.85 1.5 0.55 children Shape {
  appearance Appearance {
    material Material { diffuseColor 0.8 0.75 0.6 specularColor 0.5 0.5 0.5 shininess 0.4 ambientIntensity 0.6 }
  }
  geometry Cylinder { radius 0.07 height 3 }
} }
Transform { translation 0.75 1.25 -0.1 rotation 0 1 0 0.5 children Shape {
  appearance Appearance { material Material { diffuseColor 0.55 0.2 0.18 ambientIntensity 0.6 } }
  geometry Box { size 0.09 2.5 0.09 }
} }

Transform { translation -1.3 0.9 -0.4 rotation 0 1 0 0.6 children RaySpace { url "vase.rso" size 0.2 } }
Transform { translation 0.02 1 -1.42 rotation 0 1 0 -0.4 children RaySpace { url "blocks.rso" size 0.2 } }
Transform { translation 0.78 1 -1.42 rotation 0 1 0 0.3 children RaySpace { url "doll.rso" size 0.22 } }
Transform { translation 1.75 1 -0.2 rotation 0 1 0 2.6 children RaySpace { url "blocks.rso" size 0.2 } }
)";

std::uint8_t code(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// Smooth periodic patterns, so that cameras and light are measured instead of texture filtering.
Image<Rgba8> waves(const glm::dvec3& colour, double across, double along) {
    constexpr int kSide = 256;
    Image<Rgba8> image(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double s = 2 * kPi * x / kSide;
            const double t = 2 * kPi * y / kSide;
            const double v = 1 + 0.16 * std::sin(across * s + std::sin(2 * t)) * std::cos(along * t) +
                             0.08 * std::sin(3 * across * s + 2 * along * t);
            image(x, y) = {code(colour.r * v), code(colour.g * v), code(colour.b * v), 255};
        }
    }
    return image;
}

// Tiles with joints.
Image<Rgba8> tiles() {
    Image<Rgba8> image = waves({168, 160, 148}, 3, 2);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if ((x < 128) != (y < 128)) continue;
            Rgba8& pixel = image(x, y);
            pixel = {code(pixel.r * 0.8), code(pixel.g * 0.78), code(pixel.b * 0.76), 255};
        }
    }
    return image;
}

}  // namespace

std::vector<std::string> truth_object_names() {
    return {"vase", "blocks", "doll"};
}

Result<compositor::Scene> write_truth_room(const std::filesystem::path& folder) {
    for (const auto& [file, image] : {std::pair{"floor.png", tiles()},
                                      {"wall.png", waves({196, 200, 188}, 6, 1)},
                                      {"wood.png", waves({176, 128, 82}, 1, 7)}}) {
        if (Status written = write_png(folder / file, image); !written) return written.error();
    }
    std::ofstream(folder / "room.wrl") << kRoom;
    return compositor::read_scene(folder / "room.wrl");
}

std::vector<TruthViewpoint> truth_walk(int width, int height) {
    struct Stop {
        const char* what;
        glm::dvec3 eye;
        glm::dvec3 at;
    };
    const Stop stops[] = {
        {"the whole room", {0.2, 1.6, 2.9}, {0.15, 1.15, -1}},
        {"towards the table", {-0.9, 1.6, 1.7}, {-1.1, 1.15, -0.4}},
        {"at the table", {-1.55, 1.35, 0.45}, {-1.25, 1.15, -0.4}},
        {"past the pillar", {-0.95, 1.5, 1.25}, {-0.1, 1.2, -1.3}},
        {"at the shelf", {0.25, 1.45, -0.45}, {0.4, 1.2, -1.4}},
        {"past the post", {0.7, 1.55, 0.9}, {0.75, 1.2, -1}},
        {"over the screen", {1.45, 1.7, 1.4}, {1.65, 1.2, -0.2}},
        {"a child's height", {2.3, 1.15, 1}, {1.4, 1.15, -0.6}},
    };
    std::vector<TruthViewpoint> walk;
    for (const Stop& stop : stops) {
        walk.push_back({stop.what, look_at_camera(stop.eye, stop.at, kFieldOfView_rad, width, height)});
    }
    return walk;
}

Result<capture::SceneFile> object_of_recipe(const std::string& name) {
    return capture::load_scene_file(
        std::filesystem::path(RAYSPACE_SOURCE_DIR) / "datasets-synthetic" / "recipes" / (name + ".json"),
        synthetic::generate);
}

Result<std::vector<compositor::PlacedObject>> read_placed_objects(const compositor::Scene& scene) {
    std::vector<compositor::PlacedObject> placed;
    for (const compositor::RaySpaceNode& node : scene.objects) {
        Result<RaySpaceObject> object = read_object(node.file);
        if (!object) return object.error();
        Result<compositor::ViewableObject> viewable = compositor::make_viewable(std::move(*object));
        if (!viewable) return viewable.error();
        placed.push_back(
            compositor::place(std::make_shared<const compositor::ViewableObject>(std::move(*viewable)), node));
    }
    return placed;
}

Result<std::shared_ptr<const TracedObject>> traced_object(capture::SceneFile object) {
    return TracedObject::create(std::move(object.scene), object.object_radius);
}

Status write_captured_object(const std::string& name, capture::SceneFile object, const TruthCapture& capture,
                             const std::filesystem::path& folder, Progress* progress) {
    Rig rig;
    for (const double elevation_deg : capture.elevations_deg) {
        RingOptions ring;
        ring.count = capture.views;
        ring.distance = object.camera.distance_radii;
        ring.elevation_rad = radians(elevation_deg);
        ring.look_at_height = object.camera.look_at_height;
        ring.width = capture.side_px;
        ring.height = capture.side_px;
        ring.fl_px = object.camera.focal_widths * capture.side_px;
        const Rig views = make_ring(ring);
        rig.views.insert(rig.views.end(), views.views.begin(), views.views.end());
    }
    rig.object_radius = object.object_radius;
    rig.foot_height = object.ground_height;
    capture::CaptureSetOptions options;
    options.render.samples_per_pixel = capture.samples;
    options.render.seed = object.seed;
    const Result<capture::Tracer> tracer = capture::Tracer::create(std::move(object.scene));
    if (!tracer) return tracer.error();
    const std::filesystem::path set_folder = folder / (name + "-set");
    const auto captured = capture::write_capture_set(*tracer, rig, options, set_folder, progress);
    if (!captured) return captured.error();

    Result<encode::CaptureSet> set = encode::open_capture_set(set_folder, progress);
    if (!set) return set.error();
    encode::BuildOptions build;
    build.map = encode::default_plane_map(build.raymap);
    build.name = name;
    build.raw_images = false;
    Result<encode::BuiltObject> built = encode::build_object(*set, build, progress);
    if (!built) return built.error();
    set->completed = std::move(built->completed);
    Result<encode::EncodedImages> encoded =
        encode::encode_images(*set, built->object, encode::ImageGoal{}, encode::DenseSettings{}.alpha_bits, progress);
    if (!encoded) return encoded.error();
    built->object.coded = std::make_shared<codec::CodedImages>(std::move(encoded->coded));
    return write_object(folder / (name + ".rso"), built->object, progress);
}

}  // namespace rs::test
