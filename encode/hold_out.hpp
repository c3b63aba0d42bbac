#pragma once
// Splits the views of a capture set into kept views, used to build an object, and held-out views, used to score it.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"

#include <string>
#include <vector>

namespace rs::encode {

// Quality of one method's rendering of a held-out view.

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
    double build_seconds = 0;  // building the object from the kept views, including reading their images
};

struct HoldOut {
    std::vector<int> kept;  // indices of views of the rig, ascending
    std::vector<int> held;  // ascending; no view is in both
};

enum class HoldOutKind {
    kEveryNth,   // one of `number` (>= 2) neighbouring views of a ring
    kWholeTurn,  // all views of turn `number`, from 0 on
};
struct HoldOutRule {
    HoldOutKind kind = HoldOutKind::kEveryNth;
    int number = 2;
};

/// Parses "every-Nth" ("every-2nd", "every-3rd", "every-10th"; the ordinal's ending is not checked), N >= 2, and
/// "turn=N", N >= 0.
Result<HoldOutRule> parse_hold_out(const std::string& text);

/// Divides each ring, in turning order, into runs of `every` (>= 2) consecutive views. The view at index every / 2 of
/// each run is held out, so that its neighbours are kept. All views of an incomplete last run may be kept. Fails if
/// fewer than two views of the rig would be kept, or none held out.
/// \param where  name of the set for errors.
Result<HoldOut> choose_hold_out(const Rig& rig, int every, const std::string& where);

/// Holds out the views whose frames have the key "turn" with this value, as in sets of several turns (rs-capture
/// import). Fails as choose_hold_out(), and if no frame has it.
Result<HoldOut> hold_out_turn(const Rig& rig, int turn, const std::string& where);

/// One of the above, by the rule.
Result<HoldOut> choose_hold_out(const Rig& rig, const HoldOutRule& rule, const std::string& where);

/// The kept view that a spin viewer would show for `view`: the view nearest in azimuth of the kept ring nearest in
/// elevation; of two equally near views, the first in turning order.
int nearest_kept_view(const Rig& rig, const HoldOut& hold_out, int view);

/// The kept view from the direction most similar to that of `view`, seen from the origin; for posed cameras.
int nearest_kept_direction(const Rig& rig, const HoldOut& hold_out, int view);

}  // namespace rs::encode
