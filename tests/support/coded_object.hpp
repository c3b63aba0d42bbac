#pragma once
// A small object whose pictures are coded: the drawn balls of drawn_set.hpp seen from a ring.

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/small_object.hpp"

#include <memory>
#include <vector>

namespace rs::test {

// `object` without its raw pictures, of drawn ones; any size.
inline std::vector<Image<Rgba8>> drawn_pictures(const RaySpaceObject& object) {
    Rig rig = make_ring({.count = static_cast<int>(object.views.size()),
                         .fl_px = 1.3 * object.width,
                         .width = object.width,
                         .height = object.height});
    std::vector<Image<Rgba8>> pictures;
    for (const RigView& view : rig.views) pictures.push_back(drawn_picture(view.camera));
    return pictures;
}

inline codec::CodedPictures code_pictures(const RaySpaceObject& object, const std::vector<Image<Rgba8>>& pictures,
                                          const encode::DenseSettings& settings) {
    return encode::encode_dense(
        object, [&](int view) { return pictures[static_cast<std::size_t>(view)]; }, settings);
}

inline codec::CodedPictures code_board_pictures(const RaySpaceObject& object, const std::vector<Image<Rgba8>>& pictures,
                                                const encode::BoardSettings& settings) {
    std::vector<encode::SourcePicture> sources;
    for (const Image<Rgba8>& picture : pictures) {
        sources.push_back(encode::source_picture(picture.view(), settings.alpha_bits));
    }
    return encode::encode_board(object, sources, settings).coded;
}

inline RaySpaceObject coded_object(const SmallObjectOptions& options, const encode::DenseSettings& settings) {
    RaySpaceObject object = small_object(options);
    for (PlanarPicture& picture : object.pictures) picture = {};
    object.coded = std::make_shared<codec::CodedPictures>(code_pictures(object, drawn_pictures(object), settings));
    return object;
}

inline RaySpaceObject board_object(const SmallObjectOptions& options, const encode::BoardSettings& settings) {
    RaySpaceObject object = small_object(options);
    for (PlanarPicture& picture : object.pictures) picture = {};
    object.coded =
        std::make_shared<codec::CodedPictures>(code_board_pictures(object, drawn_pictures(object), settings));
    return object;
}

}  // namespace rs::test
