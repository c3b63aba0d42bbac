#include "encode/set/upright_resampling.hpp"

#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/image/premultiplied_sampling.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace rs::encode {
namespace {

// [first, last) columns that hold all pixels of the row with alpha above 0.
std::optional<std::pair<int, int>> occupied_columns(std::span<const Rgba8> row) {
    const auto opaque = [](const Rgba8& p) { return p.a != 0; };
    const auto first = std::find_if(row.begin(), row.end(), opaque);
    if (first == row.end()) return std::nullopt;
    const auto last = std::find_if(row.rbegin(), row.rend(), opaque);
    return std::pair(static_cast<int>(first - row.begin()), static_cast<int>(row.rend() - last));
}

}  // namespace

void PixelBox::include(double x, double y) {
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
}

PixelBox find_occupied_box(ConstImageView<Rgba8> image) {
    PixelBox box;
    for (int y = 0; y < image.height(); ++y) {
        if (const auto span = occupied_columns(image.row_span(y))) {
            box.include(span->first, y);
            box.include(span->second, y + 1);
        }
    }
    return box;
}

std::optional<PixelBox> project_occupied_box(const Camera& to, const Camera& from, ConstImageView<Rgba8> image) {
    const glm::dmat3 to_from_from = pixel_in_to_from_pixel_in_from(to, from);
    PixelBox seen;
    for (int y = 0; y < image.height(); ++y) {
        const auto span = occupied_columns(image.row_span(y));
        if (!span) continue;
        for (const int x : {span->first, span->second}) {
            for (const int edge : {y, y + 1}) {
                const glm::dvec3 p = to_from_from * glm::dvec3(x, edge, 1);
                if (p.z <= 0) return std::nullopt;
                seen.include(p.x / p.z, p.y / p.z);
            }
        }
    }
    return seen;
}

Image<Rgba8> resample_image(const Camera& to, const Camera& from, ConstImageView<Rgba8> image) {
    Image<Rgba8> result(to.width, to.height);
    const glm::dmat3 from_from_to = pixel_in_to_from_pixel_in_from(from, to);
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const glm::dvec3 p = from_from_to * glm::dvec3(x + 0.5, y + 0.5, 1);
            const glm::dvec3 ray = to.ray(x + 0.5, y + 0.5);
            if (glm::dot(ray, from.forward()) <= 0) continue;
            const double px = p.x / p.z;
            const double py = p.y / p.z;
            if (px < -1 || py < -1 || px > image.width() + 1 || py > image.height() + 1) continue;
            result(x, y) = sample_premultiplied(image, px, py);
        }
    }
    return result;
}

}  // namespace rs::encode
