#pragma once
// Checks of capture sets that other tools wrote, before their images are read: lens models, alpha and repeated
// frames. Frames of reference: rayspace/geometry/rig_conventions.hpp.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::encode {

/// Steepest camera that can be made upright.
inline constexpr double kSteepestPitch_deg = 60;

/// Removes frames with the image and the camera of an earlier frame, and reports images that several frames share, in
/// one warning each.
void remove_repeated_frames(Rig& rig, const std::filesystem::path& file, std::vector<std::string>& warnings);

/// Widest range of elevations within a ring of find_rings(), which continues while gaps are small.
inline constexpr double kRingSpread_deg = 15;

/// Rings of photos farther apart need synthesized views between them: mixed, their images would show double contours.
inline constexpr double kRingStep_deg = 12.5;

/// True if views must be synthesized: if the rig states so by kPosedKey, or has views at so many elevations that they
/// are not rings, or rings farther apart than kRingStep_deg.
bool is_posed(const Rig& rig);

/// The checks of posed cameras, whose sizes and elevations may differ.
/// \return an error if there are no views, a lens is not a pinhole or distorts, or images have neither an alpha channel
/// nor a mask
Status check_posed_views(const Rig& rig, const std::filesystem::path& file);

/// \param file the transforms.json, for errors
/// \return an error if there are no views, sizes differ, a lens is not a pinhole or distorts, a camera is too steep, or
/// images have neither an alpha channel nor a mask
Status check_views(const Rig& rig, const std::filesystem::path& file);

/// "mask_path" of a frame; empty if there is none.
std::string mask_path(const RigView& view);

}  // namespace rs::encode
