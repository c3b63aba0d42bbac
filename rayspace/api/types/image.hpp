#pragma once
/// \file
/// Image<T> owns pixels; ImageView<T> and ConstImageView<T> are the non-owning strided views that functions take.
///
/// Memory layout: pixel (x, y) of a view is at data[y * stride + x], row 0 on top; `stride` counts elements, not bytes,
/// and may be larger than the width. Image<T> is dense: stride == width. Views do not keep their pixels alive.

#include "rayspace/api/types/check.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace rs {

/// Non-owning strided view of pixels. Copies are cheap.
template <class T>
class ImageView {
public:
    /// No pixels.
    ImageView() = default;
    /// \param data    pixel (0, 0)
    /// \param width   >= 0, elements
    /// \param height  >= 0, rows
    /// \param stride  >= width, elements from one row to the next
    ImageView(T* data, int width, int height, std::ptrdiff_t stride)
        : data_(data), width_(width), height_(height), stride_(stride) {
        RS_CHECK(width >= 0 && height >= 0 && stride >= width);
    }
    /// A view of mutable pixels is also a view of constant ones.
    template <class U>
    requires(std::is_same_v<const U, T> && !std::is_same_v<U, T>) ImageView(const ImageView<U>& other)
        : data_(other.data()), width_(other.width()), height_(other.height()), stride_(other.stride()) {}

    /// Pixel (0, 0).
    [[nodiscard]] T* data() const { return data_; }
    /// Width in pixels.
    [[nodiscard]] int width() const { return width_; }
    /// Height in pixels.
    [[nodiscard]] int height() const { return height_; }
    /// Elements from one row to the next.
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
    /// True if there is no pixel.
    [[nodiscard]] bool empty() const { return width_ == 0 || height_ == 0; }

    /// First pixel of row `y`, 0..height-1; not checked.
    [[nodiscard]] T* row(int y) const { return data_ + y * stride_; }
    /// Pixels of row `y`, 0..height-1; not checked.
    [[nodiscard]] std::span<T> row_span(int y) const { return {row(y), static_cast<std::size_t>(width_)}; }
    /// Pixel (x, y), which must be inside; not checked.
    T& operator()(int x, int y) const { return data_[y * stride_ + x]; }

    /// The rectangle [x, x + width) x [y, y + height); aborts if it is not inside.
    [[nodiscard]] ImageView crop(int x, int y, int width, int height) const {
        RS_CHECK(x >= 0 && y >= 0 && x + width <= width_ && y + height <= height_);
        return {data_ + y * stride_ + x, width, height, stride_};
    }

private:
    T* data_ = nullptr;
    int width_ = 0;
    int height_ = 0;
    std::ptrdiff_t stride_ = 0;
};

/// View of constant pixels.
template <class T>
using ConstImageView = ImageView<const T>;

/// Owner of width x height pixels without gaps.
template <class T>
class Image {
public:
    /// No pixels.
    Image() = default;
    /// width x height pixels (both >= 0), each equal to `fill`.
    Image(int width, int height, T fill = T{})
        : pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill),
          width_(width),
          height_(height) {
        RS_CHECK(width >= 0 && height >= 0);
    }

    /// Width in pixels.
    [[nodiscard]] int width() const { return width_; }
    /// Height in pixels.
    [[nodiscard]] int height() const { return height_; }
    /// True if there is no pixel.
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    /// Pixel (0, 0).
    [[nodiscard]] T* data() { return pixels_.data(); }
    /// Pixel (0, 0).
    [[nodiscard]] const T* data() const { return pixels_.data(); }
    /// All pixels, row by row.
    [[nodiscard]] std::span<T> pixels() { return pixels_; }
    /// All pixels, row by row.
    [[nodiscard]] std::span<const T> pixels() const { return pixels_; }

    /// Pixel (x, y), which must be inside; not checked.
    T& operator()(int x, int y) { return pixels_[index(x, y)]; }
    /// Pixel (x, y), which must be inside; not checked.
    const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }
    /// First pixel of row `y`, 0..height-1; not checked.
    [[nodiscard]] T* row(int y) { return pixels_.data() + index(0, y); }
    /// First pixel of row `y`, 0..height-1; not checked.
    [[nodiscard]] const T* row(int y) const { return pixels_.data() + index(0, y); }

    /// View of all pixels.
    [[nodiscard]] ImageView<T> view() { return {pixels_.data(), width_, height_, width_}; }
    /// View of all pixels.
    [[nodiscard]] ConstImageView<T> view() const { return {pixels_.data(), width_, height_, width_}; }
    /// View of all pixels.
    operator ImageView<T>() { return view(); }
    /// View of all pixels.
    operator ConstImageView<T>() const { return view(); }

    /// True if sizes and all pixels are equal.
    bool operator==(const Image&) const = default;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    std::vector<T> pixels_;
    int width_ = 0;
    int height_ = 0;
};

/// 8-bit sRGB pixel with straight alpha, in memory order R, G, B, A. Alpha is linear coverage.
struct Rgba8 {
    std::uint8_t r = 0;                             ///< red
    std::uint8_t g = 0;                             ///< green
    std::uint8_t b = 0;                             ///< blue
    std::uint8_t a = 0;                             ///< alpha: 0 transparent, 255 opaque
    bool operator==(const Rgba8&) const = default;  ///< equal in all four channels
};
static_assert(sizeof(Rgba8) == 4);

}  // namespace rs
