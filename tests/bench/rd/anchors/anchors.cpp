#include "tests/bench/rd/anchors/anchors.hpp"

#include "rayspace/base/parallel.hpp"
#include "tests/bench/rd/anchors/astc_anchor.hpp"
#include "tests/bench/rd/anchors/best_variant.hpp"
#include "tests/bench/rd/anchors/still_anchor.hpp"
#include "tests/bench/rd/anchors/tool_process.hpp"
#include "tests/bench/rd/anchors/x265_anchor.hpp"
#include "tests/bench/rd/background.hpp"

#include <opencv2/core/version.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>

namespace rs::bench {
namespace {

constexpr const char* kSpread = "spread";
constexpr const char* kBlack = "black";

// Input images of the anchors, created on first use: a run whose results are all cached needs none.
class AnchorInputs {
public:
    explicit AnchorInputs(const ReferenceImages& images) : images_(images) {}
    const std::vector<Image<Rgba8>>& with_alpha(const std::string& background) {
        return background == kSpread ? filled(with_alpha_[1], Background::kSpread, false)
                                     : filled(with_alpha_[0], Background::kBlack, false);
    }
    const std::vector<Image<Rgba8>>& opaque(const std::string& background) {
        return background == kSpread ? filled(opaque_[1], Background::kSpread, true)
                                     : filled(opaque_[0], Background::kBlack, true);
    }

private:
    const std::vector<Image<Rgba8>>& filled(std::vector<Image<Rgba8>>& place, Background background, bool is_opaque) {
        if (!place.empty()) return place;
        place.resize(images_.views.size());
        const auto fill = [&](int view) -> Status {
            const auto n = static_cast<std::size_t>(view);
            Image<Rgba8> image = with_background(images_.views[n], background);
            place[n] = is_opaque ? made_opaque(std::move(image)) : std::move(image);
            return {};
        };
        const Status always_ok = for_each_in_parallel(static_cast<int>(place.size()), "", nullptr, fill);
        RS_CHECK(always_ok.ok());
        return place;
    }

    const ReferenceImages& images_;
    std::vector<Image<Rgba8>> with_alpha_[2];
    std::vector<Image<Rgba8>> opaque_[2];
};

// One variant of a codec.
struct Anchor {
    std::string codec;
    std::string variant;
    std::string prefix;       // of the setting's name: "q" 50
    std::vector<int> probes;  // settings at which variants are compared
    std::vector<int> settings;
    std::string version_key;  // version of the tool
    std::function<Result<Coded>(int setting)> code;
};

std::string setting_name(const Anchor& anchor, int setting) {
    const std::string number = std::to_string(setting);
    return anchor.prefix.empty() ? number + "x" + number : anchor.prefix + number;
}

// Builds the list of anchors. Runs a tool for its version only if its codec is requested.
class AnchorList {
public:
    AnchorList(const ReferenceImages& images, AnchorInputs& shown, const std::filesystem::path& folder)
        : images_(images), shown_(shown), folder_(folder) {}

    Status add_astc(const std::string& name, bool with_alpha) {
        const Result<std::string> version = run_tool({"astcenc", "-version"});
        if (!version) return version.error();
        for (const std::string background : {kBlack, kSpread}) {
            const auto code = [=, this](int block_px) {
                return code_astc(images_, shown_.with_alpha(background), block_px, with_alpha, folder_);
            };
            add({name,
                 (with_alpha ? "rgba " : "rgb ") + background,
                 "",
                 {6, 10},
                 {4, 5, 6, 8, 10, 12},
                 *version,
                 code});
        }
        return {};
    }

    void add_still(const std::string& name, StillCodec codec) {
        const std::vector<int> qualities = {10, 20, 30, 40, 50, 60, 70, 80, 85, 90, 95};
        for (const std::string background : {kBlack, kSpread}) {
            const auto code = [=, this](int quality) {
                return code_stills(images_, shown_.opaque(background), codec, quality);
            };
            add({name, background, "q", {30, 80}, qualities, "OpenCV " CV_VERSION, code});
        }
    }

    Status add_x265(const std::string& name, bool intra, bool full_chroma) {
        const Result<std::string> version = run_tool({"x265", "--version"});
        if (!version) return version.error();
        // 4:4:4 covers the qualities that 4:2:0 cannot reach.
        const std::vector<int> factors =
            full_chroma ? std::vector{8, 12, 16, 20, 24} : std::vector{12, 16, 20, 24, 28, 32, 36, 40};
        const std::vector<int> probes = full_chroma ? std::vector{16, 24} : std::vector{24, 32};
        for (const bool tune_psnr : {false, true}) {
            for (const std::string background : {kBlack, kSpread}) {
                const auto code = [=, this](int crf) {
                    return code_x265(images_, shown_.opaque(background), {intra, full_chroma, tune_psnr, crf}, folder_);
                };
                add({name, background + (tune_psnr ? " tune-psnr" : ""), "crf", probes, factors, *version, code});
            }
        }
        return {};
    }

