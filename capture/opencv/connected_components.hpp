#pragma once
/// \file
/// Connected components of a binary mask, by OpenCV, with their areas and per-component accumulation.
///
/// Only for .cpp files, like opencv_image.hpp: no header that others include may need OpenCV.

#include "capture/opencv/opencv_image.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

/// One value per component, initially T{}, and one for label 0, the background.
template <class T>
class PerComponent {
public:
    /// `count`: labels including 0, as ConnectedComponents::count() returns.
    explicit PerComponent(int count) : values_(static_cast<std::size_t>(count)) {}
    [[nodiscard]] T& operator[](int label) { return values_[static_cast<std::size_t>(label)]; }
    [[nodiscard]] const T& operator[](int label) const { return values_[static_cast<std::size_t>(label)]; }
    /// Iteration by label over the components alone, without label 0.
    [[nodiscard]] auto begin() const { return values_.begin() + 1; }
    [[nodiscard]] auto end() const { return values_.end(); }

private:
    std::vector<T> values_;
};

/// Components of the non-zero pixels of a mask. Label 0 is the background, components have labels from 1 on, numbered
/// as cv::connectedComponents() numbers them in the whole mask.
class ConnectedComponents {
public:
    /// `connectivity`: 4 or 8.
    ConnectedComponents(const cv::Mat1b& mask, int connectivity)
        : ConnectedComponents(mask, connectivity, cv::Rect({0, 0}, mask.size())) {}

    /// 4-connected components of the zero pixels of `mask`. Only the bounding box of the mask plus one pixel is
    /// labelled, and its border represents the image border: everything beyond it is zero, so that a component that
    /// reaches the box border also reaches the image border. Pixels outside the box have label 0.
    static ConnectedComponents of_complement(const cv::Mat1b& mask) {
        const cv::Rect frame = padded_bounding_box(mask, 1);
        cv::Mat1b complement(mask.size(), std::uint8_t{0});
        if (!frame.empty()) cv::bitwise_not(mask(frame), complement(frame));
        return {complement, 4, frame};
    }

    /// Number of labels, including 0.
    [[nodiscard]] int count() const { return count_; }
    /// Label of an image pixel.
    [[nodiscard]] int label(int x, int y) const { return box_.contains({x, y}) ? labels_(y - box_.y, x - box_.x) : 0; }
    /// Area in px of a component, label >= 1.
    [[nodiscard]] int area(int label) const { return stats_.at<int>(label, cv::CC_STAT_AREA); }
    /// True if a component, label >= 1, has a pixel on the image border.
    [[nodiscard]] bool touches_border(int label) const {
        const cv::Rect bounds(box_.x + stats_.at<int>(label, cv::CC_STAT_LEFT),
                              box_.y + stats_.at<int>(label, cv::CC_STAT_TOP), stats_.at<int>(label, cv::CC_STAT_WIDTH),
                              stats_.at<int>(label, cv::CC_STAT_HEIGHT));
        return bounds.x <= frame_.x || bounds.y <= frame_.y || bounds.br().x >= frame_.br().x ||
               bounds.br().y >= frame_.br().y;
    }

    /// Calls `visit(x, y, label)` for every component pixel, row by row.
    template <class Visit>
    void for_each_pixel(Visit visit) const {
        for (int y = 0; y < labels_.rows; ++y) {
            for (int x = 0; x < labels_.cols; ++x) {
                if (labels_(y, x) != 0) visit(box_.x + x, box_.y + y, labels_(y, x));
            }
        }
    }

    /// Calls `visit(x, y, label)` once for every component pixel on the image border.
    template <class Visit>
    void for_each_border_pixel(Visit visit) const {
        const int last_x = frame_.width - 1, last_y = frame_.height - 1;
        for (int v = 0; v <= last_y; ++v) {
            const int step = v == 0 || v == last_y ? 1 : std::max(1, last_x);
            for (int u = 0; u <= last_x; u += step) {
                const int x = frame_.x + u, y = frame_.y + v;
                if (const int component = label(x, y)) visit(x, y, component);
            }
        }
    }

    /// Calls `add(x, y, value)` for every component pixel with the value of its component and returns the values.
    template <class T, class Add>
    [[nodiscard]] PerComponent<T> accumulate(Add add) const {
        PerComponent<T> values(count_);
        for_each_pixel([&](int x, int y, int label) { add(x, y, values[label]); });
        return values;
    }

private:
    ConnectedComponents(const cv::Mat1b& mask, int connectivity, const cv::Rect& frame)
        : frame_(frame), box_(bounding_box(mask)) {
        if (box_.empty()) return;
        // OpenCV numbers components by blocks of 2 x 2 pixels: an even corner keeps the numbers of the whole mask.
        box_ += cv::Size(box_.x % 2, box_.y % 2);
        box_ -= cv::Point(box_.x % 2, box_.y % 2);
        cv::Mat centroids;
        count_ = cv::connectedComponentsWithStats(mask(box_), labels_, stats_, centroids, connectivity);
    }

    cv::Rect frame_;  // whose border counts as the image border
    cv::Rect box_;    // bounding box of all components, with an even corner
    int count_ = 1;
    cv::Mat1i labels_;  // of box_
    cv::Mat stats_;     // [label], positions relative to box_
};

}  // namespace rs::capture
