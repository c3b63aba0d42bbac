#pragma once
// Report of the benchmark: measured points and rates relative to ASTC, as CSV and as text.

#include "tests/bench/rd/anchors/best_variant.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::bench {

struct SetResult {
    std::string set;
    std::string about;  // one line: sizes and counts
    std::vector<ChosenCurve> curves;
};

/// Qualities at which rates are compared. Lower for photos, whose noise is not worth coding.
std::vector<double> target_dbs(const std::string& set);

/// set,codec,setting,bytes,bpp,psnr_db,alpha_mae. The setting includes the variant; curves of rejected variants are
/// named CODEC/VARIANT. alpha_mae: 0..255, empty for codecs without alpha.
std::string points_csv(const std::vector<SetResult>& results);

/// set,codec,psnr_db,bpp,ratio_to_astc; the last two are empty if a curve does not reach that dB.
std::string ratios_csv(const std::vector<SetResult>& results);

/// The same as text tables, with the chosen variants.
std::string summary_text(const std::vector<SetResult>& results);

/// points.csv -> points_ratios.csv
std::filesystem::path ratios_path(const std::filesystem::path& points_path);

}  // namespace rs::bench
