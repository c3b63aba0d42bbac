#include "rayspace/format/content_coding.hpp"

#include "rayspace/base/zstd_frame.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "tests/support/random.hpp"
#include "tests/support/small_object.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using namespace rs;
using Lines = std::vector<CapturedLine>;

std::int32_t CapturedLine::*const kFields[] = {&CapturedLine::l0_q20, &CapturedLine::l1_q30, &CapturedLine::q0_q16,
                                               &CapturedLine::q1_q16};

// Decodes by encode/FORMAT.md, "Coded lines", number by number, in arithmetic that cannot overflow.
Lines decoded_from_the_document(const std::vector<std::uint8_t>& bytes, std::size_t views, int planes) {
    Lines lines(views * static_cast<std::size_t>(planes));
    const auto c = static_cast<__int128>(std::nearbyint(std::pow(2.0, 31) * std::cos(2 * kPi / planes)));
    for (std::size_t field = 0; field < 4; ++field) {
        const bool is_sine = field % 2 == 1;
        for (std::size_t n = 0; n < views; ++n) {
            for (int k = 0; k < planes; ++k) {
                const auto v = [&](std::size_t view, int plane) -> std::int32_t& {
                    return lines[view * static_cast<std::size_t>(planes) + static_cast<std::size_t>(plane)].*
                           kFields[field];
                };
                __int128 prediction = n > 0 ? v(n - 1, k) : 0;
                if (!is_sine && k > 0) prediction = v(n, k - 1);
                if (is_sine && k > 1) {
                    const __int128 numerator = c * v(n, k - 1) + (1 << 29);
                    __int128 quotient = numerator / (1 << 30);
                    if (numerator % (1 << 30) < 0) --quotient;
                    prediction = quotient - v(n, k - 2);
                }
                std::uint64_t e = 0;
                for (std::size_t b = 0; b < 4; ++b) {
                    const std::size_t row = 4 * field + b;
                    e += std::uint64_t{bytes[row * lines.size() + n * static_cast<std::size_t>(planes) +
                                             static_cast<std::size_t>(k)]}
                         << (8 * b);
                }
                const __int128 d = e % 2 == 0 ? static_cast<__int128>(e / 2) : -static_cast<__int128>((e + 1) / 2);
                v(n, k) = static_cast<std::int32_t>(static_cast<std::uint32_t>(prediction + d));
            }
        }
    }
    return lines;
}

Lines lines_of(const RaySpaceObject& object) {
    Lines lines;
    for (const CapturedView& view : object.views) lines.insert(lines.end(), view.lines.begin(), view.lines.end());
    return lines;
}

TEST(LineCoding, ComesBackAsTheDocumentSays) {
    constexpr std::int32_t kEnds[] = {std::numeric_limits<std::int32_t>::min(), -1, 0, 1,
                                      std::numeric_limits<std::int32_t>::max()};
    test::Random random(7);
    for (int planes = kMinPlanes; planes <= kMaxPlanes; ++planes) {
        Lines lines(static_cast<std::size_t>(planes) * 5);
        for (CapturedLine& line : lines) {
            for (const auto field : kFields) {
                line.*field = random.whole(0, 4) == 0 ? kEnds[random.whole(0, 4)] : random.whole(kEnds[0], kEnds[4]);
            }
        }
        const std::vector<std::uint8_t> plane = line_coding::encode_residuals(lines, planes);
        ASSERT_EQ(plane.size(), lines.size() * line_coding::kBytesPerLine);
        Lines back(lines.size());
        line_coding::decode_residuals(plane, planes, back);
        EXPECT_EQ(back, lines);
        EXPECT_EQ(decoded_from_the_document(plane, 5, planes), lines) << planes;
    }
}

TEST(LineCoding, AnyBytesAreLines) {
    test::Random random(8);
    for (int planes = kMinPlanes; planes <= kMaxPlanes; planes += 7) {
        std::vector<std::uint8_t> plane(static_cast<std::size_t>(planes) * 3 * line_coding::kBytesPerLine);
        for (std::uint8_t& byte : plane) byte = static_cast<std::uint8_t>(random.whole(0, 255));
        Lines lines(static_cast<std::size_t>(planes) * 3);
        line_coding::decode_residuals(plane, planes, lines);
        EXPECT_EQ(decoded_from_the_document(plane, 3, planes), lines);
        EXPECT_EQ(line_coding::encode_residuals(lines, planes), plane);
    }
}

// Lines of real cameras are sinusoidal and take less than a third of their plain size.
TEST(LineCoding, LinesOfCamerasTakeFewBytes) {
    test::SmallObjectOptions options;
    options.views_per_ring = 36;
    options.planes = 12;
    const RaySpaceObject object = test::small_object(options);
    const std::vector<std::uint8_t> plane = line_coding::encode_residuals(lines_of(object), 12);
    for (std::size_t field : {0U, 2U}) {  // constant over a view's planes
        for (std::size_t i = 0; i < 36 * 12; ++i) {
            if (i % 12 != 0) {
                EXPECT_EQ(plane[4 * field * 36 * 12 + i], 0);
            }
        }
    }
    using object_chunks::LineCoding;
    const std::size_t coded_bytes = object_chunks::ring_payload(object, 0).size();
    EXPECT_LT(coded_bytes, object_chunks::ring_payload(object, 0, LineCoding::kPlain).size() / 3);
}

TEST(LineCoding, EitherCodingIsReadAlike) {
    using namespace object_chunks;
    const RaySpaceObject object = test::small_object();
    for (const LineCoding coding : {LineCoding::kPlain, LineCoding::kResiduals}) {
        RaySpaceObject back = test::small_object();
        for (CapturedView& view : back.views) view.lines.clear();
        back.rings[0].views.clear();
        ASSERT_TRUE(parse_ring(ring_payload(object, 0, coding), back, 0).ok());
        EXPECT_EQ(back.views, object.views);
        EXPECT_EQ(back.rings, object.rings);
    }
}

}  // namespace
