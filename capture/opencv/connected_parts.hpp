#pragma once
// The connected parts of a mask, by OpenCV, and what is asked of them. Only for .cpp files, as opencv_image.hpp is.

#include "capture/opencv/opencv_image.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

// A value for each part of a mask, T{} at first; one more, of label 0, for what is outside all parts.
template <class T>
class PerPart {
public:
    explicit PerPart(int count) : values_(static_cast<std::size_t>(count)) {}
    [[nodiscard]] T& operator[](int label) { return values_[static_cast<std::size_t>(label)]; }
    [[nodiscard]] const T& operator[](int label) const { return values_[static_cast<std::size_t>(label)]; }
    // Of the parts alone, by label.
    [[nodiscard]] auto begin() const { return values_.begin() + 1; }
    [[nodiscard]] auto end() const { return values_.end(); }

private:
    std::vector<T> values_;
};

// Connected parts of a binary picture; label 0 is what is outside all parts.
class ConnectedParts {
public:
    ConnectedParts(const cv::Mat1b& picture, int connectivity)
        : ConnectedParts(picture, connectivity, cv::Rect({0, 0}, picture.size())) {}
    // The parts of what `mask` leaves bare, by 4 neighbours, in the box around it and a pixel beside: what reaches the
    // box' border reaches the picture's, for beyond all is bare, and that border is the one asked about below.
    static ConnectedParts left_bare(const cv::Mat1b& mask) {
        const cv::Rect within = box_around(mask, 1);
        cv::Mat1b bare(mask.size(), std::uint8_t{0});
        if (!within.empty()) cv::bitwise_not(mask(within), bare(within));
        return {bare, 4, within};
    }
    [[nodiscard]] int count() const { return count_; }  // labels, 0 among them
    // Of a pixel of the picture.
    [[nodiscard]] int label(int x, int y) const { return box_.contains({x, y}) ? labels_(y - box_.y, x - box_.x) : 0; }
    // What follows is asked of parts, of labels from 1 on.
    [[nodiscard]] int area(int label) const { return stats_.at<int>(label, cv::CC_STAT_AREA); }
    // Of the picture that a part comes so near to, a bit each.
    [[nodiscard]] unsigned sides(int label, int near_px) const {
        const int x = box_.x - within_.x + stats_.at<int>(label, cv::CC_STAT_LEFT);
        const int y = box_.y - within_.y + stats_.at<int>(label, cv::CC_STAT_TOP);
        const int right = within_.width - x - stats_.at<int>(label, cv::CC_STAT_WIDTH);
        const int below = within_.height - y - stats_.at<int>(label, cv::CC_STAT_HEIGHT);
        return (x <= near_px ? 1U : 0U) | (y <= near_px ? 2U : 0U) | (right <= near_px ? 4U : 0U) |
               (below <= near_px ? 8U : 0U);
    }
    [[nodiscard]] bool touches_border(int label) const { return sides(label, 0) != 0; }
    [[nodiscard]] bool share_columns(int a, int b) const {
        const int left_a = stats_.at<int>(a, cv::CC_STAT_LEFT), left_b = stats_.at<int>(b, cv::CC_STAT_LEFT);
        return left_a < left_b + stats_.at<int>(b, cv::CC_STAT_WIDTH) &&
               left_b < left_a + stats_.at<int>(a, cv::CC_STAT_WIDTH);
    }
    [[nodiscard]] int height(int label) const { return stats_.at<int>(label, cv::CC_STAT_HEIGHT); }
    // How many rows are free between part `a` and part `b` below it; less than 0 where it is not all above.
    [[nodiscard]] int rows_above(int a, int b) const {
        return stats_.at<int>(b, cv::CC_STAT_TOP) - stats_.at<int>(a, cv::CC_STAT_TOP) - height(a);
    }

    // Calls `visit(x, y, label)` of every pixel of a part, row by row.
    template <class Visit>
    void for_each_pixel(Visit visit) const {
        for (int y = 0; y < labels_.rows; ++y) {
            for (int x = 0; x < labels_.cols; ++x) {
                if (labels_(y, x) != 0) visit(box_.x + x, box_.y + y, labels_(y, x));
            }
        }
    }
    // Calls `visit(x, y, label)` of every pixel of a part at the picture's border, once.
    template <class Visit>
    void for_each_pixel_at_border(Visit visit) const {
        const int right = within_.width - 1, below = within_.height - 1;
        const auto look_at = [&](int in_x, int in_y) {
            const int x = within_.x + in_x, y = within_.y + in_y;
            if (const int of_part = label(x, y)) visit(x, y, of_part);
        };
        for (int y = 0; y <= below; ++y) {
            const int step = y == 0 || y == below ? 1 : std::max(1, right);
            for (int x = 0; x <= right; x += step) look_at(x, y);
        }
    }
    // What `count(x, y, of_part)` adds up of all pixels of each part.
    template <class T, class Count>
    [[nodiscard]] PerPart<T> tallied(Count count) const {
        PerPart<T> tallies(count_);
        for_each_pixel([&](int x, int y, int label) { count(x, y, tallies[label]); });
        return tallies;
    }

private:
    ConnectedParts(const cv::Mat1b& picture, int connectivity, const cv::Rect& within)
        : within_(within), box_(box_of(picture)) {
        if (box_.empty()) return;
        // OpenCV numbers parts by squares of 2 x 2 pixels: so they have the numbers that they have in the whole
        // picture.
        box_ += cv::Size(box_.x % 2, box_.y % 2);
        box_ -= cv::Point(box_.x % 2, box_.y % 2);
        cv::Mat centroids;
        count_ = cv::connectedComponentsWithStats(picture(box_), labels_, stats_, centroids, connectivity);
    }

    cv::Rect within_;  // whose border counts
    cv::Rect box_;     // of all parts, in the picture: outside of it nothing is looked at
    int count_ = 1;
    cv::Mat1i labels_;  // of the box
    cv::Mat stats_;     // by label; places count from the box' corner
};

}  // namespace rs::capture
