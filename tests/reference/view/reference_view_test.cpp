// Compares the scalar definition of rendering with a second implementation of engine/RECONSTRUCTION.md
// (reference_view.hpp): every pixel of random views of random objects, bit for bit, colour and depth. The second
// implementation checks the bounds of the section "Ranges" and counts the branches of the text, each of which must be
// taken.

#include "tests/reference/view/reference_view.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/random.hpp"
#include "tests/support/random_shape.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace rs::reference {
namespace {

using engine::ViewRegisters;
using test::Random;

struct RandomScene {
    RaySpaceObject object;
    double distance = 0;       // distance of the captured cameras
    double camera_height = 0;  // height of the first ring
    double fov_rad = 0;        // field of view that contains the object at `distance`
};

// Expands U and V of the images to the size of Y.
void enlarge_chroma(RaySpaceObject& object, Random& random) {
    for (PlanarImage& image : object.images) {
        image.chroma_shift = 0;
        for (Image<std::uint8_t>* plane : {&image.u, &image.v}) {
            *plane = Image<std::uint8_t>(object.width, object.height);
            for (std::uint8_t& sample : plane->pixels()) sample = static_cast<std::uint8_t>(random.whole(0, 255));
        }
    }
}

// Makes some columns of the images nearly or partly transparent, as at silhouettes.
void make_columns_transparent(RaySpaceObject& object, Random& random) {
    for (PlanarImage& image : object.images) {
        for (int column = 0; column < object.width; ++column) {
            const int kind = random.whole(0, 2);
            for (int row = 0; row < object.height; ++row) {
                const int alpha = kind == 0 ? random.whole(0, 1) : kind == 1 ? random.whole(40, 200) : 255;
                image.a(column, row) = static_cast<std::uint8_t>(alpha);
            }
        }
    }
}

RaySpaceObject random_ring_object(Random& random, RandomScene& drawn) {
    test::RingObjectOptions options;
    options.views = random.whole(1, 14);
    options.width = random.whole(2, 40);
    options.height = random.whole(6, 40);
    options.distance = drawn.distance = random.whole(0, 3) == 0 ? random.real(1.2, 1.6) : random.real(1.5, 8);
    options.fl_px = options.width * options.distance * random.real(0.3, 0.8);
    options.planes = random.whole(3, 12);
    options.x_cells = random.whole(1, 60);
    options.u_cells = random.whole(1, 60);
    options.camera_height = drawn.camera_height = random.real(-0.5, 0.5);
    options.seed = random.engine();
    return test::ring_object(options);
}

RaySpaceObject random_small_object(Random& random, RandomScene& drawn) {
    test::SmallObjectOptions options;
    options.rings = random.whole(1, 3);
    options.views_per_ring = random.whole(3, 12);
    options.planes = random.whole(3, 8);
    options.distance = drawn.distance = random.real(1.5, 5);
    RaySpaceObject object = test::small_object(options);
    object.units_per_radius = 1;
    return object;
}

RandomScene draw(Random& random, bool with_shape) {
    RandomScene drawn;
    drawn.object = random.whole(0, 2) == 0 ? random_small_object(random, drawn) : random_ring_object(random, drawn);
    drawn.fov_rad = 2 * std::atan(random.real(0.5, 1.3) / drawn.distance);
    if (random.whole(0, 4) == 0) enlarge_chroma(drawn.object, random);
    if (random.whole(0, 3) == 0) make_columns_transparent(drawn.object, random);
    if (random.whole(0, 1) == 0) test::make_middle_opaque(drawn.object);
    const double empty_share = random.whole(0, 3) == 0 ? 0.9 : random.real(0, 0.5);
    for (std::size_t r = 0; with_shape && r < drawn.object.rings.size(); ++r) {
        drawn.object.rings[r].shape = test::random_shape(drawn.object, r, random.engine, empty_share);
    }
    return drawn;
}

enum class Pose { captured, on_ring, nearer, farther, above, tilted };
constexpr std::array kPoses = {Pose::captured, Pose::on_ring, Pose::nearer, Pose::farther, Pose::above, Pose::tilted};

Camera camera_of(const RandomScene& drawn, Random& random, Pose pose) {
    const Rig rig = rig_from_json(drawn.object.rig_json, "drawn object").value();
    const int views = static_cast<int>(rig.views.size());
    if (pose == Pose::captured) return rig.views[static_cast<std::size_t>(random.whole(0, views - 1))].camera;
    double distance = drawn.distance;
    double height = drawn.camera_height;
    if (pose == Pose::nearer) distance = random.real(0.3, drawn.distance);
    if (pose == Pose::farther) distance = drawn.distance * random.real(1, random.whole(0, 1) == 0 ? 4 : 25);
    if (pose == Pose::above || pose == Pose::tilted) height = random.real(-2, 2);
    const double angle = random.real(0, 2 * kPi);
    const glm::dvec3 eye(distance * std::sin(angle), height, distance * std::cos(angle));
    const glm::dvec3 at(random.real(-0.2, 0.2), pose == Pose::tilted ? random.real(-1, 1) : height,
                        random.real(-0.2, 0.2));
    const double wide = random.whole(0, 3) == 0 ? radians(100) : drawn.fov_rad * drawn.distance / distance;
    Camera camera = look_at_camera(eye, at, std::min(wide, 2.0), random.whole(1, 24), random.whole(1, 20));
    if (pose == Pose::tilted) return camera;
    camera = upright_camera(camera);
    camera.cy -= camera.fl_y * height / distance;
    return camera;
}

struct ComparisonCounts {
    Branches branches;
    std::int64_t pixels = 0;
    std::int64_t shown = 0;
};

// Returns false, with the pixel's position, at the first difference.
bool equals_definition(const RaySpaceObject& object, const ViewRegisters& view, ComparisonCounts& compared) {
    Image<Rgba8> colour(view.width, view.height);
    Image<std::int32_t> lambda(view.width, view.height);
    engine::reconstruct_scalar(object, view, colour, lambda);
    for (int j = 0; j < view.height; ++j) {
        for (int i = 0; i < view.width; ++i) {
            const ReferencePixel expected = reference_pixel(object, view, i, j, compared.branches);
            const Rgba8 found = colour(i, j);
            if (expected != ReferencePixel{found.r, found.g, found.b, found.a, lambda(i, j)}) {
                ADD_FAILURE() << "pixel " << i << " " << j << " of " << view.width << "x" << view.height << ": text "
                              << int{expected.R} << " " << int{expected.G} << " " << int{expected.B} << " "
                              << int{expected.A} << " at " << expected.lambda_q20 << ", definition " << int{found.r}
                              << " " << int{found.g} << " " << int{found.b} << " " << int{found.a} << " at "
                              << lambda(i, j);
                return false;
            }
            ++compared.pixels;
            compared.shown += found.a > 0;
        }
    }
    return true;
}

bool equals_definition_from_everywhere(ComparisonCounts& compared, bool with_shape, std::uint64_t first_seed,
                                       int objects) {
    for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(objects); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const RandomScene drawn = draw(random, with_shape);
        const Status valid = validate_object(drawn.object, "drawn object");
        EXPECT_TRUE(valid.ok()) << valid.error().message;
        if (!valid) return false;
        for (const Pose pose : kPoses) {
            SCOPED_TRACE("pose " + std::to_string(static_cast<int>(pose)));
            const auto filter = static_cast<engine::TexelFilter>(random.whole(0, 2));
            const Result<ViewRegisters> view =
                engine::prepare_view(drawn.object, camera_of(drawn, random, pose), filter);
            if (view && !equals_definition(drawn.object, *view, compared)) return false;
        }
    }
    return true;
}

