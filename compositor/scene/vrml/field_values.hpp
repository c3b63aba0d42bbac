#pragma once
// Parser of field values without nodes. Private to the VRML reader.

#include "compositor/scene/vrml/lexer.hpp"
#include "compositor/scene/vrml/node_table.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

/// Parses one value of the field's type (not kNode). Throws MalformedVrml for values of other types, numbers out of
/// range, unclosed lists, and lists whose length is not a multiple of the type's size.
Value read_value(Lexer& lexer, const FieldSpec& spec, const std::string& field);

/// Parses an SFImage of VRML97 or VRML 1.0: width, height, components, then the pixels. Throws MalformedVrml if the
/// image is too large.
/// \param take_integer parses an integer or throws.
std::vector<double> read_image(Lexer& lexer, const std::string& field, const std::function<long()>& take_integer);

/// Skips a value of unknown type.
void skip_value(Lexer& lexer);

/// Skips up to the bracket that closes the last opened one.
void skip_to_close(Lexer& lexer, int opened_at_line);

}  // namespace rs::compositor::vrml
