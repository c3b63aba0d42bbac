// The images of the frame compositor. Skipped where no OpenGL context can be had.

#include "engine/core/definition/view_registers.hpp"
#include "engine/model/board.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace rs::compositor {
namespace {

TEST_F(Compositing, ErrorsOfOpenGlAreSeen) {
    glEnable(GL_TEXTURE_2D_ARRAY);  // no capability
    EXPECT_THAT(context_->take_errors(), ::testing::Not(::testing::IsEmpty()));
    EXPECT_THAT(context_->take_errors(), ::testing::IsEmpty());
}

TEST_F(Compositing, WhatIsNotReleasedIsSeen) {
    std::optional<FrameCompositor> compositor;
    {
        auto made = FrameCompositor::create(with_box({1, 1, 1}, {0, 0, 0}), {test::placed_at(test::drum())},
                                            {.width = kFrameWidth, .height = kFrameHeight});
        ASSERT_TRUE(made.ok());
        compositor.emplace(std::move(*made));
    }
    ASSERT_TRUE(compositor->draw(kFront));
    EXPECT_THAT(
        context_->live_objects(),
        ::testing::UnorderedElementsAre(::testing::EndsWith(" textures"), ::testing::EndsWith(" buffers"),
                                        ::testing::EndsWith(" vertex arrays"), ::testing::EndsWith(" framebuffers"),
                                        ::testing::EndsWith(" renderbuffers"), ::testing::EndsWith(" programs")));
    compositor.reset();
    EXPECT_THAT(context_->live_objects(), ::testing::IsEmpty());
    const unsigned texture = [] {
        GLuint name = 0;
        glCreateTextures(GL_TEXTURE_2D, 1, &name);
        return name;
    }();
    EXPECT_THAT(context_->live_objects(), ::testing::ElementsAre("1 textures"));
    glDeleteTextures(1, &texture);
}

TEST_F(Compositing, TheFirstRowIsTheTop) {
    const Image<Rgba8> frame = compose(with_box({1, 1, 1}, {0, 1.5, 0}), {});
    EXPECT_GT(frame(kFrameWidth / 2, 10).g, frame(kFrameWidth / 2, 10).b);
    EXPECT_LT(frame(kFrameWidth / 2, kFrameHeight - 10).g, frame(kFrameWidth / 2, kFrameHeight - 10).b);
}

TEST_F(Compositing, AWallInFrontHidesTheObjectAndOneBehindDoesNot) {
    const std::vector<PlacedObject> objects = {test::placed_at(test::drum(kRed))};
    const Scene before = with_box({6, 6, 0.1}, {0, 0, 2.5});
    EXPECT_EQ(compose(before, objects), compose(before, {}));
    EXPECT_TRUE(is_colour(middle(compose(with_box({6, 6, 0.1}, {0, 0, -2.5}), objects)), kRed));
}

TEST_F(Compositing, ThePlaneThroughTheAxisDecidesNotTheCylinder) {
    const std::vector<PlacedObject> objects = {test::placed_at(test::drum(kRed))};
    // Both walls cut through the drum.
    EXPECT_FALSE(is_colour(middle(compose(with_box({6, 6, 0.1}, {0, 0, 0.1}), objects)), kRed));
    EXPECT_TRUE(is_colour(middle(compose(with_box({6, 6, 0.1}, {0, 0, -0.1}), objects)), kRed));
}

TEST_F(Compositing, APillarHidesHalf) {
    const std::vector<PlacedObject> objects = {test::placed_at(test::drum(kRed))};
    const Image<Rgba8> frame = compose(with_box({2, 6, 0.2}, {-1, 0, 1.5}), objects);
    EXPECT_FALSE(is_colour(frame(kFrameWidth / 2 - 8, kFrameHeight / 2), kRed));
    EXPECT_TRUE(is_colour(frame(kFrameWidth / 2 + 8, kFrameHeight / 2), kRed));
    // The object hides the same pillar when that stands behind.
    const Image<Rgba8> behind = compose(with_box({2, 6, 0.2}, {-1, 0, -1.5}), objects);
    EXPECT_TRUE(is_colour(behind(kFrameWidth / 2 - 8, kFrameHeight / 2), kRed));
}

TEST_F(Compositing, TheNearerObjectIsInFrontHoweverTheyAreListed) {
    const PlacedObject red = test::placed_at(test::drum(kRed));
    const PlacedObject blue = test::placed_at(test::drum(kBlue), {{0.7, 0, -2}});
    const Image<Rgba8> frame = compose({}, {red, blue});
    EXPECT_TRUE(is_colour(middle(frame), kRed));
    EXPECT_TRUE(is_colour(frame(kFrameWidth / 2 + 29, kFrameHeight / 2), kBlue));
    EXPECT_EQ(frame, compose({}, {blue, red}));
    const Camera back = look_at_camera({0.35, 0, -7}, {0.35, 0, 0}, radians(50), kFrameWidth, kFrameHeight);
    EXPECT_TRUE(is_colour(middle(compose({}, {red, blue}, back)), kBlue));
}

TEST_F(Compositing, WhatIsOffTheScreenIsNotRendered) {
    const auto object = test::drum();
    compose({}, {test::placed_at(object, {{40, 0, 0}}), test::placed_at(object, {{0, 0, 9}})});
    EXPECT_EQ(statistics_.nodes_rendered, 0);
    EXPECT_EQ(statistics_.nodes_not_seen, 2);
    EXPECT_EQ(statistics_.pixels_rendered, 0);
    compose({}, {test::placed_at(object), test::placed_at(object, {{40, 0, 0}})});
    EXPECT_EQ(statistics_.nodes_rendered, 1);
    EXPECT_LT(statistics_.pixels_rendered, kFrameWidth * kFrameHeight * 2 / 3);
}

// The engine's image of the whole screen, laid over the background in linear light.
Image<Rgba8> expected_over(const Scene& scene, const PlacedObject& placed, const Camera& camera_in_world) {
    const RaySpaceObject& object = placed.object->renderer.object();
    Camera camera = camera_in_node(camera_in_world, placed.world_from_object);
    camera.world_from_camera[3] = glm::dvec4(camera.centre() * object.units_per_radius, 1);
    const auto registers = engine::prepare_view(object, camera);
    RS_CHECK(registers.ok());
    Image<Rgba8> image(camera.width, camera.height);
    placed.object->renderer.render(*registers, image);
    for (Rgba8& pixel : image.pixels()) {
        const float a = static_cast<float>(pixel.a) / 255.0F;
        const auto over = [&](std::uint8_t code, float background) {
            return srgb8_from_linear(linear_from_srgb8(code) * a + background * (1 - a));
        };
        pixel = {over(pixel.r, scene.background.sky[0].r), over(pixel.g, scene.background.sky[0].g),
                 over(pixel.b, scene.background.sky[0].b), 255};
    }
    return image;
}

TEST_F(Compositing, AnUnoccludedObjectIsTheEnginesImage) {
    const Scene scene;
    const auto object = test::drum();
    const Camera pitched = look_at_camera({1, 2, 5}, {0, 0, 0}, radians(50), kFrameWidth, kFrameHeight);
    // Rays of its lower corners run away from the object's plane.
    const Camera steep = look_at_camera({0.4, 1.4, 1.9}, {0, -0.4, 0.3}, radians(90), kFrameWidth, kFrameHeight);
    const NodeTransform aslant{{0.3, -0.2, 0.5}, {0.3, 1, -0.2}, 0.9, 0.8};
    for (const Camera& camera : {kFront, pitched, steep}) {
        for (const NodeTransform& transform :
             {NodeTransform{}, NodeTransform{{0.6, 0, 0}, {0, 1, 0}, 2, 1.3}, aslant}) {
            for (const int samples : {1, 4}) {
                const PlacedObject placed = test::placed_at(object, transform);
                const Image<Rgba8> expected = expected_over(scene, placed, camera);
                // One step of 8 bits: the GPU's sRGB tables round in their own way. A ray on the very border of two
                // texels may fall to the other one, because the view's registers are rounded at another first pixel.
                EXPECT_LE(count_different(compose(scene, {placed}, camera, samples), expected, 1), 3);
                EXPECT_GT(count_different(expected, compose(scene, {}, camera), 20), 500) << "it must be in view";
            }
        }
    }
}

int count_red(const Image<Rgba8>& frame) {
    return static_cast<int>(std::count_if(frame.pixels().begin(), frame.pixels().end(),
                                          [](Rgba8 pixel) { return is_colour(pixel, kRed); }));
}

TEST_F(Compositing, AnObjectDoesNotSinkIntoWhatItStandsOn) {
    RaySpaceNode standing;
    standing.chain = {{}};
    const std::vector<PlacedObject> objects = {place(test::drum(kRed), standing)};
    Scene floor;
    floor.floor = Floor{};
    const Scene table = with_box({3, 0.1, 3}, {0, -0.05, 0});
    for (const double height : {0.1, 1.0, 3.0}) {
        const Camera camera = look_at_camera({1, height, 4}, {0, 0.5, 0}, radians(60), kFrameWidth, kFrameHeight);
        const int whole = count_red(compose({}, objects, camera, 1));
        EXPECT_GT(whole, 500);
        EXPECT_EQ(count_red(compose(floor, objects, camera, 1)), whole) << height;
        EXPECT_EQ(count_red(compose(table, objects, camera, 1)), whole) << height;
    }
}

TEST_F(Compositing, AFloorHidesWhatIsBeyondIt) {
    RaySpaceNode node;
    node.chain = {{}};
    const auto object = test::drum(kRed);
    Scene scene;
    scene.floor = Floor{};
    const Camera from_below = look_at_camera({0, -1, 4}, {0, 0.5, 0}, radians(60), kFrameWidth, kFrameHeight);
    EXPECT_GT(count_red(compose({}, {place(object, node)}, from_below)), 500);
    EXPECT_EQ(count_red(compose(scene, {place(object, node)}, from_below)), 0);
    node.chain = {{{0, -3, 0}}};
    const Camera from_above = look_at_camera({0, 1, 5}, {0, -1.5, 0}, radians(60), kFrameWidth, kFrameHeight);
    EXPECT_GT(count_red(compose({}, {place(object, node)}, from_above)), 200);
    EXPECT_EQ(count_red(compose(scene, {place(object, node)}, from_above)), 0);
}

// A box seen from its lit side, with one or two sides.
TEST_F(Compositing, NormalsAgainstTheWindingAreTurned) {
    const Camera camera = look_at_camera({2, 2, 3}, {0, 0, 0}, radians(50), kFrameWidth, kFrameHeight);
    for (const bool two_sided : {false, true}) {
        Scene scene = with_box({1, 1, 1}, {0, 0, 0});
        scene.lights = {directional_light({-1, -2, -3}, glm::vec3(2)), point_light({1, 2, 1}, glm::vec3(1))};
        Mesh mesh = *scene.geometry[0].mesh;
        mesh.two_sided = two_sided;
        const auto image_with = [&](const Mesh& used) {
            scene.geometry[0].mesh = std::make_shared<const Mesh>(used);
            return compose(scene, {}, camera);
        };
        const Image<Rgba8> correct = image_with(mesh);
        EXPECT_GT(middle(correct).g, 100);
        Mesh reversed = mesh;
        for (MeshVertex& vertex : reversed.vertices) vertex.normal = -vertex.normal;
        EXPECT_EQ(image_with(reversed), correct) << two_sided;
        if (!two_sided) continue;
        Mesh rewound = mesh;  // outward normals on back faces
        for (std::size_t i = 0; i + 2 < rewound.indices.size(); i += 3) {
            std::swap(rewound.indices[i + 1], rewound.indices[i + 2]);
        }
        EXPECT_EQ(count_different(image_with(rewound), correct, 2), 0);
    }
}

TEST_F(Compositing, FramesOfGrowingObjectsFollowEachOther) {
    const std::vector<PlacedObject> objects = {test::placed_at(test::drum())};
    Result<FrameCompositor> compositor =
        FrameCompositor::create({}, objects, {.width = kFrameWidth, .height = kFrameHeight});
    ASSERT_TRUE(compositor);
    for (const double distance : {9.0, 4.0, 6.0, 1.5, 0.5, 30.0}) {
        const Camera camera = look_at_camera({0, 0, distance}, {0.1, 0, 0}, radians(50), kFrameWidth, kFrameHeight);
        const Result<Image<Rgba8>> frame = compositor->compose(camera);
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(*frame, compose({}, objects, camera)) << distance;
    }
}

// More nodes than a few rendering cycles hold.
TEST_F(Compositing, ManyNodesTakeSeveralCycles) {
    const auto object = test::drum(kRed);
    std::vector<PlacedObject> objects;
    for (int n = 0; n < 50; ++n)
        objects.push_back(
            test::placed_at(object, {{0.45 * (n % 10) - 2.0, 0.7 * (n / 10) - 1.4, -n * 0.01}, {0, 1, 0}, 0, 0.2}));
    const Image<Rgba8> all = compose({}, objects);
    EXPECT_EQ(statistics_.nodes_rendered, 50);
    EXPECT_EQ(statistics_.nodes_by_board, 0);
    // Each by itself, at its place.
    for (const std::size_t n : {0U, 17U, 49U}) {
        const Image<Rgba8> one = compose({}, {objects[n]});
        int red = 0;
        for (int y = 0; y < kFrameHeight; ++y) {
            for (int x = 0; x < kFrameWidth; ++x) {
                if (!is_colour(one(x, y), kRed)) continue;
                ++red;
                EXPECT_TRUE(is_colour(all(x, y), kRed)) << n << " at " << x << ", " << y;
            }
        }
        EXPECT_GT(red, 20) << n;
    }
}

TEST_F(Compositing, APlaceholderStandsWhereTheObjectWillBe) {
    const auto engine = std::make_shared<engine::RenderSession>(viewer_session_limits());
    const auto nodes = std::make_shared<DisplayedNodes>(1);
    Result<FrameCompositor> compositor =
        FrameCompositor::create({}, engine, nodes, {.width = kFrameWidth, .height = kFrameHeight});
    ASSERT_TRUE(compositor);
    const Image<Rgba8> empty = *compositor->compose(kFront);
    nodes->front().placeholder = Placeholder{};
    const Image<Rgba8> waiting = *compositor->compose(kFront);
    EXPECT_GT(count_different(empty, waiting, 3), 200);
    EXPECT_TRUE(compositor->statistics().nodes[0].missing);
    EXPECT_EQ(compositor->object_at(kFrameWidth / 2, kFrameHeight / 2), std::nullopt);
    nodes->front().placeholder->progress = 0.5F;
    const Image<Rgba8> half = *compositor->compose(kFront);
    EXPECT_EQ(half(kFrameWidth / 2, kFrameHeight / 2 - 10), waiting(kFrameWidth / 2, kFrameHeight / 2 - 10)) << "above";
    EXPECT_NE(half(kFrameWidth / 2, kFrameHeight / 2 + 10), waiting(kFrameWidth / 2, kFrameHeight / 2 + 10)) << "below";
    // Half faded in, then wholly.
    const auto object = test::drum(kRed);
    const Result<engine::ObjectHandle> handle = engine->load(prepared(object));
    ASSERT_TRUE(handle);
    DisplayedNode& node = nodes->front();
    node.placeholder.reset();
    node.object = test::placed_at(object);
    node.handle = *handle;
    node.opacity = 0.5F;
    const Rgba8 fading = middle(*compositor->compose(kFront));
    node.opacity = 1;
    EXPECT_FALSE(is_colour(fading, kRed));
    EXPECT_GT(fading.r, 190);
    EXPECT_TRUE(is_colour(middle(*compositor->compose(kFront)), kRed));
    EXPECT_EQ(compositor->object_at(kFrameWidth / 2, kFrameHeight / 2), 0U);
    EXPECT_FALSE(compositor->statistics().nodes[0].missing);
    // And away again.
    node = {};
    ASSERT_TRUE(engine->evict(*handle));
    EXPECT_EQ(*compositor->compose(kFront), empty);
}

TEST_F(Compositing, ABoardDrawsTheSameBits) {
    const auto config = engine::model::read_board_config("prototype-2000");
    ASSERT_TRUE(config);
    const auto engine = std::make_shared<engine::RenderSession>(viewer_session_limits(),
                                                                engine::model::make_simulated_board(*config, true));
    RaySpaceObject object = test::drum_object();
    const Result<std::shared_ptr<const RaySpaceObject>> for_board = engine->convert_for_board(object);
    ASSERT_TRUE(for_board);
    ASSERT_NE(*for_board, nullptr);
    Result<ViewableObject> viewable = make_viewable(std::move(object));
    ASSERT_TRUE(viewable);
    viewable->for_board = *for_board;
    const auto shared = std::make_shared<const ViewableObject>(std::move(*viewable));
    const std::vector<PlacedObject> objects = {test::placed_at(shared), test::placed_at(shared, {{1.5, 0, -1}})};
    const auto nodes = load_all_nodes(objects, *engine);
    ASSERT_TRUE(nodes);
    engine->load_on_board({nodes->get()->front().handle});
    Result<FrameCompositor> compositor = FrameCompositor::create(
        {}, engine, *nodes, {.width = kFrameWidth, .height = kFrameHeight, .samples = 4, .object_samples = 1});
    ASSERT_TRUE(compositor);
    const Image<Rgba8> by_board = *compositor->compose(kFront);
    EXPECT_EQ(compositor->statistics().nodes_by_board, 2);
    EXPECT_TRUE(compositor->statistics().nodes[1].by_board);
    Result<FrameCompositor> core = FrameCompositor::create(
        {}, objects, {.width = kFrameWidth, .height = kFrameHeight, .samples = 4, .object_samples = 1});
    ASSERT_TRUE(core);
    EXPECT_EQ(*core->compose(kFront), by_board);
    EXPECT_EQ(core->statistics().nodes_by_board, 0);
}

TEST_F(Compositing, AImageTooLargeForTheDriverIsRefused) {
    const auto framebuffer = gl::Framebuffer::create(1 << 20, 16, 1);
    ASSERT_FALSE(framebuffer);
    EXPECT_THAT(framebuffer.error().message, ::testing::HasSubstr("1048576x16"));
}

}  // namespace
}  // namespace rs::compositor