void expect_branches_taken(const Branches& branches, std::size_t from, std::size_t to) {
    for (std::size_t n = from; n <= to; ++n) {
        if (n == static_cast<std::size_t>(Branch::foot_too_far)) continue;  // taken only at the ends of the ranges
        EXPECT_GT(branches.taken[n], 0) << "number " << n << " of enum class Branch was never taken";
    }
}

TEST(ReferenceViewProperty, TheTextGivesTheDefinitionsPixelsAndEachOfItsBranchesIsTaken) {
    ComparisonCounts compared;
    ASSERT_TRUE(equals_definition_from_everywhere(compared, true, 1, 400));
    EXPECT_GT(compared.shown * 10, compared.pixels);
    expect_branches_taken(compared.branches, static_cast<std::size_t>(Branch::plane_behind_or_edge_on),
                          static_cast<std::size_t>(Branch::no_image));
    expect_branches_taken(compared.branches, static_cast<std::size_t>(Branch::foot_too_far),
                          static_cast<std::size_t>(Branch::count) - 1);
}

TEST(ReferenceViewProperty, TheTextGivesTheDefinitionsPixelsOfObjectsWithoutAShapeMap) {
    ComparisonCounts compared;
    ASSERT_TRUE(equals_definition_from_everywhere(compared, false, 1001, 100));
    EXPECT_GT(compared.shown * 10, compared.pixels);
    expect_branches_taken(compared.branches, 0, static_cast<std::size_t>(Branch::outside_on_plane));
    EXPECT_GT(compared.branches.of(Branch::too_steep_on_plane), 0);
}

