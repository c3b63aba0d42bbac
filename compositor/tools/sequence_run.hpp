#pragma once
// rs-view --sequence: sequences into videos, images or folders of images.

#include "compositor/tools/view_options.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

// One sequence to -o FILE.mp4, FILE.jpg, FILE.png or a folder of images; several into a folder, each to
// NAME/sequence.mp4 and NAME/snapshot.jpg, with a line on stdout for each and an error at the end where some failed.
Status run_sequences(const ViewArguments& arguments);

// One sequence in a window, and those that are opened there.
Status run_sequence_window(const ViewArguments& arguments);

}  // namespace rs::compositor
