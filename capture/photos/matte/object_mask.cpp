#include "capture/photos/matte/object_mask.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/still_border.hpp"
#include "capture/photos/matte/contrast_cut.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

// What the colour shows on a small island of the plate's colour.
constexpr float kIsland = -0.1F;

// For a plate that is known from a turn and neither white nor black.
constexpr double kChance = 0.00002;
constexpr float kShadowRather = -0.1F;

// Where the object is known to hide the backdrop always, whatever the colour: the plate is a guess there.
constexpr float kHidden = 2;

// A part of which no pixel is clearer than this is a shadow, not an object.
constexpr float kStrong = 1;

// A camera shakes and a border of the backdrop blurs: where a pixel seems to be the object, the plate a little beside
// it may explain it.
constexpr int kShake_px = 2;

// 0 at `low`, 1 at `high`.
float ramp(float value, float low, float high) {
    return std::clamp((value - low) / (high - low), 0.0F, 1.0F);
}

bool on_ground(const CleanPlateView& plate, int x, int y) {
    return !plate.ground.empty() && plate.ground(x, y) != 0;
}

bool above_ground(const CleanPlateView& plate, int x, int y) {
    if (!plate.ground.empty()) return plate.ground(x, y) == 0;
    return !plate.above.empty() && plate.above(x, y) != 0;
}

// Where an object throws its shadow the light that it mirrors falls, too, and between its feet next to none.
MaskOptions options_on_ground(MaskOptions options) {
    options.possible_delta_e = 12;
    options.certain_delta_e = 26;
    options.shadow_tolerance = 1;
    options.min_shade = options.crevice_shade = 0.1F;
    return options;
}

// Far behind the object there are hardly any shadows of it.
MaskOptions options_above_ground(MaskOptions options) {
    options.shadow_or_grey = 0.3F;
    return options;
}

float preference_against(const KnownColour& pixel, const KnownColour& behind, float noise_delta_e,
                         const MaskOptions& options) {
    const bool colourful = is_colourful(behind.look);
    const float plain_delta_e = std::max(colourful ? options.plain_colourful_delta_e : options.plain_delta_e,
                                         options.noise_margin * noise_delta_e);
    const Explanation e = explain_by_backdrop(
        pixel, behind, colourful ? options.min_shade_colourful : options.min_shade, options.max_shade, plain_delta_e);
    const float possible_delta_e = std::max(options.possible_delta_e, 1.5F * plain_delta_e);
    const float certain_delta_e = std::max(options.certain_delta_e, 2 * possible_delta_e);
    if (e.plain <= plain_delta_e) return -kDecided;
    const float tolerance = 1 + options.shadow_tolerance * std::max(0.0F, 1 - e.shade);
    const float object = ramp(e.shaded, possible_delta_e * tolerance, certain_delta_e * tolerance);
    if (object > 0) return std::max(std::abs(options.shadow_or_grey), object * kDecided);
    const float plain = 1 - ramp(e.plain, plain_delta_e, options.almost_plain_reach * plain_delta_e);
    if (plain > 0) return plain * options.almost_plain;
    const bool likely = e.shade >= options.crevice_shade && e.shaded <= 0.8F * possible_delta_e;
    return likely ? options.shadow_or_grey : std::abs(options.shadow_or_grey);
}

constexpr int kLargeShare = 4;  // one in so many of the largest part is large, too
constexpr int kHoleRim_px = 2;
constexpr double kTinyHole_px = 8;  // closed in pictures of any size

// White patches of an object look like a white backdrop. What looks plain on a grey backdrop but is a small island, cut
// off from the border of the picture, is no longer certain: it becomes a slight preference, and the contrast around it
// decides.
void doubt_small_islands(Image<float>& preference, ConstImageView<Lab> plate, double max_island) {
    cv::Mat1b other(preference.height(), preference.width());
    for (int y = 0; y < other.rows; ++y) {
        for (int x = 0; x < other.cols; ++x) other(y, x) = preference(x, y) <= -kDecided ? 0 : 255;
    }
    const ConnectedParts plain = ConnectedParts::left_bare(other);
    plain.for_each_pixel([&](int x, int y, int label) {
        if (plain.touches_border(label)) return;
        const bool small = plain.area(label) < max_island * static_cast<double>(other.total());
        if (small && !is_colourful(plate(x, y))) preference(x, y) = kIsland;
    });
}

