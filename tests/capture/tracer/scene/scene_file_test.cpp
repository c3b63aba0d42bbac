// Recipes: all keys, strict validation, normalisation.

#include "capture/tracer/scene/scene_file.hpp"
#include "capture/tracer/scene/scene_transform.hpp"
#include "capture/tracer/scene/studio.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace rs::capture::test {
namespace {

using rs::test::TemporaryFolder;
using testing::HasSubstr;

class SceneFileTest : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(folder_ / "quad.obj") << "v 2 0 0\nv 6 0 0\nv 6 2 0\nv 2 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                               "f 1/1 2/2 3/3 4/4\n";
        std::ofstream(folder_ / "bare.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        const Image<Rgba8> red(2, 2, {255, 0, 0, 255});
        ASSERT_TRUE(write_png(folder_ / "red.png", red.view()));
        ASSERT_TRUE(write_exr(folder_ / "sky.exr", Image<RgbaF>(4, 2, {2, 3, 4, 1}).view()));
    }

    Result<SceneFile> load(const std::string& recipe, const Generator& generator = {}) {
        std::ofstream(folder_ / "r.json") << recipe;
        return load_scene_file(folder_ / "r.json", generator);
    }
    std::string error(const std::string& recipe, const Generator& generator = {}) {
        const Result<SceneFile> file = load(recipe, generator);
        if (file) return "read without an error";
        EXPECT_EQ(file.error().message.find('\n'), std::string::npos) << "errors are one line";
        EXPECT_THAT(file.error().message, HasSubstr("r.json"));
        return file.error().message;
    }

    TemporaryFolder folder_;
};

TEST_F(SceneFileTest, MeshAloneGetsStudioAndDefaultCamera) {
    const Result<SceneFile> file = load_scene_file(folder_ / "bare.obj", {});
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->camera.views, 90);
    EXPECT_EQ(file->camera.samples_per_pixel, 64);
    EXPECT_EQ(file->camera.distance_radii, 3.5);
    EXPECT_FALSE(file->scene.environment.pixels.empty());
    EXPECT_EQ(file->scene.name, "bare");
}

TEST_F(SceneFileTest, KeepsTheMeshesOriginOnTheAxisWhereAsked) {
    const Result<SceneFile> file = load(R"({"object": {"mesh": "quad.obj", "centre": "origin"}})");
    ASSERT_TRUE(file) << file.error().message;
    // The farthest vertex, (6, 2, 0), is scaled to distance 1 from the mesh's own origin.
    const glm::vec3 farthest = file->scene.meshes[0].positions[2];
    EXPECT_NEAR(farthest.x, 6 / std::sqrt(40.0), 1e-6);
    EXPECT_NEAR(farthest.y, 2 / std::sqrt(40.0), 1e-6);
    EXPECT_NEAR(file->object_radius, 6 / std::sqrt(40.0), 1e-6);
    EXPECT_THAT(error(R"({"object": {"mesh": "quad.obj", "centre": "middle"}})"), HasSubstr("object.centre"));
}

TEST_F(SceneFileTest, NormalisesToTheBoundingSphere) {
    const Result<SceneFile> file = load_scene_file(folder_ / "quad.obj", {});
    ASSERT_TRUE(file) << file.error().message;
    glm::vec3 lower(10);
    glm::vec3 upper(-10);
    float radius = 0;
    for (const glm::vec3& p : file->scene.meshes[0].positions) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
        radius = std::max(radius, glm::length(p));
    }
    EXPECT_NEAR(radius, 1.0F, 1e-6F);
    EXPECT_LT(glm::length(lower + upper), 1e-6F);
    EXPECT_NEAR(file->object_radius, 2 / std::sqrt(5.0), 1e-6);  // a 4 by 2 quad: half diagonal sqrt(5), half width 2
    EXPECT_NEAR(file->ground_height, lower.y, 1e-6);
}

