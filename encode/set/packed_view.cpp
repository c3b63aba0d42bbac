#include "encode/set/packed_view.hpp"

#include <algorithm>
#include <iterator>
#include <span>

namespace rs::encode {

PackedView::PackedView(const SynthesizedView& view)
    : width_(view.image.width()), rows_(static_cast<std::size_t>(view.image.height())) {
    RS_CHECK(view.depth.width() == view.image.width() && view.depth.height() == view.image.height());
    const auto is_visible = [](const Rgba8& pixel) { return pixel.a != 0; };
    std::size_t count = 0;
    for (std::size_t y = 0; y < rows_.size(); ++y) {
        const std::span<const Rgba8> row = view.image.view().row_span(static_cast<int>(y));
        const auto first = std::ranges::find_if(row, is_visible);
        if (first == row.end()) continue;
        const auto last = std::find_if(row.rbegin(), row.rend(), is_visible).base();
        rows_[y] = {static_cast<int>(first - row.begin()), static_cast<int>(last - row.begin()), count};
        count += static_cast<std::size_t>(last - first);
    }
    colours_.reserve(count);
    depths_.reserve(count);
    for (std::size_t y = 0; y < rows_.size(); ++y) {
        const Rgba8* const colours = view.image.row(static_cast<int>(y));
        const float* const depths = view.depth.row(static_cast<int>(y));
        colours_.insert(colours_.end(), colours + rows_[y].begin, colours + rows_[y].end);
        depths_.insert(depths_.end(), depths + rows_[y].begin, depths + rows_[y].end);
    }
}

template <class T>
Image<T> PackedView::unpacked(const std::vector<T>& stored) const {
    Image<T> image(width_, static_cast<int>(rows_.size()), T{});
    for (std::size_t y = 0; y < rows_.size(); ++y) {
        const Row& row = rows_[y];
        std::copy_n(stored.begin() + static_cast<std::ptrdiff_t>(row.first), row.end - row.begin,
                    image.row(static_cast<int>(y)) + row.begin);
    }
    return image;
}

Image<Rgba8> PackedView::image() const {
    return unpacked(colours_);
}

Image<float> PackedView::depth() const {
    return unpacked(depths_);
}

}  // namespace rs::encode
