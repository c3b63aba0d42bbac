// Toon edge lines against analytic edge positions.

#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace rs::capture::test {
namespace {

// White surfaces, black lines.
RenderOptions lines(float radius, int samples = 1) {
    RenderOptions options;
    options.method = RenderMethod::kToon;
    options.samples_per_pixel = samples;
    if (samples == 1) options.filter_radius_px = 0.001F;
    options.toon.thresholds = {};
    options.toon.values = {1.0F};
    options.toon.edge_radius = radius;
    return options;
}

Material white() {
    return material_of(SurfaceKind::diffuse, glm::vec3(1.0F));
}

bool is_line(const RgbaF& p) {
    return p.a > 0 && p.g < 0.5F;
}

int count_lines(const Image<RgbaF>& image) {
    return static_cast<int>(std::ranges::count_if(image.pixels(), is_line));
}

// Flat faces with outward winding.
Mesh make_box(const glm::vec3& low, const glm::vec3& high) {
    Mesh box;
    box.name = "box";
    const glm::vec3 size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0), v(0), w(0);
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        w[axis] = size[axis];
        for (const Mesh& face : {make_quad(low + w, u, v), make_quad(low, v, u)}) {
            const auto first = static_cast<unsigned>(box.positions.size());
            box.positions.insert(box.positions.end(), face.positions.begin(), face.positions.end());
            for (const glm::uvec3& t : face.triangles) box.triangles.push_back(t + first);
        }
    }
    return box;
}

Mesh transformed(Mesh mesh, const glm::mat3& m, const glm::vec3& move) {
    for (glm::vec3& p : mesh.positions) p = m * p + move;
    for (glm::vec3& n : mesh.normals) n = m * n;
    if (glm::determinant(m) < 0) {
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    }
    return mesh;
}

// Rotation about an axis that is not aligned with the image.
glm::mat3 oblique_turn() {
    const glm::vec3 a = glm::normalize(glm::vec3(0.3F, 1, 0.2F)),
                    b = glm::normalize(glm::cross(a, glm::vec3(1, 0, 0.4F)));
    return {glm::cross(a, b), a, b};
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + t * (b - a));
}

TEST(ToonEdges, ACubeHasItsEdgesAndNoOthers) {
    const glm::mat3 turn = oblique_turn();
    const Camera camera = look_at_camera({0.4, 1.3, 4}, {0, 0, 0}, radians(36), 512, 512);
    const float radius = static_cast<float>(1.2 * 4.2 / camera.fl_x);
    const Image<RgbaF> image =
        render(scene_of(transformed(make_box(glm::vec3(-0.7F), glm::vec3(0.7F)), turn, {}), white()), camera,
               lines(radius))
            .image;
    // Edges with at least one visible face.
    std::vector<std::pair<glm::dvec2, glm::dvec2>> edges;
    const auto seen = [&](const glm::vec3& normal) {
        return glm::dot(camera.centre() - glm::dvec3(turn * (0.7F * normal)), glm::dvec3(turn * normal)) > 0;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
            glm::vec3 a(0), along(0), n1(0), n2(0);
            n1[(axis + 1) % 3] = corner % 2 == 0 ? 1.0F : -1.0F;
            n2[(axis + 2) % 3] = corner / 2 == 0 ? 1.0F : -1.0F;
            along[axis] = 1;
            if (!seen(n1) && !seen(n2)) continue;
            a = n1 + n2;
            edges.emplace_back(glm::dvec2(camera.project(glm::dvec3(turn * (0.7F * (a - along))))),
                               glm::dvec2(camera.project(glm::dvec3(turn * (0.7F * (a + along))))));
        }
    }
    ASSERT_EQ(edges.size(), 9U);
    int found = 0, asked = 0, right = 0, drawn = 0;
    for (const auto& [a, b] : edges) {
        for (double t = 0; t <= 1; t += 0.25 / glm::distance(a, b)) {
            const glm::dvec2 p = a + t * (b - a);
            bool near = false;
            for (int y = static_cast<int>(p.y) - 2; y <= static_cast<int>(p.y) + 2; ++y) {
                for (int x = static_cast<int>(p.x) - 2; x <= static_cast<int>(p.x) + 2; ++x) {
                    near = near || (is_line(image(x, y)) && glm::distance(p, glm::dvec2(x + 0.5, y + 0.5)) <= 1.5);
                }
            }
            ++asked;
            found += near;
        }
    }
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            if (!is_line(image(x, y))) continue;
            ++drawn;
            right += std::ranges::any_of(edges, [&](const auto& edge) {
                return distance_to_segment({x + 0.5, y + 0.5}, edge.first, edge.second) <= 1.5;
            });
        }
    }
    std::printf("cube: recall %.4f of %d, precision %.4f of %d\n", static_cast<double>(found) / asked, asked,
                static_cast<double>(right) / drawn, drawn);
    EXPECT_GE(found, 0.99 * asked);
    EXPECT_GE(right, 0.95 * drawn);
}

