#pragma once
// Image<T> owns pixels; ImageView<T> and ConstImageView<T> are the non-owning strided views that algorithms take.
//
// Memory layout: pixel (x, y) of a view is data[y * stride + x]; `stride` counts elements, not bytes, and may be larger
// than the width. Image<T> is dense: stride == width. Views do not keep their pixels alive.

#include "rayspace/base/check.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace rs {

template <class T>
class ImageView {
public:
    ImageView() = default;
    ImageView(T* data, int width, int height, std::ptrdiff_t stride)
        : data_(data), width_(width), height_(height), stride_(stride) {
        RS_CHECK(width >= 0 && height >= 0 && stride >= width);
    }
    // Conversion from a view of mutable pixels.
    template <class U>
    requires(std::is_same_v<const U, T> && !std::is_same_v<U, T>) ImageView(const ImageView<U>& other)
        : data_(other.data()), width_(other.width()), height_(other.height()), stride_(other.stride()) {}

    [[nodiscard]] T* data() const { return data_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
    [[nodiscard]] bool empty() const { return width_ == 0 || height_ == 0; }

    [[nodiscard]] T* row(int y) const { return data_ + y * stride_; }
    [[nodiscard]] std::span<T> row_span(int y) const { return {row(y), static_cast<std::size_t>(width_)}; }
    T& operator()(int x, int y) const { return data_[y * stride_ + x]; }

    /// The rectangle [x, x + width) x [y, y + height), which must be inside.
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

template <class T>
using ConstImageView = ImageView<const T>;

template <class T>
class Image {
public:
    Image() = default;
    /// Fills every pixel with `fill`.
    Image(int width, int height, T fill = T{})
        : pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill),
          width_(width),
          height_(height) {
        RS_CHECK(width >= 0 && height >= 0);
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    [[nodiscard]] T* data() { return pixels_.data(); }
    [[nodiscard]] const T* data() const { return pixels_.data(); }
    [[nodiscard]] std::span<T> pixels() { return pixels_; }
    [[nodiscard]] std::span<const T> pixels() const { return pixels_; }

    T& operator()(int x, int y) { return pixels_[index(x, y)]; }
    const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }
    [[nodiscard]] T* row(int y) { return pixels_.data() + index(0, y); }
    [[nodiscard]] const T* row(int y) const { return pixels_.data() + index(0, y); }

    [[nodiscard]] ImageView<T> view() { return {pixels_.data(), width_, height_, width_}; }
    [[nodiscard]] ConstImageView<T> view() const { return {pixels_.data(), width_, height_, width_}; }
    operator ImageView<T>() { return view(); }
    operator ConstImageView<T>() const { return view(); }

    bool operator==(const Image&) const = default;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    std::vector<T> pixels_;
    int width_ = 0;
    int height_ = 0;
};

/// One 8-bit sRGB pixel with straight alpha, in memory order R, G, B, A.
struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;
    bool operator==(const Rgba8&) const = default;
};
static_assert(sizeof(Rgba8) == 4);

/// Composites `front` over an opaque backdrop, both sRGB, without linearisation, as on screens; exact for alpha 0 and
/// 255.
constexpr Rgba8 over(const Rgba8& front, const Rgba8& backdrop) {
    const auto mix = [&](int f, int b) {
        return static_cast<std::uint8_t>((f * front.a + b * (255 - front.a) + 127) / 255);
    };
    return {mix(front.r, backdrop.r), mix(front.g, backdrop.g), mix(front.b, backdrop.b), 255};
}

/// One linear-light pixel with straight alpha.
struct RgbaF {
    float r = 0, g = 0, b = 0, a = 0;
    bool operator==(const RgbaF&) const = default;
};
static_assert(sizeof(RgbaF) == 16);

}  // namespace rs