// --- The ends of the ranges -----------------------------------------------------------------------------------------

constexpr std::int32_t k20 = 1 << 20, k28 = 1 << 28, k30 = 1 << 30;

class Ends {
public:
    explicit Ends(Random& random) : random_(random) {}
    std::int32_t in(std::int32_t low, std::int32_t high) {
        if (random_.whole(0, 2) == 0) return random_.whole(low, high);
        return random_.whole(0, 1) == 0 ? low : high;
    }
    std::int32_t within(std::int32_t low, std::int32_t high) { return random_.whole(low, high); }
    std::int32_t below(std::int32_t limit) { return in(1 - limit, limit - 1); }
    bool one_of(int n) { return random_.whole(1, n) == 1; }

private:
    Random& random_;
};

void move_map_to_ends(ShapeMap& shape, Ends& ends) {
    if (ends.one_of(2)) shape.bands_per_unit_q12 = ends.in(1, 1 << 26);
    if (ends.one_of(3)) shape.h_low_q20 = ends.below(k28);
    if (ends.one_of(2)) shape.reference_distance_q20 = ends.in(k20 + 1, k28 - 1);
    if (ends.one_of(2)) shape.reference_height_q20 = ends.below(k28);
    if (ends.one_of(2)) shape.depth_low_q20 = ends.below((1 << 21) + (1 << 16) + 1);
    if (ends.one_of(2)) shape.depth_step_q24 = ends.in(1, 1 << 18);
    shape.jump = ends.in(1, 255);
    if (ends.one_of(2)) shape.thickness = ends.in(0, 255);
    const bool are_scattered = ends.one_of(3);  // the search for the gap takes more steps
    for (NormalLine& line : shape.normal_lines) {
        if (are_scattered) line.a_q20 = ends.within(-k20, k20);
        if (are_scattered) line.c_q20 = ends.within(-2 * k20, 2 * k20);
        if (ends.one_of(8)) line.a_q20 = ends.below(k28);
        if (ends.one_of(8)) line.c_q20 = ends.below(k28);
    }
    for (ShapeCell& cell : shape.cells) {
        const std::int32_t depth = ends.in(0, 255);
        cell = {static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(ends.in(1, 3))};
    }
}

void move_cameras_to_ends(RaySpaceObject& object, Ends& ends) {
    for (Ring& ring : object.rings) {
        for (NormalLine& line : ring.shape.normal_lines) {
            line.l2_q30 = ends.below(k30 + 1);
            line.q2_q16 = ends.below(k30);
        }
    }
    for (CapturedView& view : object.views) {
        view.cx_q16 = ends.below(k30);
        view.cy_q16 = ends.below(k30);
        view.fl_y_q16 = ends.in(1, k30 - 1);
        view.height_q20 = ends.below(k28);
        for (CapturedLine& line : view.lines) {
            line = {ends.in(2 * k20 + (k20 >> 3), k28 - 1), ends.below(k30 + 1),
                    ends.below(std::numeric_limits<std::int32_t>::max()), ends.below(k30)};
        }
    }
}

// Any position within 256 radii from which a ray of the view's middle passes the object.
void move_viewpoint_to_ends(ViewRegisters& view, Random& random, Ends& ends) {
    view.b_q20 = ends.below(k28);
    const int i = view.width / 2, j = view.height / 2;
    for (engine::PlaneRegisters& plane : view.planes) {
        const auto n = static_cast<double>(-plane.along_normal.at(i, j));
        // A third of the viewpoints are about 512 from the plane along the viewing axis; n / 2^32 is the scale per
        // unit.
        plane.c_q20 =
            ends.one_of(3) ? static_cast<std::int32_t>(std::clamp(n / 8, 1.0 - k28, k28 - 1.0)) : ends.below(k28);
        const double a = -static_cast<double>(plane.along_tangent.at(i, j)) / n * plane.c_q20 + random.real(-k20, k20);
        plane.a_q20 = static_cast<std::int32_t>(std::clamp(a, 1.0 - k28, k28 - 1.0));
    }
}