// Keeps the parts of `mask` that hold a pixel which strongly speaks for the object, and are no specks. Beside the
// largest, what stands still where the object only comes by is a thing of the room; so is in a room what is small and
// reaches a side of the picture that the largest does not: hands and heads of who turns the table.
void keep_solid_parts(cv::Mat1b& mask, ConstImageView<float> preference, const CleanPlateView& plate,
                      const MaskOptions& options) {
    const ConnectedParts parts(mask, 8);
    struct Tally {
        bool strong = false;
        int still = 0, hidden = 0;  // pixels
    };
    const auto is_set = [](const Image<std::uint8_t>& where, int x, int y) {
        return !where.empty() && where(x, y) != 0;
    };
    const auto tallies = parts.tallied<Tally>([&](int x, int y, Tally& tally) {
        tally.strong |= preference(x, y) >= kStrong;
        tally.still += is_set(plate.still, x, y) ? 1 : 0;
        tally.hidden += is_set(plate.hidden, x, y) ? 1 : 0;
    });
    const bool is_faint = options.may_be_faint && std::ranges::none_of(tallies, &Tally::strong);
    int largest = 0;
    for (int label = 1; label < parts.count(); ++label) {
        if (!is_faint && !tallies[label].strong) continue;
        if (largest == 0 || parts.area(label) > parts.area(largest)) largest = label;
    }
    const int near_px = border_px(mask.cols, mask.rows);
    // A foot that the object always hides stands under or beside the rest; a lip is nearer above it than it is tall.
    const auto stands_still = [&](int label) {
        const Tally& tally = tallies[label];
        const bool may_be_of_it = 2 * tally.hidden > parts.area(label) && parts.share_columns(label, largest) &&
                                  parts.rows_above(label, largest) <= parts.height(label);
        return 2 * tally.still > parts.area(label) && !may_be_of_it;
    };
    const auto comes_in = [&](int label) {
        return options.is_room && kLargeShare * parts.area(label) < parts.area(largest) &&
               (parts.sides(label, near_px) & ~parts.sides(largest, near_px)) != 0;
    };
    PerPart<std::uint8_t> keep(parts.count());
    for (int label = 1; label < parts.count(); ++label) {
        const bool is_kept = tallies[label].strong && parts.area(label) >= options.min_part * parts.area(largest) &&
                             !stands_still(label) && !comes_in(label);
        keep[label] = is_kept || label == largest ? 1 : 0;
    }
    parts.for_each_pixel([&](int x, int y, int label) {
        if (keep[label] == 0) mask(y, x) = 0;
    });
}

// Closes the holes through which the backdrop is not really seen, and the tiny ones. A hole's rim is blurred, so its
// inner part is asked where there is one: a true hole shows the plain backdrop all over, while a white inside of the
// object is plain only here and there. A shadow counts as the backdrop where the backdrop has a colour to know it by.
void close_false_holes(cv::Mat1b& mask, ConstImageView<float> preference, ConstImageView<Lab> plate,
                       const MaskOptions& options) {
    cv::Mat1b outside;
    cv::bitwise_not(mask, outside);
    cv::Mat1b inner;
    cv::erode(outside, inner, cv::Mat(), {-1, -1}, kHoleRim_px);
    const ConnectedParts holes = ConnectedParts::left_bare(mask);
    struct Tally {
        int seen = 0;                        // of the whole hole
        int inner_area = 0, inner_seen = 0;  // without its rim
    };
    const auto tallies = holes.tallied<Tally>([&](int x, int y, Tally& tally) {
        const int seen = preference(x, y) < 0 || is_colourful(plate(x, y)) ? 1 : 0;
        const bool is_inner = inner(y, x) != 0;
        tally.seen += seen;
        tally.inner_area += is_inner ? 1 : 0;
        tally.inner_seen += is_inner ? seen : 0;
    });
    holes.for_each_pixel([&](int x, int y, int label) {
        if (holes.touches_border(label)) return;
        const Tally& tally = tallies[label];
        const int area = holes.area(label);
        const bool shines_through =
            tally.inner_area > 0 ? tally.inner_seen >= options.hole_share * tally.inner_area : 2 * tally.seen >= area;
        const bool tiny = area < std::max(kTinyHole_px, options.min_hole * static_cast<double>(mask.total()));
        if (!shines_through || tiny) mask(y, x) = 255;
    });
}

