#pragma once
// The clean plate within the region that the object sweeps: grown inwards from where the backdrop is seen all the time.
//
// Which of the colours that a pixel shows in turn is the backdrop's? The one that its neighbour nearer to the border
// shows: the backdrop goes on evenly, and a picture that shows it at one pixel mostly shows it at the next one too. So
// every pixel of the plate carries the pictures in which it is seen (its witnesses), and the next pixel belongs to it
// if most of those witnesses show the same colour there. Where the object always hides the backdrop the witnesses
// run out, and growing stops: the object's own colour, however many pictures agree on it, has none. Edges of the
// backdrop are crossed only afterwards (grow_across_edges).

#include "capture/photos/background/evened_samples.hpp"
#include "capture/photos/background/revolution_rows.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

struct GrownCleanPlate {
    Image<Rgba8> colour;             // means something where `witnesses` is not 0
    Image<std::uint64_t> witnesses;  // [pixel] bit i: sample i shows the backdrop there
};

// How far the plate may grow from what it begins with: as far as its witnesses lead, or only where its colour is about
// the guess's, too. Seeds that are no more than likely should not lead away from what made them so.
enum class Growth { kFree, kNearGuess };

// Adds the pixels where `seeds` is not 0, which are the backdrop of the colour `guess` (or almost so), to a plate of
// their size or to an empty one, and grows it from there, but not to where `barred` is not 0. At most 64 samples.
void grow_plate(const EvenedSamples& samples, ConstImageView<Rgba8> guess, ConstImageView<std::uint8_t> seeds,
                ConstImageView<std::uint8_t> barred, GrownCleanPlate& plate, Growth growth = Growth::kFree);

// Grows a plate on from wherever it has come to, across edges of what stands still behind the object, too, but not to
// where `barred` is not 0. All witnesses show another colour at once there; of an object they would not, for its
// outline lies elsewhere in each picture, unless it is a body of revolution: what `rows` let be one, and witnesses see
// on the other side of the axis, too, in whatever light, is left alone.
void grow_across_edges(const EvenedSamples& samples, ConstImageView<std::uint8_t> barred, const RevolutionRows& rows,
                       GrownCleanPlate& plate);

// The plate's colours as sharp as the pictures are; it is grown by smoothed ones. Black where it has no witnesses.
Image<Rgba8> sharp_colours(const EvenedSamples& samples, const GrownCleanPlate& plate);

// Where a guess of the plate is confirmed, of the pixels that `asked` is not 0 for: at least three samples show patches
// of it. 255 or 0.
Image<std::uint8_t> confirm_plate(const EvenedSamples& samples, ConstImageView<Rgba8> plate,
                                  ConstImageView<std::uint8_t> asked);

}  // namespace rs::capture
