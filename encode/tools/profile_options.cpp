#include "encode/tools/profile_options.hpp"

#include <cmath>

namespace rs::encode {
namespace {

// "800k" -> 800000; nullopt if the text is not a size above 0.
std::optional<std::uint64_t> bytes_of(const std::string& text) {
    std::size_t read = 0;
    double number = 0;
    try {
        number = std::stod(text, &read);
    } catch (const std::exception&) {
        return std::nullopt;
    }
    const std::string unit = text.substr(read);
    double factor = 1;
    if (unit == "k") {
        factor = 1e3;
    } else if (unit == "M") {
        factor = 1e6;
    } else if (unit == "G") {
        factor = 1e9;
    } else if (!unit.empty()) {
        return std::nullopt;
    }
    const double bytes = number * factor;
    if (!(bytes >= 1 && bytes <= 1e12)) return std::nullopt;
    return static_cast<std::uint64_t>(bytes);
}

}  // namespace

void add_profile_options(CLI::App& command, ProfileArguments& arguments) {
    command
        .add_option("--profile", arguments.profile,
                    "storage of images. dense: compressed, with random access to tiles; board: fixed-size records "
                    "that hardware decodes by table look-up, larger for the same quality; raw: uncompressed, with "
                    "colour at half width and height")
        ->capture_default_str();
    CLI::Option* quality =
        command
            .add_option("--quality", arguments.quality,
                        "quality of compressed images, 1..100; 14 more halves the error of a dense object")
            ->capture_default_str();
    CLI::Option* psnr =
        command.add_option("--psnr", arguments.psnr_db,
                           "alternative: smallest images with at least this PSNR in dB over the object's pixels");
    CLI::Option* size = command.add_option(
        "--size", arguments.size, "alternative: best images within this many bytes in total, such as 800k or 2M");
    quality->excludes(psnr)->excludes(size);
    psnr->excludes(size);
    command
        .add_option("--effort", arguments.effort,
                    "search effort of the dense encoder, 1..9: 9 takes many times as long as 1 and saves a few bits")
        ->capture_default_str();
    command.add_option(
        "--alpha-bits", arguments.alpha_bits,
        "alpha bits of compressed images, 1..6; default 2; for dense images 6 if an area is soft, such as "
        "a shadow, else 1 for a --psnr below 31 or a quality below 54");
}

Result<std::optional<ImageGoal>> parse_goal(const ProfileArguments& arguments) {
    if (arguments.profile == "raw") return std::optional<ImageGoal>();
    if (arguments.profile != "dense" && arguments.profile != "board") {
        return Error{"--profile " + arguments.profile + ": is not a profile; use dense, board or raw"};
    }
    if (arguments.alpha_bits && (*arguments.alpha_bits < 1 || *arguments.alpha_bits > codec::kMaxAlphaBits)) {
        return Error{"--alpha-bits " + std::to_string(*arguments.alpha_bits) + ": must be 1.." +
                     std::to_string(codec::kMaxAlphaBits)};
    }
    if (arguments.effort < kMinEffort || arguments.effort > kMaxEffort) {
        return Error{"--effort " + std::to_string(arguments.effort) + ": must be 1..9"};
    }
    ImageGoal goal;
    goal.effort = arguments.effort;
    goal.profile = arguments.profile == "board" ? codec::Profile::kBoard : codec::Profile::kDense;
    goal.quality = arguments.quality;
    goal.psnr_db = arguments.psnr_db;
    if (!(goal.quality >= kMinQuality && goal.quality <= kMaxQuality)) {
        return Error{"--quality: must be 1..100"};
    }
    if (goal.psnr_db && !(*goal.psnr_db >= 10 && *goal.psnr_db <= 60)) return Error{"--psnr: must be 10..60 dB"};
    if (!arguments.size.empty()) {
        goal.images_bytes = bytes_of(arguments.size);
        if (!goal.images_bytes)
            return Error{"--size " + arguments.size + ": is not a size; use bytes, such as 750000, 800k or 2M"};
    }
    return std::optional<ImageGoal>(goal);
}

}  // namespace rs::encode
