// Panoramas: of smooth functions of the direction, and rendered. The latter are skipped without OpenGL.

#include "compositor/displays/panorama.hpp"

#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/compositor/gl_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <utility>

namespace rs::compositor {
namespace {

using RenderFace = std::function<Image<Rgba8>(const Camera& camera)>;

Image<Rgba8> panorama_of(const Camera& camera, const PanoramaLayout& layout, const RenderFace& render) {
    const std::array<Camera, kPanoramaFaces> cameras = panorama_cameras(camera, layout);
    std::array<Image<Rgba8>, kPanoramaFaces> faces;
    std::ranges::transform(cameras, faces.begin(), render);
    return panorama_from_faces(faces, layout);
}

Rgba8 colour_of_direction(const glm::dvec3& d) {
    const auto code = [](double part) { return static_cast<std::uint8_t>(std::lround(128 + 100 * part)); };
    return {code(d.x), code(d.y), code(d.z), 255};
}

int largest_difference(const Rgba8& a, const Rgba8& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(Panorama, HasTheLayoutOfEnvironmentMaps) {
    const PanoramaLayout layout{.width = 256};
    // Ahead is the horizontal part of the viewing direction: +X, so that +Z is to the right.
    for (const glm::dvec3 aim : {glm::dvec3(1, 0, 0), {1, -3, 0}}) {
        const Camera camera = look_at_camera({1, 2, 3}, glm::dvec3(1, 2, 3) + aim, 1, 100, 50);
        const Image<Rgba8> panorama = panorama_of(camera, layout, [](const Camera& face) {
            EXPECT_EQ(face.centre(), glm::dvec3(1, 2, 3));
            EXPECT_LT(rotation_error(face), 1e-9);
            Image<Rgba8> image(face.width, face.height);
            for (int y = 0; y < face.height; ++y) {
                for (int x = 0; x < face.width; ++x)
                    image(x, y) = colour_of_direction(glm::normalize(face.ray(x + 0.5, y + 0.5)));
            }
            return image;
        });
        ASSERT_EQ(panorama.width(), 256);
        ASSERT_EQ(panorama.height(), 128);
        int worst = 0;
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 256; ++x) {
                const double polar = kPi * (y + 0.5) / 128, turn = 2 * kPi * (x + 0.5) / 256 - kPi;
                const glm::dvec3 d(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
                worst = std::max(worst, largest_difference(panorama(x, y), colour_of_direction(d)));
            }
        }
        EXPECT_LE(worst, 2);
    }
}

TEST(Panorama, CamerasThatLookStraightDownOrUpHaveADirectionAhead) {
    Camera camera;
    camera.world_from_camera = glm::dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});  // looks down
    const PanoramaLayout layout{.width = 64};
    EXPECT_EQ(panorama_cameras(camera, layout)[0].forward(), glm::dvec3(0, 0, -1));
    camera.world_from_camera = glm::dmat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1});  // up
    EXPECT_EQ(panorama_cameras(camera, layout)[0].forward(), glm::dvec3(0, 0, -1));
}

// Six unlit walls of different colours about the origin.
Scene coloured_walls() {
    Scene scene;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
            glm::dvec3 size(4), at(0);
            size[axis] = 0.2;
            at[axis] = 2 * side;
            GeometryNode wall;
            wall.mesh = std::make_shared<const Mesh>(box_mesh(size));
            wall.material.lit = false;
            wall.material.diffuse = glm::vec3(side > 0 ? 0.2F : 0.05F);
            wall.material.diffuse[axis] = side > 0 ? 0.9F : 0.4F;
            wall.world_from_node[3] = glm::dvec4(at, 1);
            scene.geometry.push_back(wall);
        }
    }
    return scene;
}