TEST(ReferenceViewProperty, NumbersAtTheEndsOfTheirRangesKeepTheBoundsOfTheTextAndGiveTheDefinitionsPixels) {
    ComparisonCounts compared;
    int moved_viewpoints = 0;
    for (std::uint64_t seed = 2001; seed < 2801; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Ends ends(random);
        RandomScene drawn = draw(random, true);
        for (Ring& ring : drawn.object.rings) move_map_to_ends(ring.shape, ends);
        if (ends.one_of(3)) move_cameras_to_ends(drawn.object, ends);
        const Status valid = validate_object(drawn.object, "drawn object");
        ASSERT_TRUE(valid.ok()) << valid.error().message;
        // Nearly overhead, rays have the least horizontal length.
        const double beside = ends.one_of(2) ? 0.12 : 1;
        const glm::dvec3 eye(beside * random.real(0.4, 1.3), random.real(-2, 2), beside * random.real(0.1, 3));
        const double scale = ends.one_of(4) ? 90 : 1;
        Camera camera = look_at_camera(scale * eye, {0, 0, 0}, ends.one_of(2) ? 0.7 / scale : 2.6, 16, 12);
        if (ends.one_of(2)) camera = upright_camera(camera);
        if (ends.one_of(3)) camera.cx = 0.5;
        Result<ViewRegisters> view = engine::prepare_view(drawn.object, camera);
        if (!view) continue;
        ASSERT_TRUE(equals_definition(drawn.object, *view, compared));
        move_viewpoint_to_ends(*view, random, ends);
        if (!engine::check_registers(drawn.object, *view)) continue;
        ++moved_viewpoints;
        ASSERT_TRUE(equals_definition(drawn.object, *view, compared));
    }
    EXPECT_GT(moved_viewpoints, 100);
    EXPECT_GT(compared.shown * 50, compared.pixels);
    for (const Branch branch : {Branch::foot_too_far, Branch::band_drift_clamped, Branch::most_steps, Branch::too_near,
                                Branch::behind_the_viewer, Branch::shown}) {
        EXPECT_GT(compared.branches.of(branch), 0) << static_cast<int>(branch);
    }
}

// Captured cameras that are too close to the plane, or enlarge it too much, for section 3. A horizontal row of the view
// stays at row cy of the image for any enlargement.
TEST(ReferenceViewProperty, NumbersAtTheEndsOfTheirRangesGiveTheDefinitionsPixelsOfObjectsWithoutAShapeMap) {
    ComparisonCounts compared;
    for (std::uint64_t seed = 3001; seed < 3401; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Ends ends(random);
        RandomScene drawn = draw(random, false);
        for (CapturedView& view : drawn.object.views) {
            view.fl_y_q16 = ends.in(1, k30 - 1);
            for (CapturedLine& line : view.lines) {
                line.l0_q20 = ends.one_of(2) ? ends.within(0, 1 << 18) : ends.in(0, k28 - 1);
                line.l1_q30 = ends.one_of(2) ? 0 : ends.within(0, k30 / 64);
                line.q0_q16 = ends.one_of(2) ? 0 : ends.below(std::numeric_limits<std::int32_t>::max());
                line.q1_q16 = ends.one_of(2) ? 0 : ends.below(k30);
            }
        }
        if (!validate_object(drawn.object, "drawn object")) continue;  // a camera may face away from the plane
        Camera camera = camera_of(drawn, random, Pose::captured);
        camera.cy = random.whole(0, camera.height - 1) + 0.5;
        const Result<ViewRegisters> view = engine::prepare_view(drawn.object, camera);
        if (view) {
            ASSERT_TRUE(equals_definition(drawn.object, *view, compared));
        }
    }
    EXPECT_GT(compared.shown * 100, compared.pixels);
    for (const Branch branch : {Branch::too_near_on_plane, Branch::too_large_on_plane, Branch::shown_on_plane}) {
        EXPECT_GT(compared.branches.of(branch), 0) << static_cast<int>(branch);
    }
}

}  // namespace
}  // namespace rs::reference
