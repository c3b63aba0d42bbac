#include "compositor/web/view/request_order.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/codec/code/coded_images.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <tuple>

namespace rs::web {
namespace {

using object_chunks::ChunkKey;

class RequestOrder {
public:
    RequestOrder(const RaySpaceObject& object, double azimuth_rad)
        : object_(object), azimuth_rad_(azimuth_rad), is_listed_(object.views.size(), false) {}

    void add_shape(std::size_t ring) { order_.push_back({object_chunks::kShape, static_cast<std::uint32_t>(ring)}); }

    // A photo of a ring, after those that it is predicted from.
    void add_photo(const Ring& ring, std::uint16_t view) {
        if (is_listed_[view]) return;
        is_listed_[view] = true;
        for (const std::uint16_t reference : references(ring, view)) add_photo(ring, reference);
        order_.push_back({object_chunks::kImage, view});
    }

    void add_photos(const Ring& ring, const std::vector<std::uint16_t>& views) {
        for (const std::uint16_t view : views) add_photo(ring, view);
    }

    // Views of a ring of at most `level`, from the nearest azimuth to the farthest.
    [[nodiscard]] std::vector<std::uint16_t> nearest(const Ring& ring, int level) const {
        std::vector<std::pair<double, std::uint16_t>> found;
        for (const std::uint16_t view : ring.views) {
            if (level_of(view) > level) continue;
            const double away = photo_azimuth_rad(object_, ring, view) - azimuth_rad_;
            found.emplace_back(std::abs(std::remainder(away, 2 * kPi)), view);
        }
        std::sort(found.begin(), found.end());
        std::vector<std::uint16_t> views;
        for (const auto& [away, view] : found) views.push_back(view);
        return views;
    }

    [[nodiscard]] int lowest_level(const Ring& ring) const {
        int lowest = kProgressiveLevels - 1;
        for (const std::uint16_t view : ring.views) lowest = std::min(lowest, level_of(view));
        return lowest;
    }

    [[nodiscard]] std::vector<ChunkKey> take() { return std::move(order_); }

private:
    [[nodiscard]] int level_of(std::uint16_t view) const { return object_.coded->levels[view]; }

    [[nodiscard]] std::vector<std::uint16_t> references(const Ring& ring, std::uint16_t view) const {
        const codec::CodedImage& image = object_.coded->images[view];
        if (image.loaded()) {
            return {image.head.reference.begin(), image.head.reference.begin() + image.head.references()};
        }
        std::vector<std::uint16_t> found;
        const auto count = static_cast<std::ptrdiff_t>(ring.views.size());
        const std::ptrdiff_t place = std::find(ring.views.begin(), ring.views.end(), view) - ring.views.begin();
        for (const int direction : {-1, 1}) {
            for (std::ptrdiff_t away = 1; away < count; ++away) {
                const std::ptrdiff_t n = (place + direction * away + count) % count;
                const std::uint16_t other = ring.views[static_cast<std::size_t>(n)];
                if (level_of(other) >= level_of(view)) continue;
                found.push_back(other);
                break;
            }
        }
        return found;
    }

    const RaySpaceObject& object_;
    double azimuth_rad_;
    std::vector<bool> is_listed_;  // [view]
    std::vector<ChunkKey> order_;
};

// Rings from the nearest elevation to the farthest, `nearest` first.
std::vector<std::size_t> rings_from(const RaySpaceObject& object, std::size_t nearest) {
    std::vector<std::size_t> rings(object.rings.size());
    for (std::size_t r = 0; r < rings.size(); ++r) rings[r] = r;
    std::stable_sort(rings.begin(), rings.end(), [&](std::size_t a, std::size_t b) {
        const auto away = [&](std::size_t r) {
            return std::abs(object.rings[r].elevation_udeg - object.rings[nearest].elevation_udeg);
        };
        const auto rank = [&](std::size_t r) {
            return std::tuple(r != nearest, !(object.rings[r].rotation == object.rings[nearest].rotation), away(r));
        };
        return rank(a) < rank(b);
    });
    return rings;
}

}  // namespace

std::vector<ChunkKey> request_order(const ObjectView& shown, const OrbitView& view) {
    constexpr std::size_t kBracketing = 2;  // photos on both sides of the view
    constexpr int kHighest = kProgressiveLevels - 1;
    const RaySpaceObject& object = shown.object();
    RequestOrder order(object, view.azimuth_rad);
    const Result<PreparedView> prepared = shown.prepare(view);
    const auto nearest = prepared ? static_cast<std::size_t>(prepared->rings.nearest.ring) : 0;
    const Ring& ring = object.rings[nearest];
    const std::vector<std::uint16_t> lowest = order.nearest(ring, order.lowest_level(ring));
    order.add_photo(ring, lowest.front());
    if (!shown.renderer().has_images(static_cast<int>(nearest))) return order.take();

    const std::vector<std::uint16_t> all = order.nearest(ring, kHighest);
    order.add_photos(ring, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(kBracketing, all.size()))});
    const std::vector<int> read = prepared ? shown.renderer().images_of(prepared->rings.nearest) : std::vector<int>{};
    for (const std::uint16_t each : all) {
        if (std::binary_search(read.begin(), read.end(), int{each})) order.add_photo(ring, each);
    }
    for (const std::size_t r : rings_from(object, nearest)) {
        const Ring& each = object.rings[r];
        order.add_photos(each, order.nearest(each, order.lowest_level(each)));
        order.add_shape(r);
        order.add_photos(each, order.nearest(each, kHighest));
    }
    return order.take();
}

}  // namespace rs::web