// 255 where `part` is at most `width_px` wide along a row, a column or a diagonal; it is taken to go on beyond the
// picture's border.
cv::Mat1b thin_parts(const cv::Mat1b& part, int width_px) {
    cv::Mat1b around;
    cv::copyMakeBorder(part, around, width_px, width_px, width_px, width_px, cv::BORDER_CONSTANT, 255);
    const cv::Rect inner(width_px, width_px, part.cols, part.rows);
    const int length = width_px + 1;
    cv::Mat1b diagonal(length, length, std::uint8_t{0});
    cv::setIdentity(diagonal);
    cv::Mat1b other_diagonal;
    cv::flip(diagonal, other_diagonal, 0);
    const std::array<cv::Mat1b, 4> lines{cv::Mat1b(1, length, std::uint8_t{1}), cv::Mat1b(length, 1, std::uint8_t{1}),
                                         diagonal, other_diagonal};
    cv::Mat1b thin(part.size(), std::uint8_t{0});
    for (const cv::Mat1b& line : lines) {
        // An opening; its anchors are the line's two ends, so that lines of even length shift nothing.
        const cv::Point first(0, line(0, 0) != 0 ? 0 : line.rows - 1);
        const cv::Point last(line.cols - 1, line.rows - 1 - first.y);
        cv::Mat1b wide;
        cv::erode(around, wide, line, first);
        cv::dilate(wide, wide, line, last);
        cv::Mat1b narrow;
        cv::subtract(part, wide(inner), narrow);
        cv::bitwise_or(thin, narrow, thin);
    }
    return thin;
}

// Shadows are broad: a narrow part that differs clearly from a plate of which noise and exposure are known is the
// object's, wires and stripes of rods, even if a shadow of that depth would look the same. Not before a colour that
// tells shadows from grey parts.
void lean_to_object_in_thin_parts(ConstImageView<Rgba8> photo, const CleanPlateView& plate, const MaskOptions& options,
                                  Image<float>& preference) {
    constexpr int kThinShare = 45;  // of the picture's longer side: narrower than that is thin
    constexpr float kThinRather = 2;
    cv::Mat3f smooth;
    cv::GaussianBlur(linear_mat(photo), smooth, {3, 3}, 0);
    const int width_px = std::max(1, std::max(smooth.cols, smooth.rows) / kThinShare);
    // Only around what is undecided anything depends on it, which is little of a picture.
    cv::Mat1b asked(smooth.size());
    for (int y = 0; y < smooth.rows; ++y) {
        for (int x = 0; x < smooth.cols; ++x) asked(y, x) = std::abs(preference(x, y)) < kDecided ? 255 : 0;
    }
    cv::dilate(asked, asked, cv::getStructuringElement(cv::MORPH_RECT, {2 * width_px + 1, 2 * width_px + 1}));
    cv::Mat1f beyond_noise(smooth.size(), 0.0F);
    cv::Mat1b differs(smooth.size(), std::uint8_t{0});
    for (int y = 0; y < smooth.rows; ++y) {
        for (int x = 0; x < smooth.cols; ++x) {
            if (asked(y, x) == 0) continue;
            const cv::Vec3f& p = smooth(y, x);
            const float noise = plate.noise_delta_e.empty() ? 0 : plate.noise_delta_e(x, y);
            const float delta = delta_e(lab_from_linear({p[0], p[1], p[2]}), plate.behind.looks(x, y));
            beyond_noise(y, x) = delta - noise;
            differs(y, x) = delta > std::max(options.plain_delta_e, 1.2F * noise) ? 255 : 0;
        }
    }
    const cv::Mat1b thin = thin_parts(differs, width_px);
    for (int y = 0; y < smooth.rows; ++y) {
        for (int x = 0; x < smooth.cols; ++x) {
            float& own = preference(x, y);
            if (std::abs(own) >= kDecided || thin(y, x) == 0 || beyond_noise(y, x) < options.thin_delta_e) continue;
            if (beyond_noise(y, x) < options.thin_on_ground_delta_e && on_ground(plate, x, y)) continue;
            if (!is_colourful(plate.behind.looks(x, y))) own = std::max(own, kThinRather);
        }
    }
}

}  // namespace