TEST(ToonEdges, SteepPlanesHaveNoneWhereTheirDepthAloneWouldSaySo) {
    constexpr float kRadius = 0.02F;
    int by_depth_alone = 0;
    for (int tilt_deg = 0; tilt_deg <= 80; tilt_deg += 5) {
        const auto tilt = static_cast<float>(radians(tilt_deg));
        const glm::vec3 down(0, -std::cos(tilt), std::sin(tilt));
        const Camera camera = front_camera(4, 20, 128);
        RenderOptions options = lines(kRadius);
        options.depth = true;
        const Rendering drawn =
            render(scene_of(make_quad(glm::vec3(-30, 0, 0) - 30.0F * down, 60.0F * down, {60, 0, 0}), white()), camera,
                   options);
        ASSERT_NEAR(drawn.depth(64, 64), 4, 0.2);
        EXPECT_EQ(count_lines(drawn.image), 0) << tilt_deg << " degrees";
        // The paper's first method: depth differences above a threshold within the radius.
        const int reach = static_cast<int>(kRadius * camera.fl_x / 4);
        for (int y = reach; y < 128 - reach; ++y) {
            for (int x = 0; x < 128; ++x) {
                const float threshold = 2 * kRadius;
                by_depth_alone += std::abs(drawn.depth(x, y + reach) - drawn.depth(x, y)) > threshold ||
                                  std::abs(drawn.depth(x, y - reach) - drawn.depth(x, y)) > threshold;
            }
        }
    }
    std::printf("planes tilted 0..80 degrees: 0 pixels with slope, %d by depth alone\n", by_depth_alone);
    EXPECT_GT(by_depth_alone, 1000);
}

// At a tilt of 63 degrees the depth changes by the threshold, twice the radius, within the radius.
TEST(ToonEdges, TheTestByDepthAloneBlackensSteepPlanesAndFindsNoCreases) {
    RenderOptions options = lines(0.02F);
    options.toon.edge_test = ToonStyle::EdgeTest::depth;
    const auto plane = [&](int tilt_deg) {
        const auto tilt = static_cast<float>(radians(tilt_deg));
        const glm::vec3 down(0, -std::cos(tilt), std::sin(tilt));
        return count_lines(
            render(scene_of(make_quad(glm::vec3(-9, 0, 0) - 9.0F * down, 18.0F * down, {18, 0, 0}), white()),
                   front_camera(4, 4, 32), options)
                .image);
    };
    EXPECT_EQ(plane(55), 0);
    EXPECT_EQ(plane(75), 32 * 32);
    // Corner of 90 degrees that points to the camera, so that the faces are tilted by 45 degrees.
    Scene corner = scene_of(make_quad({-9, -9, -9}, {9, 0, 9}, {0, 18, 0}), white());
    corner.meshes.push_back(make_quad({0, -9, 0}, {9, 0, -9}, {0, 18, 0}));
    Scene same = corner;
    EXPECT_EQ(count_lines(render(std::move(corner), front_camera(4, 4, 32), options).image), 0);
    EXPECT_GT(count_lines(render(std::move(same), front_camera(4, 4, 32), lines(0.02F)).image), 0);
}

