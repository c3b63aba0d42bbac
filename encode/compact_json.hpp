#pragma once
// The text of a rig as an object holds it: what it states to nine digits, in few bytes. A millionth of a pixel is far
// below what a calibration knows, and the text weighs as much as an image.

#include <string>

namespace rs::encode {

// `text` must be JSON. The same object without white space, its fractions rounded to nine significant digits; keys keep
// their order.
std::string compact_json(const std::string& text);

}  // namespace rs::encode
