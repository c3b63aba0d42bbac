#pragma once
// Which views of a capture set are kept for building an object, and which are held out to score it with.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"

#include <string>
#include <vector>

namespace rs::encode {

// How near the answers to held-out views came to the true images, for one way of answering.

struct HeldOutScore {
    int view = 0;        // index in the rig of the whole set
    std::string image;   // its file_path
    double psnr_db = 0;  // image_metrics.hpp
    double ssim = 0;
};

struct MethodScores {
    std::string method;
    std::vector<HeldOutScore> views;
    double mean_psnr_db = 0;    // mean over views of the views' dB
    double pooled_psnr_db = 0;  // dB of all views' object pixels taken together
    double mean_ssim = 0;
    double build_seconds = 0;  // making the object from the kept views, reading their images included
};

struct HoldOut {
    std::vector<int> kept;  // indices of views of the rig, ascending
    std::vector<int> held;  // ascending; no view is in both
};

// N of "every-Nth" ("every-2nd", "every-3rd", "every-10th"; the ending of the ordinal is not looked at), N >= 2.
Result<int> parse_hold_out(const std::string& text);

// Each ring is cut, in turning order, into runs of `every` (>= 2) consecutive views; of each run the view at index
// every / 2 is held out, so that its neighbours are kept. An incomplete last run may keep all of its views. Fails where
// less than two views of the rig would be kept or none held out; `where` names the set in the error.
Result<HoldOut> choose_hold_out(const Rig& rig, int every, const std::string& where);

// The kept view that a spin viewer would show for `view`: of the kept ring nearest in elevation the view nearest in
// azimuth; of two that are equally near the first in turning order.
int nearest_kept_view(const Rig& rig, const HoldOut& hold_out, int view);

}  // namespace rs::encode
