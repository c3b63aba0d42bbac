#pragma once
// X3D as XML (ISO/IEC 19776-1) -> the same world in the classic encoding (ISO/IEC 19776-2), line by line, which the
// reader of VRML97 takes: PROTO, DEF and USE, limits and words are the same for both. Expat reads the XML.

#include "rayspace/base/result.hpp"

#include <string>
#include <string_view>

namespace rs::compositor::x3d {

// Whether a text is XML by how it begins.
bool is_xml(std::string_view text);

// The text, without its header, has each thing in the line where the XML has it. Refused, with the line: XML that is
// not well-formed, that declares entities, that nests more than 1000 elements deep, or whose root is not X3D. Nothing
// is fetched: external entities and document types are not looked at. `file` names the text in messages. Pure;
// thread-safe.
Result<std::string> classic_text(std::string_view xml, const std::string& file);

}  // namespace rs::compositor::x3d
