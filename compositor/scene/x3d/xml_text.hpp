#pragma once
// Converts X3D in XML (ISO/IEC 19776-1) to the classic encoding (ISO/IEC 19776-2), line by line, for the VRML97 reader:
// PROTO, DEF and USE, limits and keywords are the same in both. Expat parses the XML.

#include "rayspace/base/result.hpp"

#include <string>
#include <string_view>

namespace rs::compositor::x3d {

/// True if the text begins like XML.
bool is_xml(std::string_view text);

/// Classic text without header, with everything on its original line. Fails, naming the line, for malformed XML, entity
/// declarations, more than 1000 nested elements, and root elements other than X3D. External entities and document types
/// are not loaded.
/// \param file file name for messages.
/// Pure; thread-safe.
Result<std::string> classic_text(std::string_view xml, const std::string& file);

}  // namespace rs::compositor::x3d
