#pragma once
// The values of fields that hold no nodes. Private to the VRML reader.

#include "compositor/scene/vrml/lexer.hpp"
#include "compositor/scene/vrml/node_table.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

// Takes one value of the field's type (not kNode). Throws MalformedVrml where a value is of another type, a number does
// not fit, a list is not closed, or a list's length does not divide into whole values.
Value read_value(Lexer& lexer, const FieldSpec& spec, const std::string& field);

// The numbers of an SFImage, of VRML97 and of VRML 1.0: sides and components, then the pixels. `take_integer` takes a
// whole number or throws. Throws MalformedVrml where the image is too large.
std::vector<double> read_image(Lexer& lexer, const std::string& field, const std::function<long()>& take_integer);

// Takes whatever value stands there, of a field whose type is not known.
void skip_value(Lexer& lexer);

// Takes everything up to the bracket that closes the one just taken.
void skip_to_close(Lexer& lexer, int opened_at_line);

}  // namespace rs::compositor::vrml
