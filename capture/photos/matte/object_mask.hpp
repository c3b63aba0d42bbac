#pragma once
// Which pixels of a photograph show the object: yes or no. The soft edge comes after it, in soft_edge.hpp.
//
// Every pixel gets a preference: above 0 for the object, below 0 for the backdrop. Pixels that look like the plate are
// surely backdrop, pixels that no shadow on the plate explains are surely object. What lies between (shadows on the
// ground, grey or glossy parts of the object on white) says little alone, so a minimum cut decides it by where the
// contrast is: a soft shadow fades into the backdrop without an edge, the object has one all around. Where the plate is
// known from a turn, it also counts that shadows are broad, and that they fall on the ground if one is known. Then
// specks (chalk, dust, noise) go and holes through which the backdrop is not really seen are closed.

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/matte/contrast_cut.hpp"
#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::capture {

// Differences are delta E, shades factors of linear light.
struct MaskOptions {
    float plain_delta_e = 2.5F;         // up to this from a grey plate: surely backdrop
    float plain_colourful_delta_e = 6;  // the same for a plate that has a colour, which objects seldom share
    // Up to so many times that it is almost plain, which says a little: so much at most, and nothing at the end.
    float almost_plain_reach = 2;
    float almost_plain = -0.4F;
    float possible_delta_e = 10;  // from here on a pixel leans to the object, in full light ...
    float certain_delta_e = 22;   // ... and from here on it is surely object
    float shadow_tolerance = 1;   // both grow by this share of what the shadow takes away: objects tint shadows
    float noise_margin = 2;       // what is plain lies within so many times the noise
    // What the colour says where nothing but a shadow on a grey backdrop explains it: next to nothing, so that the
    // contrast decides. Above 0 a closed border around a grey patch of the object can hold it.
    float shadow_or_grey = 0.08F;
    float min_shade = 0.25F;  // light left in the deepest shadow on a grey backdrop (or black were a shadow) ...
    float min_shade_colourful = 0.08F;  // ... and on one that has a colour
    float max_shade = 1.15F;
    float crevice_shade = 0.3F;  // what has less light left is rather a crevice of the object
    // What is narrow and differs by more from the plate is no shadow; 0: it may be one. On the ground there are slivers
    // of shadow, so more is required there.
    float thin_delta_e = 0;
    float thin_on_ground_delta_e = 0;
    CutOptions cut{};
    bool is_room = false;       // people and things may reach into the picture
    bool may_be_faint = false;  // where no part is clearly the object's, the largest is
    double max_island = 0.003;  // plain grey patches smaller than this share of the picture may be the object's
    double min_part = 0.01;     // parts smaller than this share of the largest are specks
    // Of a true hole's inner part at least so much looks plain; measured on a shoe before white: loops of its straps
    // 0.94 to 1.00, white insoles 0.74 to 0.85.
    double hole_share = 0.9;
    double min_hole = 0.00004;  // holes smaller than this share of the picture are closed
};

// A photograph, and how it looks, which is worked out once for all that is asked of it. The picture must outlive it.
// Converts, so that a photograph can be given where it is asked for once.
struct SeenPhoto {
    ConstImageView<Rgba8> picture;
    Image<Lab> looks;
    SeenPhoto(ConstImageView<Rgba8> photo) : picture(photo), looks(lab_picture(photo)) {}
    SeenPhoto(const Image<Rgba8>& photo) : SeenPhoto(ConstImageView<Rgba8>(photo)) {}
    SeenPhoto(Image<Rgba8>&&) = delete;
    [[nodiscard]] int width() const { return picture.width(); }
    [[nodiscard]] int height() const { return picture.height(); }
};

// The light that fills a picture, at most white, and how it looks.
struct SeenLight {
    Image<LinearRgb> light;
    Image<Lab> looks;
    SeenLight() = default;
    explicit SeenLight(Image<LinearRgb> of);  // what is brighter than white becomes 1
    [[nodiscard]] int width() const { return light.width(); }
    [[nodiscard]] int height() const { return light.height(); }
};

// What is behind the object in one photograph, in its size.
struct CleanPlateView {
    SeenLight behind;               // exposed like the photograph
    Image<std::uint8_t> hidden;     // 255 where the object always is before it; empty: nobody can tell
    Image<std::uint8_t> still;      // 255 where no picture shows anything else; empty: nobody can tell
    Image<std::uint8_t> seen;       // 255 where it is seen, in a shadow or not; empty: nobody can tell
    Image<std::uint8_t> ground;     // 255 on a turntable's disc and around it, where shadows fall; empty: no disc
    Image<std::uint8_t> above;      // 255 where no shadow falls; empty: nobody can tell. Not read where a ground is
    std::vector<LinearRgb> screen;  // colours that are backdrop wherever they are seen, lit or in shadow
    Image<float> noise_delta_e;     // how far the photograph is from it where it shows it; empty: next to nothing
};

// A shadow on black cannot be seen, so it is not looked for.
MaskOptions mask_options_for(const Backdrop& backdrop);

// White objects differ by a few codes from a white of one colour, and grey ones from a grey.
MaskOptions mask_options_for_flat_grey();

// The preference, -kDecided..kDecided; the ends are certain.
inline constexpr float kDecided = 4;
Image<float> object_preference(const SeenPhoto& photo, const CleanPlateView& plate, const MaskOptions& options);

// 255 = object, 0 = backdrop.
Image<std::uint8_t> find_object(const SeenPhoto& photo, const CleanPlateView& plate, const MaskOptions& options);

}  // namespace rs::capture
