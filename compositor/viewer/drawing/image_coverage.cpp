#include "compositor/viewer/drawing/image_coverage.hpp"

#include <algorithm>

namespace rs::compositor {

namespace {

constexpr int kMaxClosedGap_px = 8;   // gaps up to this length are drawn with the adjacent runs
constexpr int kMinOpaqueRun_px = 16;  // shorter opaque ranges are blended

struct ColumnRange {
    int begin = 0;
    int end = 0;
};

// Per column, the maximum and minimum alpha within `margin` pixels; alpha outside the image is 0. Element x + margin
// belongs to column x, from -margin to width + margin.
struct ColumnAlphas {
    std::vector<std::uint8_t> largest;
    std::vector<std::uint8_t> least;
};

ColumnAlphas column_alphas(ConstImageView<Rgba8> image, int first_row, int end_row, int margin) {
    const auto width = static_cast<std::size_t>(image.width());
    std::vector<std::uint8_t> largest(width, 0);
    std::vector<std::uint8_t> least(width, first_row < 0 || end_row > image.height() ? 0 : 255);
    for (int y = std::max(first_row, 0); y < std::min(end_row, image.height()); ++y) {
        const Rgba8* row = image.row(y);
        for (std::size_t x = 0; x < width; ++x) {
            largest[x] = std::max(largest[x], row[x].a);
            least[x] = std::min(least[x], row[x].a);
        }
    }
    const auto beside = static_cast<std::size_t>(margin);
    ColumnAlphas around{std::vector<std::uint8_t>(width + 2 * beside, 0),
                        std::vector<std::uint8_t>(width + 2 * beside, 0)};
    for (std::size_t shift = 0; shift <= 2 * beside; ++shift) {
        for (std::size_t x = 0; x < width; ++x) {
            around.largest[x + shift] = std::max(around.largest[x + shift], largest[x]);
        }
    }
    // Columns closer than `margin` to an end have transparent neighbours, so their minimum is 0.
    for (std::size_t x = beside; x + beside < width; ++x) {
        around.least[x + beside] = *std::min_element(least.begin() + static_cast<std::ptrdiff_t>(x - beside),
                                                     least.begin() + static_cast<std::ptrdiff_t>(x + beside + 1));
    }
    return around;
}

// Ranges of columns for which `predicate` is true, in order. Gaps of at most `closed` columns are closed; ranges of
// fewer than `shortest` columns are dropped.
template <class Predicate>
std::vector<ColumnRange> ranges_where(int count, int closed, int shortest, Predicate predicate) {
    std::vector<ColumnRange> ranges;
    for (int x = 0; x < count; ++x) {
        if (!predicate(static_cast<std::size_t>(x))) continue;
        if (!ranges.empty() && x <= ranges.back().end + closed) {
            ranges.back().end = x + 1;
        } else {
            ranges.push_back({x, x + 1});
        }
    }
    std::erase_if(ranges, [&](const ColumnRange& range) { return range.end - range.begin < shortest; });
    return ranges;
}

// Split points of the line between two bands: the ends of the runs above and below.
std::vector<int> split_columns(const CoverageBand* above, const CoverageBand* below) {
    std::vector<int> columns;
    for (const CoverageBand* band : {above, below}) {
        if (band == nullptr) continue;
        for (const CoverageRun& run : band->runs) columns.insert(columns.end(), {run.begin, run.end});
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
}

// Corners of one line; mesh corner i is at columns[i - first].
struct CornerLine {
    std::vector<int> columns;
    std::uint32_t first = 0;

    [[nodiscard]] std::uint32_t corner(int column) const {
        const auto at = std::lower_bound(columns.begin(), columns.end(), column);
        return first + static_cast<std::uint32_t>(at - columns.begin());
    }
};

// Triangulates the polygon between two lines from column run.begin to run.end, corners in order of column.
void add_triangles(const CoverageRun& run, const CornerLine& top, const CornerLine& bottom,
                   std::vector<std::uint32_t>& indices) {
    std::uint32_t upper = top.corner(run.begin);
    std::uint32_t lower = bottom.corner(run.begin);
    const std::uint32_t upper_end = top.corner(run.end);
    const std::uint32_t lower_end = bottom.corner(run.end);
    while (upper < upper_end || lower < lower_end) {
        const bool along_top =
            lower == lower_end ||
            (upper < upper_end && top.columns[upper + 1 - top.first] <= bottom.columns[lower + 1 - bottom.first]);
        indices.insert(indices.end(), {upper, lower, along_top ? upper + 1 : lower + 1});
        ++(along_top ? upper : lower);
    }
}

}  // namespace

std::vector<CoverageBand> coverage_bands(ConstImageView<Rgba8> image, int margin_px) {
    RS_CHECK(margin_px >= 0);
    std::vector<CoverageBand> bands;
    for (int top = 0; top < image.height(); top += kBandRows) {
        const int bottom = std::min(top + kBandRows, image.height());
        const ColumnAlphas alphas = column_alphas(image, top - margin_px, bottom + margin_px, margin_px);
        const auto count = static_cast<int>(alphas.largest.size());
        const auto shown =
            ranges_where(count, kMaxClosedGap_px, 1, [&](std::size_t x) { return alphas.largest[x] > 0; });
        const auto opaque =
            ranges_where(count, 0, kMinOpaqueRun_px, [&](std::size_t x) { return alphas.least[x] == 255; });
        CoverageBand band{top, bottom, {}};
        if (top == 0) band.top -= margin_px;
        if (bottom == image.height()) band.bottom += margin_px;
        for (const ColumnRange& range : shown) {
            int begin = range.begin;
            for (const ColumnRange& inner : opaque) {
                if (inner.begin < range.begin || inner.end > range.end) continue;
                if (begin < inner.begin) band.runs.push_back({begin - margin_px, inner.begin - margin_px, false});
                band.runs.push_back({inner.begin - margin_px, inner.end - margin_px, true});
                begin = inner.end;
            }
            if (begin < range.end) band.runs.push_back({begin - margin_px, range.end - margin_px, false});
        }
        bands.push_back(std::move(band));
    }
    return bands;
}

std::vector<CoverageBand> coverage_bands(std::span<const PixelRect> visible, int margin_px) {
    std::vector<CoverageBand> bands;
    if (visible.empty()) return bands;
    const auto bottom_of = [](const PixelRect& rect) { return rect.top + rect.height; };
    const int top = std::ranges::min(visible, {}, &PixelRect::top).top - margin_px;
    const int bottom = bottom_of(std::ranges::max(visible, {}, bottom_of)) + margin_px;
    for (int row = top; row < bottom; row += kBandRows) {
        CoverageBand& band = bands.emplace_back(CoverageBand{row, std::min(row + kBandRows, bottom), {}});
        for (const PixelRect& rect : visible) {
            if (rect.top - margin_px >= band.bottom || bottom_of(rect) + margin_px <= band.top) continue;
            band.runs.push_back({rect.left - margin_px, rect.left + rect.width + margin_px, false});
        }
        std::ranges::sort(band.runs, {}, &CoverageRun::begin);
        std::vector<CoverageRun> joined;
        for (const CoverageRun& run : band.runs) {
            if (!joined.empty() && run.begin <= joined.back().end) {
                joined.back().end = std::max(joined.back().end, run.end);
            } else {
                joined.push_back(run);
            }
        }
        band.runs = std::move(joined);
    }
    return bands;
}

CoverageMesh coverage_mesh(const std::vector<CoverageBand>& bands, const glm::dmat3& screen_from_image) {
    CoverageMesh mesh;
    const auto line = [&](const CoverageBand* above, const CoverageBand* below, int row) {
        CornerLine made{split_columns(above, below), static_cast<std::uint32_t>(mesh.corners.size())};
        for (const int column : made.columns) {
            mesh.corners.emplace_back(screen_from_image * glm::dvec3(column, row, 1));
        }
        return made;
    };
    if (bands.empty()) return mesh;
    CornerLine top = line(nullptr, &bands.front(), bands.front().top);
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const CoverageBand* below = i + 1 < bands.size() ? &bands[i + 1] : nullptr;
        CornerLine bottom = line(&bands[i], below, bands[i].bottom);
        for (const CoverageRun& run : bands[i].runs) {
            add_triangles(run, top, bottom, run.opaque ? mesh.opaque : mesh.blended);
        }
        top = std::move(bottom);
    }
    return mesh;
}

}  // namespace rs::compositor
