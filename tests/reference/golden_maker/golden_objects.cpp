#include "tests/reference/golden_maker/golden_objects.hpp"

#include "rayspace/api/types/check.hpp"
#include "tests/reference/random_stream.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/small_shape.hpp"

#include <memory>
#include <utility>

namespace rs::golden {
namespace {

using reference::Profile;

// 3 views per ring; maps of 2 x 3 cells, as required by geometry_damage.cpp and shape_damage.cpp.
test::SmallObjectOptions smallest(int rings) {
    test::SmallObjectOptions options;
    options.rings = rings;
    options.views_per_ring = 3;
    options.planes = 3;
    options.x_cells = 2;
    options.u_cells = 3;
    options.width = 5;
    options.height = 3;
    return options;
}

RaySpaceObject raw_with_shape() {
    RaySpaceObject object = test::small_object(smallest(2));
    object.rings[1].shape = test::small_shape(object, 1, {.p_cells = 5, .bands = 3, .lines = {2, 0, 1}});
    return object;
}

RaySpaceObject with_foot(RaySpaceObject object) {
    object.foot_q20 = -700000;
    return object;
}

// The second ring surrounds the object's X axis: a quarter turn about Z.
RaySpaceObject raw_with_axis() {
    RaySpaceObject object = test::small_object(smallest(2));
    object.rings[1].rotation = {.z_q30 = 759250125, .w_q30 = 759250125};
    return object;
}

struct DrawnSize {
    int width, height, views, rings;
    bool has_shape;
};

RaySpaceObject without_images(const DrawnSize& size) {
    test::SmallObjectOptions options;
    options.width = size.width;
    options.height = size.height;
    options.views_per_ring = size.views;
    options.rings = size.rings;
    RaySpaceObject object = size.has_shape ? test::small_object_with_shape(options) : test::small_object(options);
    for (PlanarImage& image : object.images) image = {};
    return object;
}

RaySpaceObject dense(const DrawnSize& size, int tile_width_log2, int tile_height_log2, int alpha_bits, double step) {
    RaySpaceObject object = without_images(size);
    encode::DenseSettings settings;
    settings.tile_width_log2 = tile_width_log2;
    settings.tile_height_log2 = tile_height_log2;
    settings.alpha_bits = alpha_bits;
    settings.step = step;
    object.coded =
        std::make_shared<codec::CodedImages>(test::code_images(object, test::drawn_images(object), settings));
    return object;
}

RaySpaceObject board(const DrawnSize& size, double step) {
    RaySpaceObject object = without_images(size);
    encode::BoardSettings settings;
    settings.step = step;
    object.coded =
        std::make_shared<codec::CodedImages>(test::code_board_images(object, test::drawn_images(object), settings));
    return object;
}

// A random stream that has an image with two references, tiles that do not fill the last byte of their list, and all
// four levels, and that has between half of `most_bytes` and `most_bytes` bytes; dense images have the given alpha
// coding, with all features for masks and none otherwise.
RaySpaceObject random_object(Profile profile, std::size_t most_bytes, bool has_masks = false) {
    for (std::uint64_t seed = 1; seed < 100000; ++seed) {
        const reference::Stream stream = reference::random_stream(seed, profile);
        std::size_t bytes = stream.code.size();
        for (const auto& pict : stream.picts) bytes += pict.size();
        if (bytes > most_bytes || 2 * bytes < most_bytes) continue;
        auto coded = std::make_shared<codec::CodedImages>();
        RS_CHECK(reference::parse_stream(stream, *coded).empty());
        bool has_two = false;
        for (const codec::CodedImage& image : coded->images) has_two |= image.head.references() == 2;
        unsigned levels = 0;
        for (const std::uint8_t level : coded->levels) levels |= 1U << level;
        const std::size_t tiles = coded->images[0].tiles.size();
        const bool is_tame = profile == Profile::kBoard || coded->dense.probabilities[0] != 2048;
        if (!has_two || tiles % 8 == 0 || tiles < 2 || levels != 15 || !is_tame) continue;
        const codec::DenseCode& dense = coded->dense;
        const bool is_wanted = dense.has_masks == has_masks && dense.deblocking == has_masks &&
                               dense.adaptation == has_masks && dense.sign_data_hiding == has_masks;
        if (profile == Profile::kDense && !is_wanted) continue;
        RaySpaceObject object =
            without_images({coded->width, coded->height, static_cast<int>(coded->images.size()), 1, false});
        object.coded = coded;
        return object;
    }
    RS_CHECK(false);
    return {};
}

}  // namespace

std::vector<GoldenObject> golden_objects() {
    test::SmallObjectOptions odd;
    odd.width = 33;
    odd.height = 21;
    std::vector<GoldenObject> objects;
    objects.push_back({"raw", test::small_object(smallest(1)), true});
    objects.push_back({"raw-shape", raw_with_shape()});
    objects.push_back({"raw-axis", raw_with_axis()});
    objects.push_back({"raw-33x21-foot", with_foot(test::small_object(odd))});
    objects.push_back({"dense-16x16-alpha1", dense({70, 50, 9, 1, false}, 4, 4, 1, 4)});
    objects.push_back({"dense-32x32-alpha2-shape", dense({100, 64, 8, 1, true}, 5, 5, 2, 12)});
    objects.push_back({"dense-64x16-alpha4", dense({97, 33, 6, 2, false}, 6, 4, 4, 30)});
    objects.push_back({"dense-64x64-alpha3", dense({128, 96, 9, 1, false}, 6, 6, 3, 8)});
    objects.push_back({"dense-32x64-alpha6", dense({90, 70, 8, 1, false}, 5, 6, 6, 16)});
    objects.push_back({"board", board({96, 80, 9, 1, false}, 12)});
    objects.push_back({"board-shape", board({70, 50, 10, 1, true}, 24)});
    for (const auto& [name, has_masks] : {std::pair{"dense-random", false}, std::pair{"dense-random-masks", true}}) {
        objects.push_back({name, random_object(Profile::kDense, 50000, has_masks)});
        objects.push_back({std::string(name) + "-small", random_object(Profile::kDense, 8000, has_masks)});
    }
    objects.push_back({"board-random", random_object(Profile::kBoard, 30000)});
    objects.push_back({"board-random-small", random_object(Profile::kBoard, 8000)});
    return objects;
}

}  // namespace rs::golden
