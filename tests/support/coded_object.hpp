#pragma once
// A small object whose images are coded: the drawn balls of drawn_set.hpp seen from a ring.

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/small_object.hpp"

#include <memory>
#include <vector>

namespace rs::test {

/// Drawn images for the views of `object`, of any size.
inline std::vector<Image<Rgba8>> drawn_images(const RaySpaceObject& object) {
    Rig rig = make_ring({.count = static_cast<int>(object.views.size()),
                         .fl_px = 1.3 * object.width,
                         .width = object.width,
                         .height = object.height});
    std::vector<Image<Rgba8>> images;
    for (const RigView& view : rig.views) images.push_back(draw_image(view.camera));
    return images;
}

inline codec::CodedImages code_images(const RaySpaceObject& object, const std::vector<Image<Rgba8>>& images,
                                      const encode::DenseSettings& settings) {
    return encode::encode_dense(
        object, [&](int view) { return images[static_cast<std::size_t>(view)]; }, settings);
}

inline codec::CodedImages code_board_images(const RaySpaceObject& object, const std::vector<Image<Rgba8>>& images,
                                            const encode::BoardSettings& settings) {
    std::vector<encode::SourceImage> sources;
    for (const Image<Rgba8>& image : images) {
        sources.push_back(encode::source_image(image.view(), settings.alpha_bits));
    }
    return encode::encode_board(object, sources, settings).coded;
}

inline RaySpaceObject coded_object(const SmallObjectOptions& options, const encode::DenseSettings& settings) {
    RaySpaceObject object = small_object(options);
    for (PlanarImage& image : object.images) image = {};
    object.coded = std::make_shared<codec::CodedImages>(code_images(object, drawn_images(object), settings));
    return object;
}

inline RaySpaceObject board_object(const SmallObjectOptions& options, const encode::BoardSettings& settings) {
    RaySpaceObject object = small_object(options);
    for (PlanarImage& image : object.images) image = {};
    object.coded = std::make_shared<codec::CodedImages>(code_board_images(object, drawn_images(object), settings));
    return object;
}

}  // namespace rs::test