TEST_F(SceneFileTest, ReadsEveryKey) {
    const Result<SceneFile> file = load(R"({
        "name": "thing", "seed": 7,
        "object": {"mesh": "quad.obj", "texture": "red.png", "material": {"kind": "glossy", "roughness": 0.2}},
        "materials": {"DefaultMaterial": {"ior": 1.4, "colour": [0.5, 0.6, 0.7], "emission": 2, "two_sided": false,
                                          "translucency": 0.25}},
        "camera": {"distance_radii": 4, "focal_widths": 1.5, "elevation_deg": 10, "look_at_height": 0.1, "views": 12,
                   "width": 100, "height": 80, "spp": 8},
        "environment": {"file": "sky.exr", "scale": 0.5, "turn_deg": 90},
        "lights": [{"type": "directional", "direction": [0, -1, 1], "irradiance": 3},
                   {"type": "point", "position": [1, 2, 3], "intensity": [1, 2, 3]},
                   {"type": "rectangle", "corner": [0, 2, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "radiance": 5}]
    })");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->scene.name, "thing");
    EXPECT_EQ(file->seed, 7U);
    const Material& material = file->scene.materials[static_cast<std::size_t>(file->scene.meshes[0].material)];
    EXPECT_EQ(material.kind, SurfaceKind::glossy);
    EXPECT_EQ(material.roughness, 0.2F);
    EXPECT_EQ(material.ior, 1.4F);
    EXPECT_EQ(material.colour, glm::vec3(0.5F, 0.6F, 0.7F));
    EXPECT_EQ(material.emission, glm::vec3(2.0F));
    EXPECT_FALSE(material.two_sided);
    EXPECT_EQ(material.translucency, 0.25F);
    ASSERT_GE(material.texture, 0);
    EXPECT_EQ(file->scene.textures[static_cast<std::size_t>(material.texture)].pixels(1, 1), (RgbaF{1, 0, 0, 1}));
    EXPECT_EQ(file->camera.distance_radii, 4);
    EXPECT_EQ(file->camera.focal_widths, 1.5);
    EXPECT_EQ(file->camera.elevation_deg, 10);
    EXPECT_EQ(file->camera.look_at_height, 0.1);
    EXPECT_EQ(file->camera.views, 12);
    EXPECT_EQ(file->camera.width, 100);
    EXPECT_EQ(file->camera.height, 80);
    EXPECT_EQ(file->camera.samples_per_pixel, 8);
    EXPECT_EQ(file->scene.environment.pixels(0, 0).g, 3.0F);
    EXPECT_EQ(file->scene.environment.scale, 0.5F);
    EXPECT_NEAR(file->scene.environment.turn_rad, kPi / 2, 1e-6);
    const std::vector<Light>& lights = file->scene.lights;
    ASSERT_EQ(lights.size(), 3U);
    EXPECT_EQ(lights[0].kind, LightKind::kDirectional);
    EXPECT_NEAR(irradiance_at(lights[0], {}).r, 3, 1e-6);
    EXPECT_EQ(lights[1].kind, LightKind::kPoint);
    EXPECT_NEAR(irradiance_at(lights[1], lights[1].location + glm::dvec3(0, 2, 0)).b, 3.0 / 4, 1e-6);
    EXPECT_EQ(lights[2].kind, LightKind::kRectangle);
    EXPECT_EQ(lights[2].colour, glm::vec3(5.0F));
}

TEST_F(SceneFileTest, StudioAndConstantEnvironmentsNeedNoFile) {
    const Result<SceneFile> constant =
        load(R"({"object": {"mesh": "bare.obj"}, "environment": {"constant": [1, 2, 3]}})");
    ASSERT_TRUE(constant) << constant.error().message;
    EXPECT_EQ(constant->scene.environment.pixels(0, 0), (RgbaF{1, 2, 3, 1}));
    const Result<SceneFile> studio = load(R"({"object": {"mesh": "bare.obj"}, "environment": {"studio": {
        "zenith": 0, "horizon": 0, "floor": 0,
        "softboxes": [{"azimuth_deg": 90, "elevation_deg": 0, "width_deg": 20, "height_deg": 20, "radiance": [7, 0, 0]}]}}})");
    ASSERT_TRUE(studio) << studio.error().message;
    const Image<RgbaF>& pixels = studio->scene.environment.pixels;
    EXPECT_NEAR(pixels(pixels.width() * 3 / 4, pixels.height() / 2).r, 7.0F, 1e-4F) << "azimuth 90 is +X";
    EXPECT_EQ(pixels(pixels.width() / 4, pixels.height() / 2).r, 0.0F);
    EXPECT_EQ(pixels(pixels.width() * 3 / 4, 2).r, 0.0F);
}

TEST_F(SceneFileTest, GeneratorGetsNameParametersAndSeed) {
    std::string seen;
    const Generator generator = [&](const std::string& name, const nlohmann::json& parameters,
                                    std::uint64_t seed) -> Result<Scene> {
        seen = name + parameters.dump() + std::to_string(seed);
        if (name == "nothing") return Error{"there is no object \"nothing\""};
        return scene_of(make_sphere(1), material_of(SurfaceKind::diffuse));
    };
    const Result<SceneFile> file = load(
        R"({"seed": 5, "object": {"generator": "ball", "parameters": {"size": 2}}, "materials": {"test": {"kind": "mirror"}}})",
        generator);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(seen, "ball{\"size\":2}5");
    EXPECT_EQ(file->scene.materials[0].kind, SurfaceKind::mirror);
    EXPECT_THAT(error(R"({"object": {"generator": "nothing"}})", generator),
                HasSubstr("there is no object \"nothing\""));
    EXPECT_THAT(error(R"({"object": {"generator": "ball"}})"),
                HasSubstr("object.generator: generators are not available"));
}

