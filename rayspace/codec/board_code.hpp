#pragma once
// What all pictures of a `board` object share (chunk CODE).

namespace rs::codec {

struct BoardCode {};

}  // namespace rs::codec
