// Writes the conformance set: `make_conformance_vectors engine/conformance/vectors EDITION`. Run it with a new edition
// when the normative arithmetic or the format changes, or when cases are added. Existing cases must not change
// otherwise.

#include "encode/codec/board/board_encoder.hpp"
#include "engine/conformance/vectors.hpp"
#include "engine/core/definition/reconstruct.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/random_shape.hpp"
#include "tests/support/ring_object.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace rs::engine {
namespace {

namespace fs = std::filesystem;

class Random {
public:
    explicit Random(std::uint64_t seed) : engine(seed) {}
    double real(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
    }
    int whole(int low, int high) { return low + static_cast<int>(engine() % static_cast<unsigned>(high - low + 1)); }
    std::mt19937_64 engine;
};

struct Pose {
    double azimuth = 0;
    double distance = 3.5;  // object radii
    double eye_height = 0;
    double at_height = 0;
    double half_extent = 1.2;  // of the larger side, radii at the axis
    int width = 40;
    int height = 40;
    double at_x = 0;
    bool upright = true;
};

Camera camera_of(const RaySpaceObject& object, const Pose& pose) {
    const glm::dvec3 eye(pose.distance * std::sin(pose.azimuth), pose.eye_height,
                         pose.distance * std::cos(pose.azimuth));
    const glm::dvec3 at(pose.at_x, pose.upright ? pose.eye_height : pose.at_height, 0);
    const double fov = 2 * std::atan(pose.half_extent / pose.distance * pose.width / std::max(pose.width, pose.height));
    Camera camera =
        look_at_camera(eye * object.units_per_radius, at * object.units_per_radius, fov, pose.width, pose.height);
    if (pose.upright) camera.cy -= camera.fl_y * (pose.eye_height - pose.at_height) / pose.distance;
    return camera;
}

Pose random_pose(Random& random, bool upright) {
    Pose pose;
    pose.azimuth = random.real(0, 2 * kPi);
    pose.distance = random.real(1.3, 9);
    pose.eye_height = random.real(-0.8, 0.8);
    pose.at_height = random.real(-0.3, 0.3);
    pose.half_extent = random.real(0.4, 1.5);
    pose.at_x = random.real(-0.3, 0.3);
    pose.width = random.whole(17, 60);
    pose.height = random.whole(17, 60);
    pose.upright = upright;
    return pose;
}

std::vector<Pose> random_poses(std::uint64_t seed, int count, bool upright) {
    Random random(seed);
    std::vector<Pose> poses;
    for (int i = 0; i < count; ++i) poses.push_back(random_pose(random, upright));
    return poses;
}

// Captured poses around the ring, and poses halfway between two of them.
std::vector<Pose> ring_poses(int views, double distance, int count) {
    std::vector<Pose> poses;
    for (int i = 0; i < count; ++i) {
        Pose pose;
        pose.distance = distance;
        pose.azimuth = 2 * kPi * (5 * i + 0.5 * (i % 2)) / views;
        poses.push_back(pose);
    }
    return poses;
}

// Poses at the borders between the sectors of the reference planes, and slightly beside them.
std::vector<Pose> seam_poses(int planes) {
    std::vector<Pose> poses;
    for (int k = 0; k < planes; ++k) {
        for (const double beside : {0.0, 1e-7, -1e-7, 3e-3}) {
            Pose pose;
            pose.azimuth = 2 * kPi * (k + 0.5) / planes + beside;
            pose.half_extent = k % 2 == 0 ? 0.05 : 1.1;
            pose.width = 33;
            pose.height = 9;
            poses.push_back(pose);
        }
    }
    return poses;
}

std::vector<Pose> extreme_poses() {
    std::vector<Pose> poses;
    for (const double distance : {1.02, 1.1, 1.4, 60.0, 199.0, 900.0}) {
        for (const double height : {-0.9, 0.0, 1.4}) {
            Pose pose;
            pose.distance = distance;
            pose.azimuth = distance;
            pose.eye_height = height;
            pose.half_extent = distance < 2 ? 2.5 : 1.1;
            pose.width = 29;
            pose.height = 41;
            poses.push_back(pose);
        }
    }
    return poses;
}

Result<ConformanceCase> make_case(const fs::path& folder, const std::string& name, const std::string& covers,
                                  RaySpaceObject object, const std::vector<Pose>& poses, TexelFilter filter) {
    object.rig_json.clear();  // not used by renderers
    ConformanceCase made{name, covers, name + ".rso", {}};
    if (Status status = write_object(folder / made.object, object); !status) return status.error();
    const Result<RaySpaceObject> read = read_object(folder / made.object);
    if (!read) return read.error();
    for (const Pose& pose : poses) {
        const Result<ViewRegisters> registers = prepare_view(*read, camera_of(*read, pose), filter);
        if (!registers) return registers.error();
        Image<Rgba8> image(registers->width, registers->height);
        Image<std::int32_t> depth(registers->width, registers->height);
        reconstruct_scalar(*read, *registers, image, depth);
        const auto shown = std::count_if(image.pixels().begin(), image.pixels().end(), [](Rgba8 p) { return p.a > 0; });
        made.views.push_back({*registers, hash_of(image.view()), hash_of(depth.view()), static_cast<int>(shown)});
    }
    return made;
}

RaySpaceObject without_images(RaySpaceObject object) {
    for (PlanarImage& image : object.images) image = {};
    return object;
}

// Object with 2-bit alpha, as the board stores it.
RaySpaceObject ring(const test::RingObjectOptions& options) {
    RaySpaceObject object = test::ring_object(options);
    for (PlanarImage& image : object.images) {
        for (std::uint8_t& a : image.a.pixels()) a = static_cast<std::uint8_t>((a * 3 + 127) / 255 * 85);
    }
    return object;
}

std::vector<encode::SourceImage> sources_of(const RaySpaceObject& object, int alpha_bits) {
    std::vector<encode::SourceImage> sources;
    for (const Image<Rgba8>& image : test::drawn_images(object)) {
        sources.push_back(encode::source_image(image, alpha_bits));
    }
    return sources;
}

RaySpaceObject dense(const test::RingObjectOptions& options, const encode::DenseSettings& settings) {
    RaySpaceObject object = without_images(ring(options));
    object.coded = std::make_shared<codec::CodedImages>(
        encode::encode_dense(object, sources_of(object, settings.alpha_bits), settings).coded);
    return object;
}

RaySpaceObject board(const test::RingObjectOptions& options, const encode::BoardSettings& settings) {
    RaySpaceObject object = without_images(ring(options));
    object.coded = std::make_shared<codec::CodedImages>(
        encode::encode_board(object, sources_of(object, settings.alpha_bits), settings).coded);
    return object;
}

// Replaces tiles by random bytes, to reach every branch of the decoder.
RaySpaceObject with_random_tiles(RaySpaceObject object, std::uint64_t seed, std::size_t most_bytes) {
    Random random(seed);
    codec::CodedImages coded = *object.coded;
    coded.dense.probabilities.fill(2048);
    for (codec::CodedImage& image : coded.images) {
        image.bytes.clear();
        for (codec::TileSpan& tile : image.tiles) {
            const auto size = static_cast<std::uint32_t>(random.whole(0, static_cast<int>(most_bytes)));
            tile = {static_cast<std::uint32_t>(image.bytes.size()), size, random.whole(0, 7) != 0};
            if (!tile.present) tile.size = 0;
            for (std::uint32_t i = 0; i < tile.size; ++i)
                image.bytes.push_back(static_cast<std::byte>(random.engine()));
        }
    }
    object.coded = std::make_shared<codec::CodedImages>(std::move(coded));
    return object;
}

RaySpaceObject with_shape(RaySpaceObject object, std::uint64_t seed, double empty_share) {
    std::mt19937_64 random(seed);
    object.rings[0].shape = test::random_shape(object, 0, random, empty_share);
    return object;
}

struct PlannedCase {
    const char* name;
    const char* covers;
    RaySpaceObject object;
    std::vector<Pose> poses;
    TexelFilter filter = TexelFilter::kBilinear;
};

std::vector<PlannedCase> planned_cases() {
    const test::RingObjectOptions small{
        .views = 9, .width = 40, .height = 34, .fl_px = 50, .planes = 5, .x_cells = 48, .u_cells = 32};
    const test::RingObjectOptions many{
        .views = 18, .width = 48, .height = 40, .planes = 12, .x_cells = 64, .u_cells = 48};
    const test::RingObjectOptions odd{
        .views = 5, .width = 37, .height = 29, .fl_px = 46, .planes = 3, .x_cells = 20, .u_cells = 70};
    test::RingObjectOptions close = small;  // the object exceeds its images: tests first and last column and row
    close.fl_px = 160;
    RaySpaceObject holes = ring(small);
    for (std::size_t i = 0; i < holes.rings[0].cells.size(); ++i) {
        if (i % 7 < 3) holes.rings[0].cells[i] = kNoImage;
    }
    RaySpaceObject clear = ring(small);
    for (std::size_t v = 0; v < clear.images.size(); ++v) {
        for (std::uint8_t& a : clear.images[v].a.pixels()) a = v % 3 == 0 ? 0 : (a < 128 ? a % 2 : 254 + a % 2);
    }
    test::RingObjectOptions shaped = many;
    shaped.views = 12;

    std::vector<PlannedCase> cases;
    cases.push_back({"plane-upright", "upright views by reference planes", ring(small), random_poses(1, 12, true)});
    cases.push_back(
        {"plane-twelve", "twelve planes, captured poses and those halfway", ring(many), ring_poses(18, 3.5, 10)});
    cases.push_back({"plane-tilted", "tilted views, set up pixel by pixel", ring(odd), random_poses(2, 8, false)});
    cases.push_back(
        {"plane-odd", "images of odd sizes: chroma at half size, rounded up", ring(odd), random_poses(3, 8, true)});
    cases.push_back(
        {"plane-seams", "rays between two planes, where n is equal or nearly so", ring(small), seam_poses(5)});
    cases.push_back({"plane-edges", "first and last columns and rows, rays beside the images", ring(close),
                     random_poses(4, 10, true)});
    cases.push_back(
        {"plane-extreme", "very near and very far viewpoints, steep compensation", ring(small), extreme_poses()});
    cases.push_back(
        {"plane-alpha", "alpha of 0, 1, 254 and 255; images that show nothing", clear, random_poses(5, 8, true)});
    cases.push_back({"plane-holes", "cells that no image answers", holes, random_poses(6, 8, true)});
    RaySpaceObject rings = test::small_object({.rings = 2, .views_per_ring = 6, .width = 20, .height = 18});
    cases.push_back({"two-rings", "two rings of views: the nearer one by elevation", rings, random_poses(7, 8, false)});
    cases.push_back(
        {"dense", "dense images, 2 bits of alpha, tiles of 64x64", dense(many, {}), random_poses(8, 8, true)});
    cases.push_back({"dense-small-tiles", "dense images, 4 bits of alpha, tiles of 16x32, coarse steps",
                     dense(many, {.step = 50, .alpha_bits = 4, .tile_width_log2 = 4, .tile_height_log2 = 5}),
                     random_poses(9, 8, true)});
    cases.push_back(
        {"dense-any-bytes", "dense tiles of random bytes",
         with_random_tiles(dense(odd, {.alpha_bits = 3, .tile_width_log2 = 4, .tile_height_log2 = 4}), 10, 300),
         random_poses(10, 8, true)});
    cases.push_back(
        {"board", "board images: two references, codebooks, motion", board(many, {}), random_poses(11, 8, true)});
    cases.push_back({"board-any-bytes",
                     "board tiles of random bytes: every class, motion out of the image, tiles cut short",
                     with_random_tiles(board(many, {.step = 30}), 12, 260), random_poses(12, 8, true)});
    for (int n = 0; n < 3; ++n) {
        static constexpr const char* kNames[] = {"shape", "shape-sparse", "shape-full"};
        constexpr double kEmpty[] = {0.4, 0.9, 0.02};
        cases.push_back({kNames[n], "a shape map: surfaces between cells, steps, bands",
                         with_shape(ring(shaped), 20 + static_cast<std::uint64_t>(n), kEmpty[n]),
                         random_poses(13 + static_cast<std::uint64_t>(n), 8, true)});
    }
    cases.push_back(
        {"shape-tilted", "a shape map in tilted views", with_shape(ring(odd), 31, 0.3), random_poses(17, 6, false)});
    cases.push_back({"shape-captured", "a shape map at captured poses: weights 0 and 256",
                     with_shape(ring(shaped), 32, 0.2), ring_poses(12, 3.5, 8)});
    cases.push_back({"shape-board", "a shape map with board images", with_shape(board(shaped, {}), 33, 0.2),
                     random_poses(18, 6, true)});
    RaySpaceObject middle = with_shape(ring(shaped), 34, 0.2);
    test::make_middle_opaque(middle);
    std::vector<Pose> around = random_poses(19, 6, true);
    for (const Pose& tilted : random_poses(20, 3, false)) around.push_back(tilted);
    cases.push_back({"shape-sharp", "the sharp filter, upright and tilted", middle, around, TexelFilter::kSharp});
    cases.push_back({"shape-smooth", "the smooth filter, upright and tilted", middle, around, TexelFilter::kSmooth});
    return cases;
}

Status make_all(const fs::path& folder, const std::string& edition) {
    VectorSet set{folder, edition, {}};
    for (const PlannedCase& planned : planned_cases()) {
        Result<ConformanceCase> made =
            make_case(folder, planned.name, planned.covers, planned.object, planned.poses, planned.filter);
        if (!made) return Error{std::string(planned.name) + ": " + made.error().message};
        int shown = 0;
        int pixels = 0;
        for (const ConformanceView& view : made->views) {
            shown += view.object_pixels;
            pixels += view.registers.width * view.registers.height;
        }
        std::printf("%-18s %2zu views, %6d of %6d pixels show the object\n", planned.name, made->views.size(), shown,
                    pixels);
        set.cases.push_back(std::move(*made));
    }
    return write_vectors(set);
}

}  // namespace
}  // namespace rs::engine

int main(int argc, char** argv) {
    if (argc != 3 || argv[1][0] == '-') {
        std::fprintf(stderr, "usage: make_conformance_vectors FOLDER EDITION\n");
        return 2;
    }
    std::filesystem::create_directories(argv[1]);
    const rs::Status status = rs::engine::make_all(argv[1], argv[2]);
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