MaskOptions mask_options_for(const Backdrop& backdrop) {
    MaskOptions options;
    if (backdrop.kind == BackdropKind::kBlack) {
        options.min_shade = options.min_shade_colourful = options.max_shade = 1;
        if (backdrop.black == BlackGround::kEven) {
            options.plain_delta_e = .4F;
            options.possible_delta_e = .9F;
            options.certain_delta_e = 2;
        } else if (backdrop.black == BlackGround::kExact) {
            // A grey of code 1 is .27 away. Where the object fades to black within itself, nothing is seen of a rim,
            // and the cut closes it; a true hole has one, so that larger islands than elsewhere can be left to the cut.
            options.plain_delta_e = .15F;
            options.possible_delta_e = .225F;
            options.certain_delta_e = 2;
            options.cut.contrast_delta_e = .5F;
            options.max_island = .012;
        }
    }
    // A plate that is known exactly, texture and all, is hardly met by chance.
    if (backdrop.kind == BackdropKind::kColour && !backdrop.untouched.empty()) {
        options.is_room = true;
        options.max_island = kChance;
        options.shadow_or_grey = kShadowRather;
        options.possible_delta_e = 6;
        options.certain_delta_e = 14;
        options.shadow_tolerance = 0.5F;
        options.hole_share = 0.5;
        options.thin_delta_e = 3;
        options.thin_on_ground_delta_e = 8;
    }
    return options;
}

MaskOptions mask_options_for_flat_grey() {
    MaskOptions options;
    options.plain_delta_e = .5F;  // a grey code of white is .36; a code in one channel, up to .67, says next to nothing
    // What differs by a few codes may as well be a faint shadow: it says next to nothing, and the contrast decides.
    options.almost_plain_reach = 10;
    options.almost_plain = -.05F;
    options.cut.coarse_from_px = 30000;  // most of a grey object is undecided, and noise fools single pixels
    return options;
}

SeenLight::SeenLight(Image<LinearRgb> of) : light(std::move(of)) {
    for (LinearRgb& p : light.pixels()) p = {std::min(1.0F, p.r), std::min(1.0F, p.g), std::min(1.0F, p.b)};
    looks = lab_picture(light);
}

Image<float> object_preference(const SeenPhoto& photo, const CleanPlateView& plate, const MaskOptions& options) {
    RS_CHECK(photo.width() == plate.behind.width() && photo.height() == plate.behind.height());
    const MaskOptions ground = options_on_ground(options);
    const MaskOptions above = options_above_ground(options);
    std::vector<KnownColour> screen;
    for (const LinearRgb& colour : plate.screen) screen.emplace_back(colour);
    Image<float> preference(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            if (!plate.seen.empty() && plate.seen(x, y) != 0) {
                preference(x, y) = -kDecided;
                continue;
            }
            const MaskOptions& here = above_ground(plate, x, y) ? above : (on_ground(plate, x, y) ? ground : options);
            const KnownColour pixel(linear_rgb(photo.picture(x, y)), photo.looks(x, y));
            const float noise = plate.noise_delta_e.empty() ? 0 : plate.noise_delta_e(x, y);
            const KnownColour behind(plate.behind.light(x, y), plate.behind.looks(x, y));
            float best = preference_against(pixel, behind, noise, here);
            if (!plate.hidden.empty() && plate.hidden(x, y) != 0) {
                preference(x, y) = std::max(best, kHidden);
                continue;
            }
            if (best > 0) {
                for (const auto& [dx, dy] :
                     {std::pair{-kShake_px, 0}, {kShake_px, 0}, {0, -kShake_px}, {0, kShake_px}}) {
                    const int u = std::clamp(x + dx, 0, photo.width() - 1);
                    const int v = std::clamp(y + dy, 0, photo.height() - 1);
                    const KnownColour beside(plate.behind.light(u, v), plate.behind.looks(u, v));
                    if (delta_e(beside.look, behind.look) < here.plain_delta_e) continue;
                    best = std::min(best, preference_against(pixel, beside, noise, here));
                }
            }
            for (const KnownColour& colour : screen) {
                if (best <= 0) break;
                best = std::min(best, preference_against(pixel, colour, noise, here));
            }
            preference(x, y) = best;
        }
    }
    return preference;
}

Image<std::uint8_t> find_object(const SeenPhoto& photo, const CleanPlateView& plate, const MaskOptions& options) {
    RS_CHECK(photo.width() == plate.behind.width() && photo.height() == plate.behind.height());
    Image<std::uint8_t> result(photo.width(), photo.height());
    if (result.empty()) return result;
    Image<float> preference = object_preference(photo, plate, options);
    if (options.thin_delta_e > 0) lean_to_object_in_thin_parts(photo.picture, plate, options, preference);
    doubt_small_islands(preference, plate.behind.looks, options.max_island);
    result = cut_coarse_first(photo.looks, preference, options.cut);
    cv::Mat1b mask(result.height(), result.width(), result.data());
    keep_solid_parts(mask, preference, plate, options);
    close_false_holes(mask, preference, plate.behind.looks, options);
    return result;
}

}  // namespace rs::capture