TEST(ToonEdges, ASmoothSphereHasAnOutlineOnly) {
    constexpr float kRadius = 0.02F;
    const Camera camera = front_camera(4, 34, 400);
    const double outline_px = camera.fl_x / std::sqrt(15.0),
                 line_px = static_cast<double>(kRadius) * camera.fl_x / 3.87;
    for (const int splits : {4, 6}) {  // including coarse facets
        const Image<RgbaF> image = render(scene_of(make_sphere(splits), white()), camera, lines(kRadius)).image;
        int inside = 0, outline = 0, missing = 0;
        for (int y = 0; y < 400; ++y) {
            for (int x = 0; x < 400; ++x) {
                const double from_outline = outline_px - glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(200));
                if (image(x, y).a < 1) continue;
                inside += is_line(image(x, y)) && from_outline > line_px + 1.5;
                outline += from_outline < 0.8 * line_px;
                missing += !is_line(image(x, y)) && from_outline < 0.8 * line_px;
            }
        }
        EXPECT_EQ(inside, 0) << splits;
        EXPECT_GT(outline, 1000);
        EXPECT_EQ(missing, 0) << splits;
    }
}

// Width in pixels of a line along (-across.y, across.x) through the centre of an image.
double dark_width(const Image<RgbaF>& image, const glm::vec2& across) {
    const double middle = 0.5 * image.width();
    double width = 0;
    int scans = 0;
    for (double along = -3; along <= 3; along += 0.5, ++scans) {
        for (double s = -middle + 4; s < middle - 4; s += 0.125) {
            const int x = static_cast<int>(middle + s * across.x - along * across.y),
                      y = static_cast<int>(middle - s * across.y - along * across.x);
            width += 0.125 * static_cast<double>(image(x, y).a * (1 - image(x, y).g));
        }
    }
    return width / scans;
}

TEST(ToonEdges, LinesAreAsWideAsTheirRadiusFromThere) {
    enum Edge { kBeforeNothing, kBeforeAWall, kFlatCrease, kSharpCrease };
    double worst = 0;
    for (const auto& [radius_px, z] :
         std::vector<std::pair<double, double>>{{0.7, 2}, {0.7, 6}, {3, 6}, {9, 2}, {16, 6}, {30, 2}}) {
        const Camera camera = front_camera(z, 10, 96);
        const auto radius = static_cast<float>(radius_px * z / camera.fl_x);
        // Vertical, horizontal and slanted edges, including halfway between four, eight and sixteen diameters.
        for (const double lean_deg : {0.0, 5.625, 22.5, 45.0, 123.75}) {
            const auto lean = static_cast<float>(radians(lean_deg));
            const glm::vec3 across(std::cos(lean), std::sin(lean), 0), along(-across.y, across.x, 0);
            for (const Edge edge : {kBeforeNothing, kBeforeAWall, kFlatCrease, kSharpCrease}) {
                Scene scene = scene_of(make_quad(-20.0F * along, 9.0F * across, 40.0F * along), white());
                if (edge == kBeforeAWall) scene.meshes.push_back(make_quad({-50, -50, -3}, {100, 0, 0}, {0, 100, 0}));
                if (edge == kFlatCrease || edge == kSharpCrease) {  // a roof, seen from above
                    const auto slope = static_cast<float>(radians(edge == kFlatCrease ? 20 : 45));
                    const glm::vec3 out = std::cos(slope) * across, down(0, 0, -std::sin(slope));
                    scene.meshes = {make_quad(-20.0F * along, 3.0F * (down + out), 40.0F * along),
                                    make_quad(20.0F * along, 3.0F * (down - out), -40.0F * along)};
                }
                const double sides = edge == kBeforeNothing || edge == kBeforeAWall ? 1 : 2;
                const Image<RgbaF> image = render(std::move(scene), camera, lines(radius, 4)).image;
                const double width = dark_width(image, across) / sides;
                worst = std::max(worst, std::abs(width - radius_px));
                EXPECT_NEAR(width, radius_px, 0.7)
                    << "edge " << edge << ", radius " << radius_px << ", " << lean_deg << " degrees, z " << z;
            }
        }
    }
    std::printf("lines of 0.7 to 30 px: at most %.2f px off\n", worst);
}

struct Overlap {
    int both = 0, any = 0;
    [[nodiscard]] double ratio() const { return any > 0 ? static_cast<double>(both) / any : 0; }
};

