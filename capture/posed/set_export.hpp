#pragma once
/// \file
/// Export of a capture set for other tools: pinhole cameras, photos and masks in the layout of COLMAP or nerfstudio.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace rs::capture {

enum class ExportFormat {
    /// images/NAME.png, masks/NAME.png.png (white: object), sparse/0/cameras.txt, images.txt and an empty points3D.txt.
    /// One PINHOLE camera for each lens.
    kColmap,
    /// images/NAME.png, masks/NAME.png and transforms.json with OpenGL axes and mask_path.
    kNerfstudio,
};

struct ExportOptions {
    std::filesystem::path set;     ///< capture set: folder or transforms.json
    std::filesystem::path output;  ///< folder; an existing one is replaced as StagedFolder states
    ExportFormat format = ExportFormat::kColmap;
    /// Colour below the object; empty: RGBA images.
    std::optional<Rgba8> background;
    bool force = false;
};

/// Writes the folder. Cameras are those of the set, in its axes and unit of length; the object is white in a mask where
/// alpha is 128 or more. Returns the number of views. Errors: a set that cannot be read, lens distortion, images
/// without alpha or of another size than their cameras.
Result<std::size_t> export_set(const ExportOptions& options, Progress* progress);

}  // namespace rs::capture
