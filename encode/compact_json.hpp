#pragma once
// Compacts the JSON text of a rig for storage: numbers keep nine significant digits. A millionth of a pixel is far
// below the accuracy of a calibration, and the full text is as large as an image.

#include <string>

namespace rs::encode {

/// Removes white space and rounds fractions to nine significant digits. Keys keep their order. `text` must be valid
/// JSON.
std::string compact_json(const std::string& text);

}  // namespace rs::encode
