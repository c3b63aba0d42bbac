#pragma once
// The connected parts of a mask, by OpenCV, and what is asked of them. Only for .cpp files, as opencv_image.hpp is.

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
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
    ConnectedParts(const cv::Mat1b& picture, int connectivity) {
        count_ = cv::connectedComponentsWithStats(picture, labels_, stats_, centroids_, connectivity);
    }
    [[nodiscard]] int count() const { return count_; }  // labels, 0 among them
    [[nodiscard]] int label(int x, int y) const { return labels_(y, x); }
    [[nodiscard]] int area(int label) const { return stats_.at<int>(label, cv::CC_STAT_AREA); }
    // Of the picture that a part comes so near to, a bit each.
    [[nodiscard]] unsigned sides(int label, int near_px) const {
        const int x = stats_.at<int>(label, cv::CC_STAT_LEFT);
        const int y = stats_.at<int>(label, cv::CC_STAT_TOP);
        const int right = labels_.cols - x - stats_.at<int>(label, cv::CC_STAT_WIDTH);
        const int below = labels_.rows - y - stats_.at<int>(label, cv::CC_STAT_HEIGHT);
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
                if (labels_(y, x) != 0) visit(x, y, labels_(y, x));
            }
        }
    }
    // Calls `visit(x, y, label)` of every pixel of a part at the picture's border, once.
    template <class Visit>
    void for_each_pixel_at_border(Visit visit) const {
        const int right = labels_.cols - 1, below = labels_.rows - 1;
        const auto look_at = [&](int x, int y) {
            if (labels_(y, x) != 0) visit(x, y, labels_(y, x));
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
    int count_ = 0;
    cv::Mat1i labels_;
    cv::Mat stats_;
    cv::Mat centroids_;
};

}  // namespace rs::capture