TEST_F(SceneFileTest, ARoomStandsAroundTheObject) {
    std::ofstream(folder_ / "room.mtl") << "newmtl lamp\nKd 0 0 0\nKe 2 2 2\n";
    std::ofstream(folder_ / "room.obj") << "mtllib room.mtl\nusemtl lamp\nv 10 3 4\nv 12 3 4\nv 10 3 6\nf 1 2 3\n";
    // The quad is 4 x 2, so its radius is sqrt(20) / 2; it is placed by the foot of its centre.
    const Result<SceneFile> file = load(R"({"object": {"mesh": "quad.obj", "texture": "red.png"},
        "room": {"file": "room.obj", "at": [10, 1, 4], "turn_deg": 90, "radius": 2}})");
    ASSERT_TRUE(file) << file.error().message;
    const Scene& scene = file->scene;
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_TRUE(scene.has_surroundings());
    EXPECT_FALSE(scene.surrounds(scene.meshes[0].material));
    EXPECT_TRUE(scene.surrounds(scene.meshes[1].material));
    EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.meshes[1].material)].emission, glm::vec3(2));
    EXPECT_EQ(scene.materials[0].texture, 0);
    EXPECT_TRUE(scene.environment.pixels.empty()) << "the lamp is light enough";
    // 2 above the ground, and 2 along the room's +X, which is to the rotated object's side.
    const float ground = static_cast<float>(file->ground_height);
    EXPECT_NEAR(ground, -1 / std::sqrt(5.0F), 1e-6F);
    const glm::vec3 above = scene.meshes[1].positions[0], beside = scene.meshes[1].positions[1];
    EXPECT_LT(glm::distance(above, glm::vec3(0, ground + 1, 0)), 1e-5F);
    EXPECT_LT(glm::distance(beside, glm::vec3(0, ground + 1, 1)), 1e-5F);
    EXPECT_FALSE(load(R"({"object": {"mesh": "bare.obj"}})")->scene.has_surroundings());
}

TEST_F(SceneFileTest, WrongRoomsAreErrorsThatNameThePlace) {
    const auto with = [](const std::string& room) {
        return R"({"object": {"mesh": "quad.obj"}, "room": )" + room + "}";
    };
    EXPECT_THAT(error(with(R"({"file": "none.obj", "radius": 1})")), HasSubstr("room.file"));
    EXPECT_THAT(error(with(R"({"file": "bare.obj"})")), HasSubstr("room: radius is missing"));
    EXPECT_THAT(error(with(R"({"radius": 1})")), HasSubstr("room: file is missing"));
    EXPECT_THAT(error(with(R"({"file": "bare.obj", "radius": 0})")), HasSubstr("room.radius"));
    EXPECT_THAT(error(with(R"({"file": "bare.obj", "radius": 1, "scale": 2})")),
                HasSubstr("has a key 'scale' that means nothing here; it may have: "));
    EXPECT_THAT(error(R"({"object": {"mesh": "quad.obj"}, "look": "toon", "room": {"file": "bare.obj", "radius": 1}})"),
                HasSubstr("room: cannot be combined with"));
}

TEST_F(SceneFileTest, UnknownKeysAreErrorsThatNameThem) {
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "camra": {}})"),
                AllOf(HasSubstr("has a key 'camra' that means nothing here; it may have: "),
                      HasSubstr("; did you mean 'camera'?")));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj", "colour": 1}})"),
                HasSubstr("object: has a key 'colour' that means nothing here; it may have: "));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "camera": {"fov": 1}})"),
                HasSubstr("camera: has a key 'fov' that means nothing here; it may have: "));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj", "material": {"color": 1}}})"),
                HasSubstr("object.material: has a key 'color' that means nothing here; it may have: "));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "lights": [{"type": "point", "power": 1}]})"),
                HasSubstr("lights[0]: has a key 'power' that means nothing here; it may have: "));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "environment": {"constant": 1, "gamma": 2}})"),
                HasSubstr("environment: has a key 'gamma' that means nothing here; it may have: "));
}

