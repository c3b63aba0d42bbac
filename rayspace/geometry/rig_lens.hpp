#pragma once
/// \file
/// Kind of lens that the keys of a transforms.json state: camera_model or camera_type by the names of nerfstudio,
/// COLMAP and Blender, flags of instant-ngp, and f-theta polynomials.

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <string_view>

namespace rs {

inline constexpr std::array<std::string_view, 9> kPinholeLensNames = {
    "PINHOLE", "SIMPLE_PINHOLE", "OPENCV", "SIMPLE_RADIAL", "RADIAL", "FULL_OPENCV", "perspective", "PERSPECTIVE", ""};
inline constexpr std::array<std::string_view, 5> kFisheyeLensNames = {"OPENCV_FISHEYE", "SIMPLE_RADIAL_FISHEYE",
                                                                      "RADIAL_FISHEYE", "FISHEYE", "fisheye"};
inline constexpr std::array<std::string_view, 3> kPanoramaFlags = {"latlong", "equirectangular", "is_equirectangular"};
/// Coefficients of OpenCV's radial and tangential model; k is COLMAP's k1 of SIMPLE_RADIAL.
inline constexpr std::array<std::string_view, 9> kDistortionKeys = {"k",  "k1", "k2", "p1", "p2",
                                                                    "k3", "k4", "k5", "k6"};

enum class LensKind {
    kPinhole,  ///< perhaps with radial and tangential distortion
    kFisheye,  ///< OpenCV's fisheye
    kOther,
};

struct StatedLens {
    LensKind kind = LensKind::kPinhole;
    std::string stated;  ///< by which key it is not a pinhole: "camera_model FISHEYE"
};

/// The value of a key in the frame, else in the file; null if there is none.
nlohmann::json stated_key(const nlohmann::json& file, const nlohmann::json& frame, std::string_view key);

/// \param file, frame the keys of both (Rig::extras, RigView::extras); those of the frame take precedence
StatedLens stated_lens(const nlohmann::json& file, const nlohmann::json& frame);

}  // namespace rs
