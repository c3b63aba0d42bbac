#include "rayspace/api/builder.hpp"

#include "encode/build.hpp"
#include "encode/encode_images.hpp"
#include "encode/posed/posed_rings.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/api/internal/type_conversion.hpp"
#include "rayspace/base/result.hpp"

#include <utility>

namespace rs::api {
namespace {

Status check(const BuildOptions& options) {
    if (!(options.quality >= encode::kMinQuality && options.quality <= encode::kMaxQuality)) {
        return Error{"quality: must be 1..100"};
    }
    if (options.psnr_db && !(*options.psnr_db >= 10 && *options.psnr_db <= 60)) {
        return Error{"psnr_db: must be 10..60 dB"};
    }
    if (options.effort < encode::kMinEffort || options.effort > encode::kMaxEffort) {
        return Error{"effort " + std::to_string(options.effort) + ": must be 1..9"};
    }
    if (options.alpha_bits && (*options.alpha_bits < 1 || *options.alpha_bits > codec::kMaxAlphaBits)) {
        return Error{"alpha_bits " + std::to_string(*options.alpha_bits) + ": must be 1.." +
                     std::to_string(codec::kMaxAlphaBits)};
    }
    return {};
}

encode::ImageGoal goal_of(const BuildOptions& options) {
    encode::ImageGoal goal;
    goal.profile = options.coding == PhotoCoding::kBoard ? codec::Profile::kBoard : codec::Profile::kDense;
    goal.images_bytes = options.photos_bytes;
    goal.psnr_db = options.psnr_db;
    goal.quality = options.quality;
    goal.effort = options.effort;
    return goal;
}

}  // namespace

Result<BuiltObject> build_object(const std::filesystem::path& set, const BuildOptions& options) {
    RS_TRY(check(options));
    ProgressAdapter progress(options.progress);
    RS_ASSIGN_OR_RETURN(encode::CaptureSet captured, encode::open_capture_set(set, &progress));
    RS_ASSIGN_OR_RETURN(encode::CaptureSet opened, encode::with_rings(std::move(captured), {}, &progress));
    encode::BuildOptions building;
    building.raymap = options.map == MapKind::kPlane ? encode::MapKind::kPlane : encode::MapKind::kShape;
    building.map = encode::default_plane_map(building.raymap);
    building.map.planes = options.planes;
    building.name = options.name.empty() ? encode::name_of(opened) : options.name;
    building.raw_images = options.coding == PhotoCoding::kRaw;
    RS_ASSIGN_OR_RETURN(encode::BuiltObject built, encode::build_object(opened, building, &progress));
    std::optional<double> psnr_db;
    if (!building.raw_images) {
        opened.completed = std::move(built.completed);
        RS_ASSIGN_OR_RETURN(encode::EncodedImages encoded, encode::encode_images(opened, built.object, goal_of(options),
                                                                                 options.alpha_bits, &progress));
        psnr_db = encoded.psnr_db;
        built.object.coded = std::make_shared<codec::CodedImages>(std::move(encoded.coded));
    }
    RS_ASSIGN_OR_RETURN(Object object, Object::create(std::move(built.object)));
    std::vector<std::string> warnings = std::move(opened.warnings);
    warnings.insert(warnings.end(), built.warnings.begin(), built.warnings.end());
    return BuiltObject{std::move(object), std::move(warnings), psnr_db};
}

}  // namespace rs::api