TEST(ToonEdges, AMirrorShowsTheEdgesOfTheMirroredMesh) {
    constexpr float kRadius = 0.02F;
    const Mesh box = transformed(make_box(glm::vec3(-0.5F), glm::vec3(0.5F)), oblique_turn(), {0, 0.1F, 1.2F});
    const Mesh ball = transformed(make_sphere(5), glm::mat3(0.4F), {1.1F, 0.3F, 0.9F});
    const Camera camera = look_at_camera({2.2, 1.4, 3.4}, {0.6, 0, -1}, radians(50), 256, 256);
    Scene mirrored = scene_of(box, white());
    mirrored.meshes.push_back(ball);
    mirrored.materials.push_back(material_of(SurfaceKind::mirror, glm::vec3(1.0F)));
    const Mesh glass = make_quad({-30, -30, 0}, {60, 0, 0}, {0, 60, 0});
    mirrored.meshes.push_back(glass);
    mirrored.meshes.back().material = 1;
    glm::mat3 flip(1.0F);
    flip[2][2] = -1;
    Scene direct = scene_of(transformed(box, flip, {}), white());
    direct.meshes.push_back(transformed(ball, flip, {}));
    RenderOptions options = lines(kRadius);
    options.depth = true;
    const Rendering in_mirror = render(std::move(mirrored), camera, options);
    const Rendering drawn = render(std::move(direct), camera, options);
    Overlap overlap, of_depth;
    for (int y = 1; y < 255; ++y) {
        for (int x = 1; x < 255; ++x) {
            // The object in front of the mirror hides part of it.
            const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
            const double to_mirror = -camera.centre().z / ray.z * glm::dot(ray, camera.forward());
            if (!(ray.z < 0) || std::abs(in_mirror.depth(x, y) - to_mirror) > 1e-3) continue;
            const bool truth = is_line(drawn.image(x, y));
            const bool line = in_mirror.image(x, y).g < 0.5F && drawn.image(x, y).a > 0;
            overlap.both += truth && line;
            overlap.any += truth || line;
            // For comparison: Sobel edges of the depth image, which shows the mirror's plane.
            const auto d = [&](int i, int k) { return in_mirror.depth(x + i, y + k); };
            const float gx = d(1, -1) + 2 * d(1, 0) + d(1, 1) - d(-1, -1) - 2 * d(-1, 0) - d(-1, 1);
            const float gy = d(-1, 1) + 2 * d(0, 1) + d(1, 1) - d(-1, -1) - 2 * d(0, -1) - d(1, -1);
            const bool sobel = std::hypot(gx, gy) > 0.5F;
            of_depth.both += truth && sobel;
            of_depth.any += truth || sobel;
        }
    }
    std::printf("mirror: IoU %.3f of %d px; Sobel on depth %.3f\n", overlap.ratio(), overlap.any, of_depth.ratio());
    EXPECT_GT(overlap.any, 300);
    EXPECT_GE(overlap.ratio(), 0.9);
    EXPECT_LE(of_depth.ratio(), 0.1);
}

TEST(ToonEdges, GlassShowsTheEdgesBehindIt) {
    const auto drawn = [](bool behind_glass) {
        Scene scene = scene_of(transformed(make_box(glm::vec3(-0.5F), glm::vec3(0.5F)), oblique_turn(), {}), white());
        if (behind_glass) {
            scene.materials.push_back(material_of(SurfaceKind::glass, glm::vec3(1.0F)));
            scene.meshes.push_back(make_box({-9, -9, 2}, {9, 9, 2.02F}));
            scene.meshes.back().material = 1;
        }
        return render(std::move(scene), front_camera(4, 20, 200), lines(0.02F)).image;
    };
    const Image<RgbaF> without = drawn(false), with = drawn(true);
    Overlap overlap;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 200; ++x) {
            if (without(x, y).a == 0) continue;
            overlap.both += is_line(without(x, y)) && is_line(with(x, y));
            overlap.any += is_line(without(x, y)) || is_line(with(x, y));
        }
    }
    EXPECT_GT(overlap.any, 1000);
    EXPECT_GT(overlap.ratio(), 0.9);
}

}  // namespace
}  // namespace rs::capture::test