TEST_F(SceneFileTest, CartoonsHaveAStyle) {
    const Result<SceneFile> plain = load(R"({"object": {"mesh": "bare.obj"}, "look": "toon"})");
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE(plain->toon);
    EXPECT_EQ(plain->toon->thresholds, ToonStyle{}.thresholds);
    EXPECT_FALSE(load(R"({"object": {"mesh": "bare.obj"}})")->toon);
    const Result<SceneFile> styled = load(R"({"object": {"mesh": "bare.obj"}, "look": "toon",
        "camera": {"aperture_radii": 0.1, "focus_radii": 3},
        "toon": {"thresholds": [0.7, 0.2], "values": [0.9, 0.6, 0.2], "edge_radius": 0.01, "edge_depth": 0.05,
                 "edge_angle_deg": 45, "edge_colour": [0.1, 0, 0.2], "shadow_rays": 8, "steps": "colour"}})");
    ASSERT_TRUE(styled) << styled.error().message;
    EXPECT_EQ(styled->camera.aperture_radii, 0.1);
    EXPECT_EQ(styled->camera.focus_radii, 3);
    const ToonStyle& style = *styled->toon;
    EXPECT_EQ(style.tone(0.7F), 0.9F);
    EXPECT_EQ(style.tone(0.69F), 0.6F);
    EXPECT_EQ(style.tone(0.1F), 0.2F);
    EXPECT_EQ(style.edge_radius, 0.01F);
    EXPECT_EQ(style.edge_depth, 0.05F);
    EXPECT_NEAR(style.edge_angle_rad, kPi / 4, 1e-6);
    EXPECT_EQ(style.edge_colour, glm::vec3(0.1F, 0, 0.2F));
    EXPECT_EQ(style.shadow_rays, 8);
    EXPECT_EQ(style.steps, ToonStyle::Steps::colour);
    EXPECT_EQ(style.edge_test, ToonStyle::EdgeTest::slope);
}

TEST_F(SceneFileTest, WrongStylesOfCartoonsAreErrors) {
    const auto wrong = [&](const std::string& style) {
        return error(R"({"object": {"mesh": "bare.obj"}, "look": "toon", "toon": )" + style + "}");
    };
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "look": "oil"})"), HasSubstr("look: must be"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "toon": {}})"),
                HasSubstr("toon: requires \"look\": \"toon\""));
    EXPECT_THAT(wrong(R"({"thresholds": [0.5]})"), HasSubstr("toon: values must be one more than \"thresholds\""));
    EXPECT_THAT(wrong(R"({"thresholds": [0.1, 0.2, 0.3, 0.4]})"), HasSubstr("toon: thresholds must fall"));
    EXPECT_THAT(wrong(R"({"thresholds": [0.9, 0.8, 0.7, -0.1]})"),
                HasSubstr("toon.thresholds[3]: must be a number from 0 to 1"));
    EXPECT_THAT(wrong(R"({"values": 3})"), HasSubstr("toon.values: must be a list"));
    EXPECT_THAT(wrong(R"({"values": "abcde"})"), HasSubstr("toon.values: must be a list"));
    EXPECT_THAT(wrong(R"({"edge_radius": -1})"), HasSubstr("toon.edge_radius: must be a number"));
    EXPECT_THAT(wrong(R"({"width": 2})"), HasSubstr("has a key 'width' that means nothing here; it may have: "));
}

TEST_F(SceneFileTest, WrongValuesAreErrorsThatNameThePlace) {
    EXPECT_THAT(error("{"), HasSubstr("is not valid JSON"));
    EXPECT_THAT(error("[]"), HasSubstr("must be an object"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "camera": {"views": 4, "width": 9, "views": 5}})"),
                HasSubstr("the key \"views\" is there twice"));
    EXPECT_TRUE(load(R"({"object": {"mesh": "bare.obj"}, "lights": [{"type": "point"}, {"type": "point"}]})"))
        << "the same key in two objects";
    EXPECT_THAT(error("{}"), HasSubstr("object is missing"));
    EXPECT_THAT(error(R"({"object": {}})"), HasSubstr("give one of \"mesh\" and \"generator\""));
    EXPECT_THAT(error(R"({"object": {"mesh": "gone.obj"}})"), HasSubstr("gone.obj: there is no such file"));
    EXPECT_THAT(error(R"({"object": {"mesh": 5}})"), HasSubstr("object.mesh: must be a text"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "camera": {"views": 0}})"),
                HasSubstr("camera.views: must be a whole number from 1 to"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "camera": {"views": 2.5}})"), HasSubstr("camera.views"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "camera": {"distance_radii": "far"}})"),
                HasSubstr("camera.distance_radii: must be a number"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "seed": -1})"), HasSubstr("seed: must be a whole number"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "materials": {"wood": {}}})"),
                HasSubstr("no material \"wood\"; it has "));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj", "material": {"kind": "wood"}}})"),
                HasSubstr("material.kind: must be"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj", "material": {"colour": [1, 2]}}})"),
                HasSubstr("colour: must be a list of three numbers"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj", "texture": "red.png"}})"),
                HasSubstr("no texture coordinates"));
    EXPECT_THAT(error(R"({"object": {"mesh": "quad.obj", "texture": "blue.png"}})"),
                HasSubstr("does not exist; add the file"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "environment": {}})"), HasSubstr("give one of"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "environment": {"file": "gone.exr"}})"),
                HasSubstr("gone.exr does not exist"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "lights": [{"type": "laser"}]})"),
                HasSubstr("lights[0].type: must be"));
    EXPECT_THAT(error(R"({"object": {"mesh": "bare.obj"}, "lights": [{"type": "rectangle", "edge_u": [0, 0, 1]}]})"),
                HasSubstr("span an area"));
}

