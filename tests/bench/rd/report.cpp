#include "tests/bench/rd/report.hpp"

#include <array>
#include <cstdio>
#include <optional>

namespace rs::bench {
namespace {

template <class... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(), format, arguments...);
    return text.data();
}

void append_points(std::string& csv, const std::string& codec, const std::vector<Measurement>& points) {
    for (const Measurement& point : points) {
        const std::string setting = point.setting + (point.variant.empty() ? "" : " " + point.variant);
        csv += formatted("%s,%s,%s,%llu,%.4f,%.3f,", point.set.c_str(), codec.c_str(), setting.c_str(),
                         static_cast<unsigned long long>(point.bytes), point.bpp, point.psnr_db);
        csv += (point.alpha_mae ? formatted("%.3f", *point.alpha_mae) : "") + "\n";
    }
}

struct Rate {
    std::optional<double> bpp;
    std::optional<double> ratio;  // to ASTC
};

Rate rate_at(const SetResult& result, const ChosenCurve& curve, double psnr_db) {
    Rate rate{curve.curve.bpp_at(psnr_db), std::nullopt};
    const ChosenCurve* const astc = find_curve(result.curves, "astc");
    if (!rate.bpp || astc == nullptr) return rate;
    if (const auto reference = astc->curve.bpp_at(psnr_db)) rate.ratio = *rate.bpp / *reference;
    return rate;
}

std::string table_of(const SetResult& result) {
    const std::vector<double> targets = target_dbs(result.set);
    std::string text = formatted("  %-16s", "bpp (x of ASTC)");
    for (const double db : targets) text += formatted("%17.0f dB", db);
    text += "\n";
    for (const ChosenCurve& curve : result.curves) {
        text += formatted("  %-16s", curve.codec.c_str());
        for (const double db : targets) {
            const Rate rate = rate_at(result, curve, db);
            const std::string bpp = rate.bpp ? formatted("%.3f", *rate.bpp) : "-";
            const std::string ratio = rate.ratio ? formatted("(%.3f)", *rate.ratio) : "";
            text += formatted("%12s %7s", bpp.c_str(), ratio.c_str());
        }
        text += "\n";
    }
    return text;
}

// "  astc: 26.4 .. 38.5 dB; 'rgb spread' is the best variant; 'rgba spread' takes 1.140 of its bits"
std::string variants_of(const ChosenCurve& curve) {
    std::string text = "  " + curve.codec;
    if (!curve.curve.empty()) text += formatted(": %.1f .. %.1f dB", curve.curve.least_db(), curve.curve.most_db());
    if (!curve.variant.empty()) text += "; '" + curve.variant + "' is the best variant";
    for (const ChosenCurve::Rejected& other : curve.rejected) {
        text += formatted("; '%s' takes %.3f of its bits", other.variant.c_str(), other.rate_ratio);
    }
    return text + "\n";
}

// Comparison of ASTC as RGB and as RGBA.
std::string astc_of(const SetResult& result) {
    const ChosenCurve* const rgb = find_curve(result.curves, "astc");
    const ChosenCurve* const rgba = find_curve(result.curves, "astc-rgba");
    if (rgb == nullptr || rgba == nullptr) return "";
    const std::optional<double> ratio = mean_rate_ratio(rgba->curve, rgb->curve);
    if (!ratio) return "";
    return formatted("  ASTC as RGBA takes %.3f of the bits of RGB, so %s is the better variant; ratios are to RGB\n",
                     *ratio, *ratio > 1 ? "RGB (no alpha coded)" : "RGBA");
}

// Quality from which 4:4:4 takes fewer bits than 4:2:0.
std::string full_chroma_of(const SetResult& result, const std::string& codec) {
    const ChosenCurve* const half = find_curve(result.curves, codec);
    const ChosenCurve* const full = find_curve(result.curves, codec + "-444");
    if (half == nullptr || full == nullptr || half->curve.empty() || full->curve.empty()) return "";
    constexpr double kStep_db = 0.25;
    for (double db = full->curve.least_db(); db <= half->curve.most_db(); db += kStep_db) {
        const auto a = full->curve.bpp_at(db);
        const auto b = half->curve.bpp_at(db);
        if (a && b && *a < *b)
            return "  " + codec + formatted(": 4:4:4 takes fewer bits than 4:2:0 from %.1f dB\n", db);
    }
    return "  " + codec +
           formatted(": 4:2:0 takes fewer bits than 4:4:4 as far as it reaches, %.1f dB\n", half->curve.most_db());
}

}  // namespace

std::vector<double> target_dbs(const std::string& set) {
    if (set.starts_with("oxford-dino")) return {24, 26, 28, 30, 32};
    if (set.starts_with("shoe36")) return {26, 28, 32, 36};
    return {28, 30, 34, 38};
}

std::string points_csv(const std::vector<SetResult>& results) {
    std::string csv = "set,codec,setting,bytes,bpp,psnr_db,alpha_mae\n";
    for (const SetResult& result : results) {
        for (const ChosenCurve& curve : result.curves) {
            append_points(csv, curve.codec, curve.points);
            for (const ChosenCurve::Rejected& other : curve.rejected) {
                append_points(csv, curve.codec + "/" + other.variant, other.points);
            }
        }
    }
    return csv;
}

std::string ratios_csv(const std::vector<SetResult>& results) {
    std::string csv = "set,codec,psnr_db,bpp,ratio_to_astc\n";
    for (const SetResult& result : results) {
        for (const ChosenCurve& curve : result.curves) {
            for (const double db : target_dbs(result.set)) {
                const Rate rate = rate_at(result, curve, db);
                csv += formatted("%s,%s,%g,", result.set.c_str(), curve.codec.c_str(), db);
                csv += (rate.bpp ? formatted("%.4f", *rate.bpp) : "") + ",";
                csv += (rate.ratio ? formatted("%.4f", *rate.ratio) : "") + "\n";
            }
        }
    }
    return csv;
}

std::string summary_text(const std::vector<SetResult>& results) {
    std::string text;
    for (const SetResult& result : results) {
        text += result.set + ": " + result.about + "\n" + table_of(result);
        for (const ChosenCurve& curve : result.curves) text += variants_of(curve);
        text += astc_of(result);
        for (const std::string codec : {"x265-intra", "x265-inter"}) text += full_chroma_of(result, codec);
        text += "\n";
    }
    return text;
}

std::filesystem::path ratios_path(const std::filesystem::path& points_path) {
    std::filesystem::path path = points_path;
    path.replace_filename(points_path.stem().string() + "_ratios" + points_path.extension().string());
    return path;
}

}  // namespace rs::bench
