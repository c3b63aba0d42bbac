#pragma once
// Conversions between the project's images and OpenCV matrices. Only for .cpp files: no header that others include may
// need OpenCV.

#include "rayspace/image/image.hpp"
#include "rayspace/image/linear_light.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rs::capture {

/// Read-only view of the image's pixels as CV_8UC4 in the order R, G, B, A, without copying.
inline cv::Mat mat_view(ConstImageView<Rgba8> image) {
    return {image.height(), image.width(), CV_8UC4,
            const_cast<Rgba8*>(image.data()),  // cv::Mat has no constant variant
            static_cast<std::size_t>(image.stride()) * sizeof(Rgba8)};
}

/// The same, writable.
inline cv::Mat writable_mat_view(ImageView<Rgba8> image) {
    return mat_view(ConstImageView<Rgba8>(image));
}

/// View of the bytes of a mask or a grey image as CV_8UC1; likewise read-only.
inline cv::Mat1b mat_view(ConstImageView<std::uint8_t> mask) {
    return {mask.height(), mask.width(), const_cast<std::uint8_t*>(mask.data()),
            static_cast<std::size_t>(mask.stride())};
}

/// Bounding box of the non-zero pixels; empty if there are none.
inline cv::Rect bounding_box(const cv::Mat1b& mask) {
    cv::Rect box = cv::boundingRect(mask);
    if (box.empty()) return box;
    // cv::boundingRect() may miss columns 1 and 2 of rows whose address is not a multiple of four bytes (OpenCV bug
    // 24217).
    for (int x = box.br().x; x < std::min(3, mask.cols); ++x) {
        if (cv::countNonZero(mask.col(x)) > 0) box.width = x + 1 - box.x;
    }
    return box;
}

/// The same with a margin, clipped to the mask.
inline cv::Rect padded_bounding_box(const cv::Mat1b& mask, int beside_px) {
    const cv::Rect box = bounding_box(mask);
    if (box.empty()) return box;
    return cv::Rect(box.x - beside_px, box.y - beside_px, box.width + 2 * beside_px, box.height + 2 * beside_px) &
           cv::Rect({0, 0}, mask.size());
}

/// Converts to linear RGB, CV_32FC3.
inline cv::Mat3f linear_mat(ConstImageView<Rgba8> image) {
    cv::Mat3f linear(image.height(), image.width());
    for (int y = 0; y < image.height(); ++y) {
        const Rgba8* from = image.row(y);
        cv::Vec3f* to = linear[y];
        for (int x = 0; x < image.width(); ++x)
            to[x] = {linear_from_srgb8(from[x].r), linear_from_srgb8(from[x].g), linear_from_srgb8(from[x].b)};
    }
    return linear;
}

inline Rgba8 rgba8_from_linear(const cv::Vec3f& light, std::uint8_t alpha) {
    return {srgb8_by_table(light[0]), srgb8_by_table(light[1]), srgb8_by_table(light[2]), alpha};
}

}  // namespace rs::capture