TEST_F(SceneFileTest, OtherFilesAreRefused) {
    const Result<SceneFile> file = load_scene_file(folder_ / "red.png", {});
    ASSERT_FALSE(file);
    EXPECT_THAT(file.error().message, HasSubstr("red.png: not a scene by its name"));
    EXPECT_FALSE(load_scene_file(folder_ / "gone.json", {}));
}

TEST(Normalise, FailsWithoutExtent) {
    Scene scene;
    scene.name = "dot";
    EXPECT_FALSE(normalise_meshes(scene));
    scene.meshes.push_back(make_quad({1, 1, 1}, {0, 0, 0}, {0, 0, 0}));
    const Result<double> radius = normalise_meshes(scene);
    ASSERT_FALSE(radius);
    EXPECT_THAT(radius.error().message, HasSubstr("dot: the meshes have no size"));
}

TEST(Normalise, FailsWithoutWidth) {
    // On the axis by its bounding box, though not by its own origin.
    Scene scene;
    scene.name = "needle";
    scene.meshes.push_back(make_quad({1, 0, 1}, {0, 1, 0}, {0, 2, 0}));
    Scene same = scene;
    const Result<double> radius = normalise_meshes(scene);
    ASSERT_FALSE(radius);
    EXPECT_THAT(radius.error().message, HasSubstr("needle: the meshes have no width"));
    EXPECT_TRUE(normalise_meshes(same, ObjectCentre::mesh_origin));
}

TEST_F(SceneFileTest, PaintedEmissionLightsNoScene) {
    const auto generate = [](bool painted) -> Generator {
        return [painted](const std::string&, const nlohmann::json&, std::uint64_t) -> Result<Scene> {
            Scene scene = scene_of(make_sphere(1), material_of(SurfaceKind::diffuse));
            scene.materials[0].emission = glm::vec3(1.0F);
            scene.textures.push_back({"lamps", Image<RgbaF>(2, 2, {0, 0, 0, 1})});
            if (painted) scene.materials[0].emission_texture = 0;
            return scene;
        };
    };
    const char* recipe = R"({"object": {"generator": "ball"}})";
    const Result<SceneFile> lamp = load(recipe, generate(false));
    const Result<SceneFile> painted = load(recipe, generate(true));
    ASSERT_TRUE(lamp && painted);
    EXPECT_TRUE(lamp->scene.environment.pixels.empty());
    EXPECT_FALSE(painted->scene.environment.pixels.empty()) << "gets the studio";
}

TEST(Studio, DefaultLightsAWhiteBallWithoutClippingMuch) {
    Scene scene = scene_of(make_sphere(4), material_of(SurfaceKind::diffuse, glm::vec3(0.8F)));
    scene.environment = make_studio_environment(default_studio());
    RenderOptions options;
    options.samples_per_pixel = 16;
    const Rendering rendering = render(std::move(scene), front_camera(3.5, 36.0, 32), options);
    const glm::dvec3 mean = mean_radiance(rendering.image);
    EXPECT_GT(mean.g, 0.3);
    EXPECT_LT(mean.g, 0.8);
    EXPECT_NEAR(mean.r, mean.b, 0.1) << "neutral";
    int clipped = 0;
    for (const RgbaF& p : rendering.image.pixels()) clipped += p.g > 1.05F ? 1 : 0;
    EXPECT_LT(clipped, 10);
}

}  // namespace
}  // namespace rs::capture::test