    [[nodiscard]] const std::vector<Anchor>& anchors() const { return anchors_; }

private:
    void add(Anchor anchor) {
        // Keeps the first line only: the others describe the machine.
        anchor.version_key = anchor.version_key.substr(0, anchor.version_key.find('\n'));
        anchors_.push_back(std::move(anchor));
    }

    const ReferenceImages& images_;
    AnchorInputs& shown_;
    std::filesystem::path folder_;
    std::vector<Anchor> anchors_;
};

std::string cache_key(const ReferenceImages& images, const Anchor& anchor, const std::string& setting) {
    return "1 " + std::to_string(images.hash) + " " + anchor.codec + " " + anchor.variant + " " + setting + " (" +
           anchor.version_key + ")";
}

// Measures the anchors on one set.
class AnchorMeter {
public:
    AnchorMeter(const ReferenceImages& images, const CodedCache& cache, Progress& progress)
        : images_(images), cache_(cache), progress_(progress) {}

    // Measures the variants of one curve.
    Status measure(std::span<const Anchor> variants) {
        std::vector<Measurement> tried;
        for (const Anchor& anchor : variants) {
            for (const int setting : anchor.probes) {
                if (Status status = measure(anchor, setting, tried); !status) return status;
            }
        }
        const std::string best = best_variants(tried).front().variant;
        for (const Anchor& anchor : variants) {
            if (anchor.variant != best) continue;
            for (const int setting : anchor.settings) {
                if (contains(anchor.probes, setting)) continue;
                if (Status status = measure(anchor, setting, tried); !status) return status;
            }
        }
        measured_.insert(measured_.end(), tried.begin(), tried.end());
        return {};
    }

    [[nodiscard]] const std::vector<Measurement>& measured() const { return measured_; }

private:
    static bool contains(const std::vector<int>& list, int number) {
        return std::find(list.begin(), list.end(), number) != list.end();
    }

    Status measure(const Anchor& anchor, int setting, std::vector<Measurement>& measured) {
        const std::string name = setting_name(anchor, setting);
        const std::string key = cache_key(images_, anchor, name);
        std::optional<Coded> coded = cache_.find(key);
        if (!coded) {
            const Result<Coded> fresh = anchor.code(setting);
            if (!fresh) return fresh.error();
            if (Status status = cache_.store(key, *fresh); !status) return status;
            coded = *fresh;
        }
        measured.push_back(measurement_of(images_, anchor.codec, anchor.variant, name, *coded));
        progress_.advance();
        return {};
    }

    const ReferenceImages& images_;
    const CodedCache& cache_;
    Progress& progress_;
    std::vector<Measurement> measured_;
};

}  // namespace

const std::vector<std::string>& anchor_names() {
    static const std::vector<std::string> names = {"astc",       "astc-rgba",  "jpeg",           "webp",
                                                   "x265-intra", "x265-inter", "x265-intra-444", "x265-inter-444"};
    return names;
}

Result<std::vector<Measurement>> measure_anchors(const ReferenceImages& images, const std::set<std::string>& names,
                                                 const WorkFolder& work, Progress& progress) {
    const CodedCache cache(work.anchors());
    AnchorInputs shown(images);
    AnchorList list(images, shown, work.scratch());
    for (const bool with_alpha : {false, true}) {
        const std::string name = with_alpha ? "astc-rgba" : "astc";
        if (!names.contains(name)) continue;
        if (Status status = list.add_astc(name, with_alpha); !status) return status.error();
    }
    if (names.contains("jpeg")) list.add_still("jpeg", StillCodec::kJpeg);
    if (names.contains("webp")) list.add_still("webp", StillCodec::kWebp);
    for (const bool full_chroma : {false, true}) {
        for (const bool intra : {true, false}) {
            const std::string name = std::string(intra ? "x265-intra" : "x265-inter") + (full_chroma ? "-444" : "");
            if (!names.contains(name)) continue;
            if (Status status = list.add_x265(name, intra, full_chroma); !status) return status.error();
        }
    }

    // Variants of a curve are adjacent in the list.
    std::vector<std::span<const Anchor>> curves;
    std::int64_t steps = 0;
    for (std::span<const Anchor> left = list.anchors(); !left.empty(); left = left.subspan(curves.back().size())) {
        const auto other = std::find_if(left.begin(), left.end(),
                                        [&](const Anchor& anchor) { return anchor.codec != left.front().codec; });
        curves.push_back(left.first(static_cast<std::size_t>(other - left.begin())));
        const Anchor& any = left.front();
        steps += static_cast<std::int64_t>((curves.back().size() - 1) * any.probes.size() + any.settings.size());
    }
    progress.start(images.name + ": anchors", steps);
    AnchorMeter meter(images, cache, progress);
    for (const std::span<const Anchor> variants : curves) {
        if (Status status = meter.measure(variants); !status) return status.error();
    }
    progress.finish();
    return meter.measured();
}

}  // namespace rs::bench