struct WallPixel {
    glm::dvec3 direction;
    int x, y;
};
// Middles of the walls in a panorama of 256x128 pixels that looks along -Z.
constexpr std::array<WallPixel, 6> kWallPixels{{{{0, 0, -1}, 128, 64},
                                                {{1, 0, 0}, 192, 64},
                                                {{0, 0, 1}, 0, 64},
                                                {{-1, 0, 0}, 64, 64},
                                                {{0, 1, 0}, 77, 0},
                                                {{0, -1, 0}, 200, 127}}};

void expect_walls(const RenderFace& render) {
    const Image<Rgba8> panorama = panorama_of(look_at_camera({0, 0, 0}, {0, 0, -1}, 1, 64, 64), {.width = 256}, render);
    for (const WallPixel& wall : kWallPixels) {
        const Image<Rgba8> plain = render(look_at_camera({0, 0, 0}, wall.direction, radians(60), 65, 65));
        EXPECT_EQ(panorama(wall.x, wall.y), plain(32, 32)) << wall.x << "," << wall.y;
    }
    EXPECT_NE(panorama(128, 64), panorama(0, 64));
}

TEST(Panorama, OfATracedSceneHasTheColoursOfPlainImages) {
    Result<TracedRenderer> tracer = TracedRenderer::create(coloured_walls(), {}, {.method = TracedMethod::kWhitted});
    ASSERT_TRUE(tracer) << tracer.error().message;
    expect_walls([&](const Camera& camera) {
        tracer->begin_image(camera);
        EXPECT_TRUE(tracer->add_pass());
        return tracer->image();
    });
}

class RenderedPanorama : public test::GlTest {
protected:
    static RenderFace renderer_of_faces(FrameCompositor& compositor) {
        return [&compositor](const Camera& camera) {
            EXPECT_TRUE(compositor.resize(camera.width, camera.height).ok());
            Result<Image<Rgba8>> image = compositor.compose(camera);
            RS_CHECK(image.ok());
            return std::move(*image);
        };
    }
};

TEST_F(RenderedPanorama, HasTheColoursOfPlainImages) {
    auto compositor = FrameCompositor::create(coloured_walls(), {}, {.width = 64, .height = 64});
    ASSERT_TRUE(compositor.ok()) << compositor.error().message;
    expect_walls(renderer_of_faces(*compositor));
}

// A floor under a light varies smoothly. Borders between the side faces are at odd eighths of the width.
TEST_F(RenderedPanorama, HasNoSeams) {
    Scene scene;
    GeometryNode floor;
    floor.mesh = std::make_shared<const Mesh>(box_mesh({60, 0.2, 60}));
    floor.world_from_node[3] = glm::dvec4(0, -1.1, 0, 1);
    scene.geometry = {floor};
    Light light;
    light.kind = LightKind::kPoint;
    light.location = {1.5, 1, -0.5};
    scene.lights = {light};
    auto compositor = FrameCompositor::create(scene, {}, {.width = 64, .height = 64});
    ASSERT_TRUE(compositor.ok()) << compositor.error().message;
    const int width = 512;
    const Image<Rgba8> panorama =
        panorama_of(look_at_camera({0, 0, 0}, {0, 0, -1}, 1, 64, 64), {.width = width}, renderer_of_faces(*compositor));
    int at_borders = 0, within = 0, darkest = 255, brightest = 0;
    for (int y = 5 * width / 16; y < width / 2; ++y) {
        for (int x = 0; x < width; ++x) {
            const int next = (x + 1) % width;
            const int difference = largest_difference(panorama(x, y), panorama(next, y));
            int& largest = next % (width / 4) == width / 8 ? at_borders : within;
            largest = std::max(largest, difference);
            darkest = std::min<int>(darkest, panorama(x, y).g);
            brightest = std::max<int>(brightest, panorama(x, y).g);
            // Includes the border of the face below.
            if (y + 1 == width / 2) continue;
            EXPECT_LE(largest_difference(panorama(x, y), panorama(x, y + 1)), 6);
        }
    }
    EXPECT_LE(at_borders, within);
    EXPECT_LE(within, 6);
    EXPECT_GT(brightest - darkest, 30);
}

}  // namespace
}  // namespace rs::compositor
